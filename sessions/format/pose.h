// Time stamps, poses, and sampled values that say how they were obtained.
// World: right-handed, metres, +Y up, -Z forward (OpenXR, glTF). Time: integer nanoseconds.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace herr {

using TimeNs = std::int64_t;

inline constexpr double kSecondsPerNs = 1e-9;

// A rigid transform a_from_b: maps a point of frame b to frame a.
struct Pose {
  glm::dvec3 position{0.0};                    // origin of b in a, metres
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // unit quaternion (w, x, y, z in GLM's constructor)

  bool operator==(const Pose&) const = default;
  glm::dvec3 operator()(const glm::dvec3& point) const { return orientation * point + position; }
};

// a_from_c = a_from_b * b_from_c.
inline Pose operator*(const Pose& a_from_b, const Pose& b_from_c) {
  return {a_from_b(b_from_c.position), glm::normalize(a_from_b.orientation * b_from_c.orientation)};
}

inline Pose inverse(const Pose& a_from_b) {
  const glm::dquat back = glm::conjugate(a_from_b.orientation);
  return {back * -a_from_b.position, back};
}

// How the value of a stream at a time was obtained.
enum class SampleSource : std::uint8_t {
  exact,         // a sample bears this very stamp
  held,          // the newest sample at or before the time
  interpolated,  // between two samples; not causal, its age is meaningless
  predicted,     // extrapolated at constant velocity up to the cap
  gliding,       // gaze lost: on its way from the last valid direction to the centre
  centred,       // gaze lost for long, or never seen: straight ahead
};
const char* name_of(SampleSource source);

struct SampledPose {
  Pose world_from_head;
  SampleSource source = SampleSource::held;
  TimeNs stamp_ns = 0;  // stamp of the newest sample used
  TimeNs age_ns = 0;    // sampling time minus stamp_ns; -1 when not meaningful (interpolated)
};

// How fast the head moves, as far as the newest pose tells (streams/head_speed.h).
struct HeadSpeed {
  double turn_rad_s = 0, move_m_s = 0;  // 0 or more
};

}  // namespace herr
