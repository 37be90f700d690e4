#include "sessions/streams/gaze_sampler.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "sessions/streams/rotations.h"

namespace herr {
namespace {
constexpr glm::dvec3 kAhead{0, 0, -1};
}

GazeSampler::GazeSampler(std::optional<RowStream<GazeRow>> rows, SamplingMode mode,
                         const GazeGeometry& geometry)
    : rows_(std::move(rows)), mode_(mode), geometry_(geometry) {
  if (rows_) after_ = next_row();
}

// The flags of a combined ray say which pupil was seen; the ray is that of both eyes.
std::optional<GazeRow> GazeSampler::next_row() {
  std::optional<GazeRow> row = rows_->next();
  if (!row || !geometry_.combined || row->valid[0] == row->valid[1]) return row;
  const std::size_t seen = row->valid[0] ? 0 : 1;
  row->head_direction[1 - seen] = row->head_direction[seen];
  row->valid[1 - seen] = true;
  return row;
}

void GazeSampler::take(const GazeRow& row) {
  newest_ns_ = row.stamp_ns;
  for (std::size_t eye = 0; eye < 2; ++eye)
    if (row.valid[eye]) seen_[eye] = Seen{row.stamp_ns, row.head_direction[eye]};
}

// Only between two neighbouring valid rows; anything else is a loss, which is held and not bridged.
std::optional<GazeSampler::EyeSample> GazeSampler::interpolated(std::size_t eye, TimeNs t_ns) const {
  if (mode_ != SamplingMode::interpolate || !seen_[eye] || !after_ || !after_->valid[eye])
    return std::nullopt;
  const TimeNs step_ns = after_->stamp_ns - seen_[eye]->stamp_ns;
  const bool neighbours = seen_[eye]->stamp_ns == newest_ns_;
  if (!neighbours || step_ns > kGazeHoldNs || t_ns == newest_ns_) return std::nullopt;
  const double share = static_cast<double>(t_ns - seen_[eye]->stamp_ns) / static_cast<double>(step_ns);
  return EyeSample{turn_from_to(seen_[eye]->head_direction, after_->head_direction[eye], share),
                   SampleSource::interpolated, after_->stamp_ns};
}

GazeSampler::EyeSample GazeSampler::eye_at(std::size_t eye, TimeNs t_ns) const {
  // A row that saw only the other eye is newer word of where both look: eyes move together.
  const std::size_t other = 1 - eye;
  const bool borrow = seen_[other] && (!seen_[eye] || seen_[other]->stamp_ns > seen_[eye]->stamp_ns);
  const std::size_t used = borrow ? other : eye;
  if (auto sample = interpolated(used, t_ns)) return *sample;
  if (!seen_[used]) return {};
  const Seen& seen = *seen_[used];
  const TimeNs age_ns = t_ns - seen.stamp_ns;
  EyeSample sample{seen.head_direction, SampleSource::held, seen.stamp_ns};
  if (age_ns == 0 && (!borrow || geometry_.combined)) sample.source = SampleSource::exact;
  if (age_ns <= kGazeHoldNs) return sample;
  const double loose_s = static_cast<double>(age_ns - kGazeHoldNs) * kSecondsPerNs;
  sample.head_direction = turn_from_to(kAhead, seen.head_direction, std::exp(-loose_s / kGazeGlideTauS));
  sample.source = age_ns < kGazeCentredNs ? SampleSource::gliding : SampleSource::centred;
  return sample;
}

// The eye's own direction to the point that the combined ray, which starts at the head's origin, meets at the
// vergence distance.
glm::dvec3 GazeSampler::aimed(std::size_t eye, const glm::dvec3& ray) const {
  if (!geometry_.combined || !geometry_.vergence_m) return ray;
  const glm::dvec3 to_target = *geometry_.vergence_m * ray - geometry_.eye_in_head[eye];
  const double distance = glm::length(to_target);
  return distance > 1e-6 ? to_target / distance : ray;  // a target inside the eye has no direction
}

SampledGaze GazeSampler::at(TimeNs t_ns) {
  while (after_ && after_->stamp_ns <= t_ns) {
    take(*after_);
    after_ = next_row();
  }
  SampledGaze gaze;
  gaze.age_ns = -1;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const EyeSample sample = eye_at(eye, t_ns);
    gaze.head_direction[eye] = aimed(eye, sample.head_direction);
    gaze.source[eye] = sample.source;
    if (sample.source == SampleSource::centred) continue;
    gaze.stamp_ns = std::max(gaze.stamp_ns, *sample.stamp_ns);
    gaze.age_ns = t_ns - gaze.stamp_ns;
  }
  const bool not_causal =
      gaze.source[0] == SampleSource::interpolated || gaze.source[1] == SampleSource::interpolated;
  if (not_causal) gaze.age_ns = -1;
  return gaze;
}

}  // namespace herr
