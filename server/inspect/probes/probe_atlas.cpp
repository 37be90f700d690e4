#include "server/inspect/probes/probe_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

namespace herr {
namespace {

constexpr int kWidestAtlasTiles = 900;  // of distance tiles: 31,500 pixels
constexpr int kEnlargedPx = 3072;       // small atlases are enlarged for the eye up to this
constexpr double kBrightShare = 0.99;   // of all lit nodes: the rest may be clipped to white

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kActive{90, 90, 90}, kRelocated{230, 140, 20}, kDark{40, 70, 200}, kFar{0, 0, 0};
constexpr Rgb kNothingSeen{70, 110, 160};

int ceil_div(int a, int b) {
  return (a + b - 1) / b;
}

// Columns of `count` things of size w x h that make the picture most nearly square.
int squarest(int count, int w, int h) {
  int best = 1;
  for (int columns = 2; columns <= count; ++columns) {
    const auto longest = [&](int c) { return std::max(c * w, ceil_div(count, c) * h); };
    if (longest(columns) < longest(best)) best = columns;
  }
  return best;
}

FloatPlanes empty_atlas(const AtlasLayout& layout, int nodes, const std::vector<std::string>& channels) {
  FloatPlanes atlas;
  atlas.width_px = layout.columns * tile_px(nodes);
  atlas.height_px = layout.rows * tile_px(nodes);
  const auto pixels = static_cast<std::size_t>(atlas.width_px) * static_cast<std::size_t>(atlas.height_px);
  for (const std::string& name : channels) atlas.channels.emplace_back(name, std::vector<float>(pixels));
  return atlas;
}

// Index of the pixel that holds a node of a probe's map.
std::size_t pixel_of(const FloatPlanes& atlas, const glm::ivec2& tile, int nodes, int node) {
  const int x = tile.x * tile_px(nodes) + kTileBorderPx + node % nodes;
  const int y = tile.y * tile_px(nodes) + kTileBorderPx + node / nodes;
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width_px) + static_cast<std::size_t>(x);
}

Rgb border_of(const ProbeReader& probes, int probe) {
  switch (probes.state(probe)) {
    case ProbeState::active:
      return probes.relocated(probe) ? kRelocated : kActive;
    case ProbeState::dark:
      return kDark;
    case ProbeState::far:
      return kFar;
  }
  return kFar;
}

// The value below which kBrightShare of those above 0 lie; 1 where there are none.
double bright_value(std::vector<float> values) {
  std::erase_if(values, [](float value) { return !(value > 0.0f); });
  if (values.empty()) return 1.0;
  const auto at = static_cast<std::ptrdiff_t>(kBrightShare * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return double{values[static_cast<std::size_t>(at)]};
}

std::uint8_t eight_bits(double encoded) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(encoded, 0.0, 1.0)));
}

// `colour(pixel)`: of the pixel with that index in the atlas; borders come on top.
template <typename Colour>
AtlasPicture draw(const FloatPlanes& atlas, const ProbeReader& probes, const AtlasLayout& layout, int nodes,
                  const Colour& colour) {
  AtlasPicture out;
  out.enlarge = std::clamp(kEnlargedPx / std::max(atlas.width_px, atlas.height_px), 1, 4);
  out.image.width_px = atlas.width_px * out.enlarge;
  out.image.height_px = atlas.height_px * out.enlarge;
  out.image.values.resize(3 * static_cast<std::size_t>(out.image.width_px) *
                          static_cast<std::size_t>(out.image.height_px));
  const auto put = [&](int x, int y, const Rgb& rgb) {
    for (int row = y * out.enlarge; row < (y + 1) * out.enlarge; ++row) {
      const auto first = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(out.image.width_px) +
                              static_cast<std::size_t>(x * out.enlarge));
      for (int i = 0; i < out.enlarge; ++i)
        std::copy(
            rgb.begin(), rgb.end(),
            out.image.values.begin() + static_cast<std::ptrdiff_t>(first + 3 * static_cast<std::size_t>(i)));
    }
  };
  const int side = tile_px(nodes);
  for (int probe = 0; probe < probes.grid().size(); ++probe) {
    const glm::ivec2 corner = layout.tiles[static_cast<std::size_t>(probe)] * side;
    const bool known = probes.state(probe) != ProbeState::far;
    const Rgb border = border_of(probes, probe);
    for (int y = corner.y; y < corner.y + side; ++y) {
      for (int x = corner.x; x < corner.x + side; ++x) {
        const bool inside = x >= corner.x + kTileBorderPx && x < corner.x + side - kTileBorderPx &&
                            y >= corner.y + kTileBorderPx && y < corner.y + side - kTileBorderPx;
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width_px) +
                           static_cast<std::size_t>(x);
        put(x, y, inside && known ? colour(pixel) : border);
      }
    }
  }
  return out;
}

}  // namespace

