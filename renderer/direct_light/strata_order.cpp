#include "renderer/direct_light/strata_order.h"

#include <algorithm>
#include <numeric>

#include "renderer/broken_on_purpose.h"

namespace herr {
namespace {

// Which halves a stratum lies in, the whole lamp's first, as bits from the lowest on: of the part that is
// left, the longest edge is cut.
std::uint32_t halves_of(const LightRecord& light, int stratum) {
  const int nx = light.strata[0], ny = light.strata[1];
  const int cell[3] = {stratum % nx, stratum / nx % ny, stratum / (nx * ny)};
  int begin[3] = {0, 0, 0}, end[3] = {nx, ny, light.strata[2]};
  std::uint32_t halves = 0;
  for (int depth = 0;; ++depth) {
    int longest = -1;
    float length = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const int strata = end[axis] - begin[axis];
      const float edge =
          light.size[axis] * static_cast<float>(strata) / static_cast<float>(light.strata[axis]);
      if (strata > 1 && edge > length) longest = axis, length = edge;
    }
    if (longest < 0) return halves;
    const int middle = (begin[longest] + end[longest] + 1) / 2;
    if (cell[longest] < middle) {
      end[longest] = middle;
    } else {
      begin[longest] = middle;
      halves |= 1u << depth;
    }
  }
}

}  // namespace

void order_strata(LightRecord& light) {
  const auto begin = light.order.begin(), end = begin + light.samples;
  std::iota(begin, end, 0);
  if constexpr (kFault == Fault::biased_adaptive_samples) {
    for (int& stratum : light.order) stratum /= 2;
    return;
  }
  std::array<std::uint32_t, kMostOrderedSamples> halves;
  for (int stratum = 0; stratum < light.samples; ++stratum)
    halves[static_cast<std::size_t>(stratum)] = halves_of(light, stratum);
  std::sort(begin, end, [&](std::int32_t a, std::int32_t b) {
    return halves[static_cast<std::size_t>(a)] < halves[static_cast<std::size_t>(b)];
  });
}

}  // namespace herr
