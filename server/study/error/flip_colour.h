// The colour spaces of FLIP: YCxCz, in which contrast sensitivity is filtered, and CIELAB with Hunt's effect,
// in which differences are large or small. Before: linear light of sRGB's primaries. After: flip.cpp.
#pragma once

#include <array>
#include <cstddef>

#include "server/study/error/flip_filters.h"

namespace herr {

// One block of pixels, channel by channel.
using FlipBlock = std::array<std::array<float, kFlipBlock>, 3>;

// Red, green and blue to Y, Cx and Cz, in place.
void ycxcz_from_linear(FlipBlock& block);
// Y, Cx and Cz to L, a and b by way of red, green and blue limited to [0, 1]; a and b times L / 100. In
// place.
void hunt_lab_from_ycxcz(FlipBlock& block);

// The difference of two colours in L, a, b that observers see, in [0, 1] for colours of sRGB: HyAB to the
// power 0.7, what lies below 0.4 of green against blue spread over [0, 0.95].
float flip_colour_difference(float lightness, float a, float b);

}  // namespace herr
