#include "sessions/streams/pose_sampler.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "sessions/streams/rotations.h"

namespace herr {
namespace {

double seconds(TimeNs ns) {
  return static_cast<double>(ns) * kSecondsPerNs;
}

Pose between(const PoseRow& a, const PoseRow& b, double share) {
  const Pose &from = a.world_from_head, &to = b.world_from_head;
  return {from.position + share * (to.position - from.position),
          turn_from_to(from.orientation, to.orientation, share)};
}

}  // namespace

PoseSampler::PoseSampler(RowStream<PoseRow> rows, SamplingMode mode, double predict_cap_s)
    : rows_(std::move(rows)), mode_(mode), predict_cap_s_(predict_cap_s) {
  const std::optional<PoseRow> first = rows_.next();
  if (!first) throw InputError(rows_.rows().path(), 0, "has no samples", "record at least one pose");
  newest_ = *first;
  speed_.add(newest_.stamp_ns, newest_.world_from_head);
  after_ = rows_.next();
}

void PoseSampler::advance(TimeNs t_ns) {
  while (after_ && after_->stamp_ns <= t_ns) {
    before_ = newest_;
    newest_ = *after_;
    speed_.add(newest_.stamp_ns, newest_.world_from_head);
    after_ = rows_.next();
  }
}

SampledPose PoseSampler::newest(TimeNs t_ns) const {
  const TimeNs age_ns = std::max<TimeNs>(0, t_ns - newest_.stamp_ns);
  const bool exact = t_ns == newest_.stamp_ns;
  return {newest_.world_from_head, exact ? SampleSource::exact : SampleSource::held, newest_.stamp_ns,
          age_ns};
}

SampledPose PoseSampler::interpolated(TimeNs t_ns) const {
  const TimeNs step_ns = after_ ? after_->stamp_ns - newest_.stamp_ns : 0;
  if (!after_ || t_ns <= newest_.stamp_ns || step_ns > kMaxPoseGapNs) return newest(t_ns);
  const double share = static_cast<double>(t_ns - newest_.stamp_ns) / static_cast<double>(step_ns);
  return {between(newest_, *after_, share), SampleSource::interpolated, after_->stamp_ns, -1};
}

SampledPose PoseSampler::predicted(TimeNs t_ns) const {
  SampledPose sampled = newest(t_ns);
  const TimeNs step_ns = before_ ? newest_.stamp_ns - before_->stamp_ns : 0;
  const double horizon_s = std::min(seconds(sampled.age_ns), predict_cap_s_);
  if (!before_ || step_ns < kMinPoseStepNs || step_ns > kMaxPoseGapNs || !(horizon_s > 0)) return sampled;
  sampled.world_from_head = between(*before_, newest_, 1 + horizon_s / seconds(step_ns));
  sampled.source = SampleSource::predicted;
  return sampled;
}

SampledPose PoseSampler::at(TimeNs t_ns) {
  advance(t_ns);
  switch (mode_) {
    case SamplingMode::interpolate:
      return interpolated(t_ns);
    case SamplingMode::predict:
      return predicted(t_ns);
    case SamplingMode::latest:
      break;
  }
  return newest(t_ns);
}

}  // namespace herr
