// The difference that an observer sees when flipping between two pictures, per pixel in [0, 1].
// Source: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images" (HPG 2020), with the
// constants of that paper.
#pragma once

#include <vector>

#include "server/study/error/linear_picture.h"
#include "server/study/error/picture_errors.h"

namespace herr {

// Both limited to white and of one size; linear light with the primaries of sRGB. `pixels_per_degree`: of the
// viewer, > 0; more than 500 are taken as 500. `out`: width * height values, rows from the top; its storage
// is kept. Borders repeat.
void flip_map(const LinearPicture& test, const LinearPicture& reference, double pixels_per_degree,
              const ParallelFor& parallel_for, std::vector<float>& out);

}  // namespace herr
