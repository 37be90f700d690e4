// The order in which adaptive samples look at the strata of a lamp: halves of the lamp in turn, of each their
// halves in turn, and so on, so that 2^k strata in a row lie in 2^k different parts of it. Before: light
// records. After: rotated_strata-inl.h. Source: van der Corput's sequence, along a k-d tree of the strata.
#pragma once

#include "renderer/geometry/shading_scene.h"

namespace herr {

// Fills `order` of a light of at most kMostOrderedSamples samples: each of its strata once.
void order_strata(LightRecord& light);

}  // namespace herr
