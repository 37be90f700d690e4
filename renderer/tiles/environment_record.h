// An equirectangular picture of the light that comes from outside the scene, as the kernels read it, and what
// is made of it for surfaces that blur it. Before: scenes/ decodes the file; environment/ filters it. After:
// environment/environment-inl.h and filtered_lookup-inl.h look directions up.
#pragma once

namespace herr {

// Row 0 lies at the zenith. Columns run clockwise as seen from above; the middle of the picture lies `turn`
// turns counter-clockwise of -Z of the world.
struct EnvironmentRecord {
  const float* texels = nullptr;  // four floats each: R, G, B, unused; null: there is no picture
  int width = 0, height = 0;
  float turn = 0;  // [0, 1)
};

inline constexpr int kMostFilteredLevels = 12;
inline constexpr int kMostBrightSources = 32;

// Light from an even disc, as small as the sun or a lamp.
struct BrightDisc {
  float direction[3] = {};  // towards it, unit
  float irradiance[3] = {};
  float half_turn2 = 0;  // square of what a half vector turns from its middle to its rim
};

// A small part of the picture that outshines the rest: as a whole, and as what it is made of.
struct BrightSource : BrightDisc {
  int first_part = 0, parts = 0;
};

// The picture as GGX highlights of growing width show it head on: level k, of alpha first_alpha times
// ratio^k, is the mean over the lobe of (n = v = r), without the bright sources, which lobes take by
// themselves. Narrower lobes lie between the picture itself and level 0, by their tails, which grow with
// alpha^2.
struct FilteredRecord {
  const float* texels = nullptr;  // of all levels, as EnvironmentRecord's; null: none was made
  int levels = 0;
  float first_alpha = 0, levels_per_octave = 0;  // per doubling of alpha
  // Of a lobe that shows no bumps where a wide source is made of parts.
  float smooth_alpha = 0;
  int first_texel[kMostFilteredLevels] = {}, width[kMostFilteredLevels] = {},
      height[kMostFilteredLevels] = {};
  int source_count = 0, small_sources = 0;   // the small ones stand first; the others are wide
  BrightSource sources[kMostBrightSources];  // in the world
  EnvironmentRecord without_small;           // the picture without small sources; none where none is wide
  const BrightDisc* parts = nullptr;         // of all sources, in the unturned picture
  float turn_cosine = 1, turn_sine = 0;      // of EnvironmentRecord::turn
  EnvironmentRecord even;    // mean radiance that a surface facing the direction receives: irradiance / pi
  EnvironmentRecord coarse;  // the picture as rays see it that stand for a whole texel of it
};

}  // namespace herr
