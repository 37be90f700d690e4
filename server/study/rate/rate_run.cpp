#include "server/study/rate/rate_run.h"

#include "server/study/rate/rate_search.h"

namespace herr {
namespace {

MeasuredRate measured(const RateSetting& setting, const std::vector<RateTrial>& trials) {
  return {setting, trials, median_p95_ms(trials)};
}

}  // namespace

int MeasuredRate::frames() const {
  int sum = 0;
  for (const RateTrial& trial : trials) sum += trial.frames;
  return sum;
}

MachineUse MeasuredRate::machine() const {
  MachineUse sum;
  for (const RateTrial& trial : trials) sum.add(trial.machine);
  return sum;
}

MachineUse RateAnswer::machine() const {
  MachineUse sum;
  for (const MeasuredRate& each : tried) sum.add(each.machine());
  return sum;
}

std::optional<RateAnswer> run_rate_search(const std::vector<RateSetting>& ladder, double period_ms,
                                          const MeasureRate& measure, const TellRate& tell) {
  RateSearch search(ladder.size(), period_ms);
  while (const std::optional<std::size_t> next = search.next()) {
    const std::optional<RateTrial> trial = measure(ladder[*next], *next == 0);
    if (!trial) return std::nullopt;
    tell(ladder[*next], *trial);
    search.observe(*trial);
  }
  RateAnswer answer;
  answer.period_ms = period_ms;
  for (std::size_t i = 0; i < ladder.size(); ++i) {
    if (!search.trials(i).empty()) answer.tried.push_back(measured(ladder[i], search.trials(i)));
  }
  if (const auto held = search.held()) answer.held = measured(ladder[*held], search.trials(*held));
  if (const auto refused = search.refused())
    answer.refused = measured(ladder[*refused], search.trials(*refused));
  return answer;
}

LongestStage longest_stage(const std::vector<RateTrial>& trials) {
  StageTimes sum;
  double sample_ms = 0, frame_ms = 0, frames = 0;
  for (const RateTrial& trial : trials) {
    for (std::size_t i = 0; i < kStageCount; ++i) sum.ms[i] += trial.frames * trial.stages.ms[i];
    sample_ms += trial.frames * trial.sample_ms;
    frame_ms += trial.frames * trial.frame_ms;
    frames += trial.frames;
  }
  LongestStage longest{"sample", sample_ms / frames, frame_ms / frames};
  for (std::size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::idle || !(sum.ms[i] / frames > longest.ms)) continue;
    longest.name = name_of(stage);
    longest.ms = sum.ms[i] / frames;
  }
  return longest;
}

}  // namespace herr
