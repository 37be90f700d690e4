// Samples per degree over eccentricity as an SVG file: the acuity function, what frames reach along the
// radius and around the circle, the pixels of the display. Both axes are logarithmic. Before: acuity_facts.
// After: `herr inspect --acuity-plot`.
#pragma once

#include <string>

#include "server/inspect/acuity/acuity_facts.h"

namespace herr {

std::string acuity_picture(const AcuityFacts& facts, const RenderSettings& settings);

}  // namespace herr
