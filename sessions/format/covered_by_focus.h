// Where a display shows a focus viewport and nothing of the context viewport below it. Before: display
// profile. After: pixels that nobody sees count in no error, and need not be rendered.
#pragma once

#include <cstddef>

#include "sessions/format/display_profile.h"

namespace herr {

// Whether the point of the viewport with number `viewport` in direction (tan_x, tan_y, -1) lies within a
// focus viewport of the same eye, at or beyond the inner end of its blend from all four borders. Never for a
// point of a focus viewport.
bool covered_by_focus(const DisplayProfile& profile, std::size_t viewport, double tan_x, double tan_y);

}  // namespace herr
