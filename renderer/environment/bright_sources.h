// Parts of an environment picture that outshine the rest, as light from few directions. A sun of a thousand
// times the sky's radiance shows in a wide highlight as an exact lobe of its own; what is left of the picture
// is so even that a few look-ups of its filtered forms stand for the lobe.
// Source of the division: Debevec, "A Median Cut Algorithm for Light Probe Sampling", 2005.
#pragma once

#include <vector>

#include "renderer/environment/picture_pyramid.h"
#include "renderer/tiles/environment_record.h"

namespace herr {

// What exceeds this times the picture's mean belongs to a bright source.
inline constexpr double kBrightTimesMean = 8.0;

// Takes what is too bright out of `picture`, hue and all, and returns it: kMostBrightSources at most, as seen
// in an unturned picture. Empty where nothing is.
std::vector<BrightSource> take_bright_sources(SkyPicture& picture);

}  // namespace herr
