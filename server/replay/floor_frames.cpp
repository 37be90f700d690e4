#include "server/replay/floor_frames.h"

#include "server/text/number_text.h"
#include "sessions/inspect/number_words.h"

namespace herr {

void FloorFrames::add(const FrameRecord& record, double target_ms, int threads) {
  target_ms_ = target_ms;
  threads_ = threads;
  ++frames_;
  const QualityReason reason = record.decision.reason;
  if (reason == QualityReason::floor_too_slow) ++out_of_reach_;
  const bool least = reason == QualityReason::start || reason == QualityReason::floor ||
                     reason == QualityReason::floor_too_slow;
  if (!least || record.times.frame_ms <= target_ms) return;
  ++late_;
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

std::string FloorFrames::warning() const {
  if (out_of_reach_ == 0) return {};
  const std::string text = "the target of " + fixed_text(target_ms_, 2) + " ms was out of reach in " +
                           std::to_string(out_of_reach_) + " of " + counted(frames_, "frame", "frames") +
                           " with the least quality allowed; ";
  if (2 * kept_off_ <= late_) {
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
