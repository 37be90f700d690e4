// The 99.9th percentile of many values by band. Before: the largest difference of each pixel. After: a
// metric. A histogram finds the narrow range of values that holds the percentile; only what lies there is
// sorted, so the answer is exact.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "server/study/error/picture_errors.h"
#include "server/study/error/viewport_map.h"

namespace herr {

// `values`: of each pixel of each map, in [0, 1]. The value of rank ceil(0.999 n); NaN where a band has no
// pixel.
std::array<double, kBands> high_percentiles(std::span<const ViewportMap> maps,
                                            std::span<const std::vector<float>> values,
                                            const ParallelFor& parallel_for);

}  // namespace herr
