// How far the viewports of a frame lie from a reference, by every metric and band. Before: read_viewport of
// both. After: a row of study.csv.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "server/study/error/linear_picture.h"
#include "server/study/error/metrics.h"
#include "server/study/error/viewport_map.h"

namespace herr {

// Runs work(i) for i in [0, count), in any order, at the same time or not.
using ParallelFor = std::function<void(int count, const std::function<void(int)>& work)>;

// One picture for each viewport of the profile, all limited to white; `test` and `reference` of the same
// sizes as `maps`. The same for any number of threads, bit for bit. Throws std::invalid_argument for other
// sizes.
ErrorTable picture_errors(std::span<const ViewportMap> maps, std::span<const LinearPicture> test,
                          std::span<const LinearPicture> reference, const ParallelFor& parallel_for);

// Of these the acuity-weighted RMSE over all pixels alone, in a fifth of the time.
double acuity_weighted_rmse(std::span<const ViewportMap> maps, std::span<const LinearPicture> test,
                            std::span<const LinearPicture> reference, const ParallelFor& parallel_for);

}  // namespace herr
