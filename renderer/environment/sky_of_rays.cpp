#include "renderer/environment/sky_of_rays.h"

#include <algorithm>
#include <array>
#include <glm/vec4.hpp>
#include <span>

#include "renderer/probes/probe_view.h"
#include "renderer/render_settings.h"

namespace herr {
namespace {

using Seen = std::array<glm::dvec4, kMostProbeRays>;

// Shares of one node: `whole` without and with sources over what its rays see of them.
void share_out(std::span<const ProbeDirections::Weight> weights, const Seen& seen, const glm::dvec3& rest,
               const glm::dvec3& sources, std::vector<ProbeDirections::SkyShare>& out) {
  glm::dvec4 sum{0.0};
  for (const auto& [ray, weight] : weights) sum += double{weight} * seen[static_cast<std::size_t>(ray)];
  for (const auto& [ray, weight] : weights) {
    const glm::dvec4 share = double{weight} * seen[static_cast<std::size_t>(ray)];
    // Of light that no ray sees each brings as much.
    const auto of = [&](int c) { return sum[c] > 0 ? share[c] / sum[c] : double{weight}; };
    ProbeDirections::SkyShare& to = out.emplace_back();
    for (int c = 0; c < 3; ++c) to.light[c] = static_cast<float>(rest[c] * of(c) + sources[c] * of(3));
  }
}

}  // namespace

void aim_sky(ProbeDirections& directions, const std::vector<glm::dvec3>& node_directions,
             const FilteredEnvironment& environment, float turn) {
  Seen seen;
  for (std::size_t i = 0; i < directions.x.size(); ++i) {
    seen[i] = environment.seen_by_rays({directions.x[i], directions.y[i], directions.z[i]}, turn);
  }
  directions.sky.clear();
  directions.sky_nodes.resize(std::size_t{4} * LightNodes::kCount);
  int at = 0;  // node of the map whose direction is the next
  std::array<float, 4> all{};
  for (std::size_t node = 0; node < node_directions.size(); ++node) {
    const auto first = static_cast<std::size_t>(directions.first_weight[node]),
               end = static_cast<std::size_t>(directions.first_weight[node + 1]);
    const glm::dvec3 rest = environment.even_rest(node_directions[node], turn),
                     sources = environment.even_sources(node_directions[node], turn);
    share_out(std::span(directions.weights).subspan(first, end - first), seen, rest, sources, directions.sky);
    for (int c = 0; c < 3; ++c) all[static_cast<std::size_t>(c)] = static_cast<float>(rest[c] + sources[c]);
    while (at < LightNodes::kCount && LightNodes::first_of(at) != at) ++at;
    if (at < LightNodes::kCount) std::copy(all.begin(), all.end(), directions.sky_nodes.begin() + 4 * at++);
  }
  for (int node = 0; node < LightNodes::kCount; ++node) {
    std::copy_n(directions.sky_nodes.begin() + 4 * LightNodes::first_of(node), 4,
                directions.sky_nodes.begin() + 4 * node);
  }
}

}  // namespace herr
