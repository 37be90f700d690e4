// The part of the report that says how finely frames sample what the eyes see: a table, and a plot of samples
// per degree over eccentricity. ASCII, 80 columns wide. Before: acuity_facts. After: inspect_text.
#pragma once

#include <string>

#include "server/inspect/acuity/acuity_facts.h"

namespace herr {

std::string acuity_text(const AcuityFacts& facts);

// Samples per degree (logarithmic) over eccentricity (evenly along the polar radius): 'f' the acuity
// function, 'r' along the radius, 'a' around the circle, 'd' pixels of the display, '+' where several fall
// together.
std::string acuity_plot(const std::vector<AcuityPoint>& points);

}  // namespace herr