AtlasLayout lay_out_probes(const ProbeGrid& grid) {
  AtlasLayout layout;
  const glm::ivec3 n = grid.counts;
  layout.tiles.resize(static_cast<std::size_t>(grid.size()));
  const bool layers = n.x <= kWidestAtlasTiles && n.y <= kWidestAtlasTiles;
  const int across = layers ? squarest(n.z, n.x, n.y) : squarest(grid.size(), 1, 1);
  layout.columns = layers ? across * n.x : across;
  layout.rows = layers ? ceil_div(n.z, across) * n.y : ceil_div(grid.size(), across);
  for (int probe = 0; probe < grid.size(); ++probe) {
    const glm::ivec3 at = grid.place(probe);
    const glm::ivec2 in_layers{at.z % across * n.x + at.x, at.z / across * n.y + n.y - 1 - at.y};
    layout.tiles[static_cast<std::size_t>(probe)] =
        layers ? in_layers : glm::ivec2{probe % across, probe / across};
  }
  return layout;
}

FloatPlanes irradiance_atlas(const ProbeReader& probes, int set, const AtlasLayout& layout) {
  FloatPlanes atlas = empty_atlas(layout, LightNodes::kStride, {"R", "G", "B"});
  ProbeReader::Light light;
  for (int probe = 0; probe < probes.grid().size(); ++probe) {
    if (probes.state(probe) == ProbeState::far) continue;
    probes.irradiance(set, probe, light);
    for (int node = 0; node < LightNodes::kCount; ++node) {
      const std::size_t pixel =
          pixel_of(atlas, layout.tiles[static_cast<std::size_t>(probe)], LightNodes::kStride, node);
      for (int c = 0; c < 3; ++c)
        atlas.channels[static_cast<std::size_t>(c)].second[pixel] = light[static_cast<std::size_t>(node)][c];
    }
  }
  return atlas;
}

FloatPlanes distance_atlas(const ProbeReader& probes, int set, const AtlasLayout& layout) {
  FloatPlanes atlas = empty_atlas(layout, DistanceNodes::kStride, {"distance", "deviation"});
  const auto sight = std::make_unique<ProbeReader::Sight>();
  for (int probe = 0; probe < probes.grid().size(); ++probe) {
    if (probes.state(probe) == ProbeState::far) continue;
    probes.sight(set, probe, *sight);
    for (int node = 0; node < DistanceNodes::kCount; ++node) {
      const std::size_t pixel =
          pixel_of(atlas, layout.tiles[static_cast<std::size_t>(probe)], DistanceNodes::kStride, node);
      atlas.channels[0].second[pixel] = sight->distance_m[static_cast<std::size_t>(node)];
      atlas.channels[1].second[pixel] = sight->deviation_per_m[static_cast<std::size_t>(node)];
    }
  }
  return atlas;
}

AtlasPicture irradiance_picture(const FloatPlanes& atlas, const ProbeReader& probes,
                                const AtlasLayout& layout) {
  const double white = bright_value(atlas.channels[1].second);
  AtlasPicture out = draw(atlas, probes, layout, LightNodes::kStride, [&](std::size_t pixel) {
    Rgb rgb;
    for (std::size_t c = 0; c < 3; ++c)
      rgb[c] = eight_bits(srgb_from_linear(double{atlas.channels[c].second[pixel]} / white));
    return rgb;
  });
  out.white = white;
  return out;
}

AtlasPicture distance_picture(const FloatPlanes& atlas, const ProbeReader& probes,
                              const AtlasLayout& layout) {
  const double white = bright_value(atlas.channels[0].second);
  AtlasPicture out = draw(atlas, probes, layout, DistanceNodes::kStride, [&](std::size_t pixel) {
    const double distance = double{atlas.channels[0].second[pixel]};
    if (distance == 0) return kNothingSeen;
    const std::uint8_t grey = eight_bits(distance / white);
    return Rgb{grey, grey, grey};
  });
  out.white = white;
  return out;
}

}  // namespace herr
