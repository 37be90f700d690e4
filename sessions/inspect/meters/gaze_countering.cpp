#include "sessions/inspect/meters/gaze_countering.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sessions/streams/rotations.h"

namespace herr {
namespace {

constexpr std::size_t kMostKept = 98'304;  // 24 bytes each, 33 minutes
constexpr TimeNs kSpacingNs = 20'000'000, kSegmentNs = 4'000'000'000, kLongestPoseGapNs = 150'000'000;
constexpr TimeNs kWindowNs = 22'000'000, kSlackNs = 2'000'000, kLongestWindowNs = 150'000'000;
// Slower turns drown in the noise of the gaze, which is a few degrees a second over a window.
constexpr double kSlowestDegS = 5, kNoiseDegS = 5;
constexpr double kTwoToOne = 0.6931471805599453;  // its logarithm
constexpr double kRestingShare = 0.3;
constexpr TimeNs kSecondNs = 1'000'000'000;
constexpr std::int64_t kFewestTelling = 12, kManySeconds = 5;
constexpr double kReversed = -3, kReversedInFewSeconds = -4.5, kFewestTellingShare = 0.1;

struct Angles {
  double x = 0, y = 0;  // degrees to the right and up
};

Angles angles_of(const glm::dvec3& d) {
  return {glm::degrees(std::atan2(d.x, -d.z)), glm::degrees(std::asin(std::clamp(d.y, -1.0, 1.0)))};
}

Angles speed(const Angles& from, const Angles& to, double seconds) {
  return {std::remainder(to.x - from.x, 360.0) / seconds, (to.y - from.y) / seconds};
}

double square(double value) {
  return value * value;
}

// `for_it`, `against_it`: squared errors of the two readings.
void vote(double for_it, double against_it, TimeNs stamp_ns, GazeCountering::Axis& axis) {
  const double value = std::log((against_it + square(kNoiseDegS)) / (for_it + square(kNoiseDegS)));
  axis.sum += value;
  axis.squares += square(value);
  ++axis.votes;
  axis.against += value >= kTwoToOne ? 1 : 0;
  axis.with += value <= -kTwoToOne ? 1 : 0;
  const TimeNs second = stamp_ns / kSecondNs;
  if (std::abs(value) < kTwoToOne || second == axis.last_second) return;
  axis.last_second = second;
  ++axis.seconds;
}

// `held`: what the eye would turn by to hold what it looks at; `eye`: what it turns by; each along and
// across.
void vote_on_mirror(double held, double eye, double held_across, double eye_across, TimeNs stamp_ns,
                    GazeCountering::Axis& axis) {
  if (std::abs(held) < kSlowestDegS) return;
  const double other = std::min(square(eye_across - held_across), square(eye_across + held_across));
  vote(square(eye - held) + other, square(eye + held) + other, stamp_ns, axis);
}

}  // namespace

double GazeCountering::Axis::evidence() const {
  return squares > 0 ? sum / std::sqrt(squares) : 0;
}

namespace {

bool is_reversed(double evidence, std::int64_t telling, std::int64_t votes, std::int64_t seconds) {
  return telling >= kFewestTelling &&
         static_cast<double>(telling) >= kFewestTellingShare * static_cast<double>(votes) &&
         evidence <= (seconds >= kManySeconds ? kReversed : kReversedInFewSeconds);
}

}  // namespace

bool GazeCountering::Axis::reversed() const {
  return is_reversed(evidence(), telling(), votes, seconds);
}

bool GazeCountering::reversed_on_both() const {
  const Axis &x = axes_[0], &y = axes_[1];
  return x.sum < 0 && y.sum < 0 &&
         is_reversed((x.evidence() + y.evidence()) / std::sqrt(2.0), x.telling() + y.telling(),
                     x.votes + y.votes, std::max(x.seconds, y.seconds));
}

bool GazeCountering::exchanged() const {
  return std::any_of(exchanged_.begin(), exchanged_.end(), [](const Axis& axis) { return axis.reversed(); });
}

double GazeCountering::evidence_not_exchanged() const {
  double least = exchanged_[0].evidence();
  for (const Axis& axis : exchanged_) least = std::min(least, axis.evidence());
  return least;
}

std::int64_t GazeCountering::segment_of(TimeNs stamp_ns) const {
  return (stamp_ns - first_ns_) / kSegmentNs;
}

void GazeCountering::add(const PoseRow& row) {
  if (kept_.empty())
    first_ns_ = row.stamp_ns;
  else if (row.stamp_ns - kept_.back().stamp_ns < kSpacingNs)
    return;
  if (segment_of(row.stamp_ns) % stride_ != 0) return;
  if (kept_.size() == kMostKept) thin_out();
  if (segment_of(row.stamp_ns) % stride_ != 0) return;
  if (kept_.size() == kept_.capacity())
    kept_.reserve(std::min(kMostKept, std::max<std::size_t>(1024, 2 * kept_.capacity())));
  kept_.push_back({row.stamp_ns, glm::quat(row.world_from_head.orientation)});
}

void GazeCountering::thin_out() {
  stride_ *= 2;
  std::erase_if(kept_, [&](const Kept& kept) { return segment_of(kept.stamp_ns) % stride_ != 0; });
}

// Times never decrease.
std::optional<glm::dquat> GazeCountering::head_at(TimeNs stamp_ns) {
  while (place_ + 1 < kept_.size() && kept_[place_ + 1].stamp_ns <= stamp_ns) ++place_;
  if (place_ + 1 >= kept_.size() || kept_[place_].stamp_ns > stamp_ns) return std::nullopt;
  const Kept &a = kept_[place_], &b = kept_[place_ + 1];
  const TimeNs gap_ns = b.stamp_ns - a.stamp_ns;
  if (gap_ns > kLongestPoseGapNs) return std::nullopt;
  const double share = static_cast<double>(stamp_ns - a.stamp_ns) / static_cast<double>(gap_ns);
  return turn_from_to(glm::normalize(glm::dquat(a.world_from_head)),
                      glm::normalize(glm::dquat(b.world_from_head)), share);
}

void GazeCountering::add(const GazeRow& row) {
  if (!row.valid[0] && !row.valid[1]) {
    from_.reset();
    return;
  }
  if (from_ && row.stamp_ns - from_->stamp_ns < kWindowNs - kSlackNs) return;
  const std::size_t one = row.valid[0] ? 0 : 1, other = row.valid[1] ? 1 : 0;
  const std::optional<glm::dquat> head = head_at(row.stamp_ns);
  if (!head) {
    from_.reset();
    return;
  }
  const Look to{row.stamp_ns, glm::normalize(row.head_direction[one] + row.head_direction[other]), *head};
  if (from_ && to.stamp_ns - from_->stamp_ns <= kLongestWindowNs) compare(*from_, to);
  from_ = to;
}

void GazeCountering::compare(const Look& from, const Look& to) {
  const double seconds = static_cast<double>(to.stamp_ns - from.stamp_ns) * kSecondsPerNs;
  const glm::dvec3 held = glm::conjugate(to.world_from_head) * (from.world_from_head * from.direction);
  const Angles before = angles_of(from.direction);
  const Angles held_deg_s = speed(before, angles_of(held), seconds);
  const Angles eye_deg_s = speed(before, angles_of(to.direction), seconds);
  vote_on_mirror(held_deg_s.x, eye_deg_s.x, held_deg_s.y, eye_deg_s.y, to.stamp_ns, axes_[0]);
  vote_on_mirror(held_deg_s.y, eye_deg_s.y, held_deg_s.x, eye_deg_s.x, to.stamp_ns, axes_[1]);
  vote_on_exchange(held_deg_s.x, held_deg_s.y, eye_deg_s.x, eye_deg_s.y, to.stamp_ns);
  const double turn_deg_s = std::hypot(held_deg_s.x, held_deg_s.y);
  if (turn_deg_s < kTurningDegS) return;
  ++turning_;
  if (std::hypot(eye_deg_s.x, eye_deg_s.y) < kRestingShare * turn_deg_s) ++resting_;
}

void GazeCountering::vote_on_exchange(double held_x, double held_y, double eye_x, double eye_y,
                                      TimeNs stamp_ns) {
  if (std::hypot(held_x, held_y) < kSlowestDegS) return;
  const double as_is = square(eye_x - held_x) + square(eye_y - held_y);
  constexpr std::array<std::array<double, 2>, 4> kSigns{{{1, 1}, {-1, -1}, {-1, 1}, {1, -1}}};
  for (std::size_t i = 0; i < kSigns.size(); ++i)
    vote(as_is, square(kSigns[i][0] * eye_y - held_x) + square(kSigns[i][1] * eye_x - held_y), stamp_ns,
         exchanged_[i]);
}

}  // namespace herr
