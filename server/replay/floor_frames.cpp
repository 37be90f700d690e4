#include "server/replay/floor_frames.h"

#include <algorithm>
#include <cstddef>

#include "server/settings/stage_remedy.h"
#include "server/text/number_text.h"
#include "sessions/inspect/number_words.h"

namespace herr {

void FloorFrames::add(const FrameRecord& record, double target_ms, int threads) {
  target_ms_ = target_ms;
  threads_ = threads;
  ++frames_;
  const QualityReason reason = record.decision.reason;
  const bool floor = is_floor(reason);
  if (floor && record.over_target) ++over_target_;
  const bool least = floor || reason == QualityReason::start;
  if (!least || record.times.frame_ms <= target_ms) return;
  ++late_;
  for (std::size_t i = 0; i < kStageCount; ++i) stages_.ms[i] += record.times.ms[i];
  MissFacts facts;
  facts.frame_ms = record.times.frame_ms;
  facts.period_ms = target_ms;
  facts.cpu_ms = record.cpu_ms;
  facts.preemptions = record.preemptions;
  facts.threads = threads;
  if (cause_of_miss(facts) != MissCause::machine) return;
  ++kept_off_;
  kept_off_cpu_ms_ += *record.cpu_ms;
  kept_off_preemptions_ += *record.preemptions;
}

std::string FloorFrames::stage_advice(double profile_scale) const {
  std::size_t longest = 0;
  for (std::size_t i = 1; i < kStageCount; ++i) {
    if (static_cast<Stage>(i) != Stage::idle && stages_.ms[i] > stages_.ms[longest]) longest = i;
  }
  const double mean_ms = stages_.ms[longest] / static_cast<double>(std::max<std::int64_t>(late_, 1));
  if (!(mean_ms > target_ms_)) return {};
  const auto stage = static_cast<Stage>(longest);
  const std::string remedy = stage_remedy(stage, profile_scale);
  if (remedy.empty()) return {};
  return std::string(name_of(stage)) + " alone takes " + fixed_text(mean_ms, 2) + " ms there: " + remedy;
}

std::string FloorFrames::warning(double profile_scale) const {
  if (over_target_ == 0) return {};
  const std::string text = std::to_string(over_target_) + " of " + counted(frames_, "frame", "frames") +
                           " had the least quality allowed and still took longer than the target of " +
                           fixed_text(target_ms_, 2) + " ms; ";
  if (2 * kept_off_ <= late_) {
    const std::string stage = stage_advice(profile_scale);
    if (!stage.empty()) return text + stage + ", or give a higher --target-ms";
    return text +
           "give a lower --polar-floor or --polar-floor-height, fewer pixels (--profile, --profile-scale) or "
           "a "
           "higher --target-ms";
  }
  const auto frames = static_cast<double>(kept_off_);
  return text + "the work fits, but others had the cores: " + fixed_text(kept_off_cpu_ms_ / frames, 1) +
         " ms of CPU on " + counted(threads_, "thread", "threads") + " and " +
         fixed_text(static_cast<double>(kept_off_preemptions_) / frames, 1) +
         " preemptions in each frame that was late; end what else runs on this machine";
}

}  // namespace herr
