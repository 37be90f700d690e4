// The axes that programs write: engines, runtimes, robotics, computer vision. Before: nothing. After:
// axis_trials tries each on the data.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "sessions/import/map/axis_directions.h"

namespace herr {

struct AxisConvention {
  // The first ones of the list.
  enum Name : std::size_t { unity, openxr, ros, unreal, y_forward, camera_z_up, camera_y_up, camera_y_down };
  const char* words;                       // as users say it
  std::array<const char*, 3> world, head;  // where x, y and z point
};

std::span<const AxisConvention> axis_conventions();
AxisDirections directions(const std::array<const char*, 3>& words);

}  // namespace herr
