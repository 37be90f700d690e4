#include "server/study/rate/rate_run.h"

#include <bit>

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
                                          const MeasureRate& measure, const TellRate& tell,
                                          const RateTimeIsUp& time_is_up) {
  RateSearch search(ladder.size(), period_ms);
  RateAnswer answer;
  bool begun = false;
  while (const std::optional<std::size_t> next = search.next()) {
    answer.ended_early = begun && time_is_up && time_is_up();
    if (answer.ended_early) break;
    begun = true;
    const std::optional<RateTrial> trial = measure(ladder[*next], *next == 0);
    if (!trial) return std::nullopt;
    tell(ladder[*next], *trial);
    search.observe(*trial);
  }
  answer.period_ms = period_ms;
  for (std::size_t i = 0; i < ladder.size(); ++i) {
    if (!search.trials(i).empty()) answer.tried.push_back(measured(ladder[i], search.trials(i)));
  }
  if (const auto held = search.held()) answer.held = measured(ladder[*held], search.trials(*held));
  if (const auto refused = search.refused())
    answer.refused = measured(ladder[*refused], search.trials(*refused));
  if (answer.ended_early) {
    const std::size_t above = search.refused().value_or(ladder.size());
    answer.open = above - (search.held() ? *search.held() + 1 : 0);
    // Each halves what is open; the last ones are measured three times.
    answer.runs_to_go = static_cast<std::size_t>(std::bit_width(answer.open)) + kRunsAtTheEnd;
  }
  return answer;
}

StageTimes mean_stages(const std::vector<RateTrial>& trials) {
  StageTimes mean;
  double frames = 0;
  for (const RateTrial& trial : trials) {
    for (std::size_t i = 0; i < kStageCount; ++i) mean.ms[i] += trial.frames * trial.stages.ms[i];
    mean.frame_ms += trial.frames * trial.frame_ms;
    frames += trial.frames;
  }
  mean.frame_ms /= frames;
  for (double& ms : mean.ms) ms /= frames;
  return mean;
}

LongestStage longest_stage(const std::vector<RateTrial>& trials) {
  double sample_ms = 0, frames = 0;
  for (const RateTrial& trial : trials) {
    sample_ms += trial.frames * trial.sample_ms;
    frames += trial.frames;
  }
  const StageTimes mean = mean_stages(trials);
  LongestStage longest{"sample", sample_ms / frames, mean.frame_ms, {}};
  for (std::size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::idle || !(mean.ms[i] > longest.ms)) continue;
    longest.name = name_of(stage);
    longest.ms = mean.ms[i];
    longest.stage = stage;
  }
  return longest;
}

}  // namespace herr
