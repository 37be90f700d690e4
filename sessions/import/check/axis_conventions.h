// The axes that programs write: engines, runtimes, robotics, computer vision. Before: nothing. After:
// proposal tries each on the data.
#pragma once

#include <array>
#include <span>
#include <string>

#include "sessions/import/map/axis_directions.h"

namespace herr {

struct AxisConvention {
  const char* name;                        // as users say it
  std::array<const char*, 3> world, head;  // where x, y and z point
};

std::span<const AxisConvention> axis_conventions();
AxisDirections directions(const std::array<const char*, 3>& words);

}  // namespace herr
