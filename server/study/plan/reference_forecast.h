// Whether the references of a study leave room for its settings, foretold from the first pass. Before: what
// that pass took. After: study_run says so and makes coarser ones.
#pragma once

#include <string>

#include "renderer/render_settings.h"

namespace herr {

// To try where the time is short: frames are seconds, and what foveation does shows.
inline constexpr double kSmallScale = 0.4;
// Times what is foretold: estimates are off, and machines busy.
inline constexpr double kReserve = 1.25;

// One line where the two references of a first frame, of two passes in each half, will take more than half of
// `minutes`: how long, what is done about it, what to type instead; empty where they fit. `two_passes_s`:
// that setting up and two passes of each half of the first reference take. `asked`, `profile_scale`: of the
// study.
std::string too_long_references(double two_passes_s, double minutes, const RenderSettings& asked,
                                double profile_scale);

}  // namespace herr
