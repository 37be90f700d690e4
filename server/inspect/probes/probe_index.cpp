#include "server/inspect/probes/probe_index.h"

#include <nlohmann/json.hpp>

#include "server/process/version.h"
#include "server/results/summary_json.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

template <typename Vector>
Json vector_json(const Vector& v) {
  return Json::array({v[0], v[1], v[2]});
}

Json grid_json(const ProbeGrid& grid) {
  return {{"counts", vector_json(grid.counts)},
          {"lower_m", vector_json(grid.lower)},
          {"spacing_m", vector_json(grid.spacing)},
          {"place", "probe (x, y, z) of the grid: lower + (index + 1/2) * spacing, before it was relocated"}};
}

Json atlas_json(const AtlasFiles& atlas) {
  const bool light = atlas.quantity == "irradiance";
  const int nodes = light ? LightNodes::kStride : DistanceNodes::kStride;
  Json channels = Json::array();
  if (light) {
    channels = {{{"name", "R, G, B"},
                 {"unit", "W/m^2"},
                 {"what", "irradiance of a surface whose normal is the node's direction"}}};
  } else {
    channels = {{{"name", "distance"}, {"unit", "m"}, {"what", "to what is seen there; 0: nothing is"}},
                {{"name", "deviation"},
                 {"unit", "1/m"},
                 {"what", "of the inverse of |x| + |y| + |z| of what is seen: what interpolation may miss"}}};
  }
  return {{"set", atlas.set},
          {"quantity", atlas.quantity},
          {"exr", atlas.exr},
          {"png", atlas.png},
          {"nodes", nodes},
          {"tile_px", tile_px(nodes)},
          {"channels", channels},
          {"png_white", atlas.png_white},
          {"png_enlarge", atlas.png_enlarge}};
}

Json layout_json(const AtlasLayout& layout) {
  return {{"tiles", Json::array({layout.columns, layout.rows})},
          {"border_px", kTileBorderPx},
          {"node_pixel", "tile * tile_px + border_px + (column, row), from the upper left"},
          {"node_direction",
           "octahedral: (px, py) = 2 * (column, row) / (nodes - 1) - 1, pz = 1 - |px| - |py|; where pz < 0 "
           "(px, py) = (sign(px) * (1 - |py|), sign(py) * (1 - |px|)); then normalised, world axes"},
          {"interpolation", "by triangles cut parallel to the outer fold |px| + |py| = 1"},
          {"png_borders", "grey active, orange relocated, blue dark, none far"}};
}

Json probe_json(const ProbeReader& probes, const AtlasLayout& layout, int probe) {
  const glm::ivec2 tile = layout.tiles[static_cast<std::size_t>(probe)];
  return {{"at", vector_json(probes.grid().place(probe))},
          {"tile", Json::array({tile.x, tile.y})},
          {"state", name_of(probes.state(probe))},
          {"relocated", probes.relocated(probe)},
          {"position_m", vector_json(probes.position(probe))}};
}

}  // namespace

std::string probe_index_text(const ProbeReader& probes, const AtlasLayout& layout,
                             const std::vector<AtlasFiles>& atlases, const ProbeScene& from,
                             const ProbeDump& dump) {
  Json json{{"format_version", 1},
            {"program", program_with_version()},
            {"scene", from.scene.name},
            {"isa", name_of(resolve_isa(from.settings.isa))},
            {"grid", grid_json(probes.grid())},
            {"updates", dump.updates},
            {"update_hz", dump.display_hz},
            {"rays_per_update", dump.rays},
            {"hysteresis_tau_s", from.settings.probes.hysteresis_tau_s},
            {"lights", "held where they are at the session's start"},
            {"variability", dump.variability},
            {"counts",
             {{"probes", dump.probes},
              {"active", dump.active},
              {"relocated", dump.relocated},
              {"inactive", dump.dark + dump.far},
              {"dark", dump.dark},
              {"far", dump.far}}},
            {"layout", layout_json(layout)}};
  Json& list = json["atlases"] = Json::array();
  for (const AtlasFiles& atlas : atlases) list.push_back(atlas_json(atlas));
  std::string text = json_text(json);
  text.resize(text.rfind('}'));
  while (text.back() == '\n') text.pop_back();
  text += ",\n  \"probes\": [";
  for (int probe = 0; probe < probes.grid().size(); ++probe) {
    text += (probe == 0 ? "\n    " : ",\n    ") + probe_json(probes, layout, probe).dump();
  }
  return text + "\n  ]\n}\n";
}

}  // namespace herr
