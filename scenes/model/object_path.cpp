#include "scenes/model/object_path.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

// Stays between a and b whatever is rounded, and is a where they are equal.
glm::dvec3 on_line(const glm::dvec3& a, const glm::dvec3& b, double share) {
  return {std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share), std::lerp(a.z, b.z, share)};
}

// A turn that rests must not waver in its last bits: it would count as a move.
glm::dquat on_arc(const glm::dquat& a, const glm::dquat& b, double share) {
  if (a == b || a == -b) return a;
  return glm::normalize(glm::slerp(a, b, share));
}

}  // namespace

Placement ObjectPath::at(double time_s) const {
  const double length_s = keys.back().time_s;
  if (loop && length_s > 0 && time_s >= length_s) time_s = std::fmod(time_s, length_s);
  const auto next = std::upper_bound(keys.begin(), keys.end(), time_s,
                                     [](double t, const PathKey& key) { return t < key.time_s; });
  if (next == keys.begin()) return keys.front().placement;
  const PathKey& last = *(next - 1);
  if (next == keys.end() || time_s == last.time_s) return last.placement;
  const double share = (time_s - last.time_s) / (next->time_s - last.time_s);
  const Placement &a = last.placement, &b = next->placement;
  return {on_line(a.translation, b.translation, share), on_arc(a.rotation, b.rotation, share),
          on_line(a.scale, b.scale, share)};
}

}  // namespace herr
