// Small parts of an environment picture that outshine the rest, as light from discs: suns, lamps. What is
// left of the picture is so even that a few look-ups of its filtered forms stand for a lobe, and GGX has a
// closed form over a disc (highlights/disc_lobe-inl.h).
// Source of the division: Debevec, "A Median Cut Algorithm for Light Probe Sampling", 2005; cut here where
// the parts are smallest, not where they are equal.
#pragma once

#include <vector>

#include "renderer/environment/picture_pyramid.h"
#include "renderer/tiles/environment_record.h"

namespace herr {

// What exceeds this times the picture's mean may belong to a bright source.
inline constexpr double kBrightTimesMean = 8.0;
// Radians from the middle of a source to its rim at most: what is wider is even enough for the picture.
inline constexpr double kWidestRim = 0.1;
inline constexpr int kMostParts = 128;  // of each source

// A source whose rim is more texels than this from its middle is wide: a lobe narrower than a texel sees it
// in the picture, since its parts would show as bumps.
inline constexpr double kWideTexels = 2.5;

struct BrightLight {
  // kMostBrightSources at most, as seen in an unturned picture; `small` of them stand before the wide ones.
  std::vector<BrightSource> sources;
  int small = 0;
  SkyPicture without_small;  // the picture but for those; empty where no source is wide
  std::vector<BrightDisc> parts;
};

// Takes the bright sources out of `picture`, what is too bright of them, hue and all. Empty where nothing is.
BrightLight take_bright_sources(SkyPicture& picture);

}  // namespace herr
