#include "sessions/import/check/axis_conventions.h"

namespace herr {
namespace {

constexpr std::array<AxisConvention, 11> kConventions{{
    {"Unity (left-handed, y up)", {"right", "up", "forward"}, {"right", "up", "forward"}},
    {"OpenXR (right-handed, y up)", {"right", "up", "back"}, {"right", "up", "back"}},
    {"ROS (x forward, z up)", {"forward", "left", "up"}, {"forward", "left", "up"}},
    {"Unreal (left-handed, x forward, z up)", {"forward", "right", "up"}, {"forward", "right", "up"}},
    {"a head with y forward and z up", {"right", "forward", "up"}, {"right", "forward", "up"}},
    {"a camera (y down, z forward) in a world with z up",
     {"right", "forward", "up"},
     {"right", "down", "forward"}},
    {"a camera (y down, z forward) in a world with y up",
     {"right", "up", "back"},
     {"right", "down", "forward"}},
    {"a camera (y down, z forward) in a world with y down",
     {"right", "down", "forward"},
     {"right", "down", "forward"}},
    {"OpenXR's head in a world with z up", {"right", "forward", "up"}, {"right", "up", "back"}},
    {"glasses (x left, y up, z forward) in a world with z up",
     {"right", "forward", "up"},
     {"left", "up", "forward"}},
    {"aircraft (x forward, y right, z down)", {"forward", "right", "down"}, {"forward", "right", "down"}},
}};

}  // namespace

std::span<const AxisConvention> axis_conventions() {
  return kConventions;
}

AxisDirections directions(const std::array<const char*, 3>& words) {
  return *AxisDirections::from_words({words[0], words[1], words[2]});
}

}  // namespace herr
