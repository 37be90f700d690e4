// What the eye can see of a difference: low-passed at the eye's limit at each pixel's eccentricity, weighted
// by how much of the eye's samples the pixel takes. Low-passing is linear: it is done to the difference.
// Source: contrast threshold of Geisler & Perry, "A real-time foveated multiresolution system for
// low-bandwidth video communication" (1998), CT(f, e) = CT0 exp(alpha f (e + e2) / e2): the finest visible
// grating has contrast 1, f_c(e) = e2 ln(1 / CT0) / (alpha (e + e2)), e2 = 2.3 deg, alpha = 0.106, CT0 =
// 1/64.
#pragma once

#include "server/study/error/linear_picture.h"
#include "server/study/error/picture_errors.h"
#include "server/study/error/viewport_map.h"

namespace herr {

// Cycles per degree: 39 at the gaze, 2.1 at 40 degrees.
double finest_visible_cycles_per_deg(double eccentricity_deg);

// Solid angle in square degrees times (2 f_c)^2: the samples that the eye needs to see it, by Nyquist's
// limit.
double acuity_weight(double eccentricity_deg, double solid_angle_sr);

// Each pixel becomes the mean of its neighbours under a Gaussian that halves a grating of f_c (its standard
// deviation is sqrt(ln 2 / 2) / (pi f_c) degrees): first along rows, then along columns, each with the width
// that the pixel's own size asks for. Pixels that are not seen have no weight, and become 0. Gaussians
// narrower than 0.15 pixels leave a pixel as it is, those wider than 64 pixels are cut to that. In place.
void low_pass_at_acuity(const ViewportMap& map, LinearPicture& difference, const ParallelFor& parallel_for);

}  // namespace herr
