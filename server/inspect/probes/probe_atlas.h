// The maps of all probes in one picture: a tile for each probe, layer by layer of the grid.
// Before: ProbeReader. After: probe_dump writes the pictures and the index that says how to read them.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "renderer/probes/probe_reader.h"
#include "server/output/float_exr.h"
#include "server/output/srgb_table.h"

namespace herr {

inline constexpr int kTileBorderPx = 1;  // on each side of a tile, 0 in floats, the probe's state in colour

// Where each probe's tile stands, in tiles. A layer of constant z is counts.x wide and counts.y high, its
// highest y on top; layers follow each other from the lowest z, row by row. Grids whose layers are wider than
// a picture may be are laid out in order of index.
struct AtlasLayout {
  int columns = 1, rows = 1;
  std::vector<glm::ivec2> tiles;
};
AtlasLayout lay_out_probes(const ProbeGrid& grid);

// Pixels of a tile along a side.
constexpr int tile_px(int nodes) {
  return nodes + 2 * kTileBorderPx;
}

// Channels R, G, B: irradiance in W/m^2.
FloatPlanes irradiance_atlas(const ProbeReader& probes, int set, const AtlasLayout& layout);
// Channels "distance" (metres, 0: nothing seen or not looked) and "deviation" (1/m).
FloatPlanes distance_atlas(const ProbeReader& probes, int set, const AtlasLayout& layout);

// The same for the eye. `white`: the value that becomes white. Each pixel of the atlas becomes `enlarge`^2;
// borders: grey active, orange relocated, blue dark, none far.
struct AtlasPicture {
  Srgb8Image image;
  double white = 1;
  int enlarge = 1;
};
AtlasPicture irradiance_picture(const FloatPlanes& atlas, const ProbeReader& probes,
                                const AtlasLayout& layout);
AtlasPicture distance_picture(const FloatPlanes& atlas, const ProbeReader& probes, const AtlasLayout& layout);

}  // namespace herr
