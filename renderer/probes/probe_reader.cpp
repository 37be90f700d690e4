#include "renderer/probes/probe_reader.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/ext/scalar_constants.hpp>

#include "renderer/probes/probe_volume.h"

namespace herr {
namespace {

double norm_of(const glm::dvec3& d) {
  return std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
}

// The layout is that of kLightWords.
glm::vec3 unpacked_light(const std::uint32_t* words) {
  return {std::bit_cast<float>((words[0] >> 11) << 10), std::bit_cast<float>((words[1] >> 11) << 10),
          std::bit_cast<float>((words[0] & 0x7ffu) << 20 | (words[1] & 0x3ffu) << 10)};
}

}  // namespace

const char* name_of(ProbeState state) {
  switch (state) {
    case ProbeState::active:
      return "active";
    case ProbeState::dark:
      return "dark";
    case ProbeState::far:
      return "far";
  }
  return "";
}

const ProbeGrid& ProbeReader::grid() const {
  return volume_.grid;
}

int ProbeReader::rays() const {
  return volume_.settings.rays;
}

int ProbeReader::sets() const {
  return static_cast<int>(volume_.sets.size());
}

ProbeState ProbeReader::state(int probe) const {
  if (!volume_.is_near(probe)) return ProbeState::far;
  return volume_.asleep(probe) ? ProbeState::dark : ProbeState::active;
}

bool ProbeReader::relocated(int probe) const {
  return volume_.relocated_[static_cast<std::size_t>(probe)];
}

glm::dvec3 ProbeReader::position(int probe) const {
  const ProbeGrid& grid = volume_.grid;
  if (!volume_.is_near(probe)) return grid.lower + grid.position(grid.place(probe));
  const float* place = volume_.view(0, grid.lower).places + 4 * static_cast<std::size_t>(probe);
  return grid.lower + glm::dvec3{place[0], place[1], place[2]};
}

double ProbeReader::variability() const {
  return volume_.counts().variability;
}

void ProbeReader::irradiance(int set, int probe, Light& out) const {
  const std::uint32_t* words = volume_.view(set, volume_.grid.lower).light +
                               static_cast<std::size_t>(probe) * LightNodes::kCount * kLightWords;
  for (std::size_t node = 0; node < out.size(); ++node) {
    out[node] = glm::pi<float>() * unpacked_light(words + node * kLightWords);
  }
}

void ProbeReader::sight(int set, int probe, Sight& out) const {
  const ProbeView view = volume_.view(set, volume_.grid.lower);
  const std::uint32_t* words = view.distances + static_cast<std::size_t>(probe) * DistanceNodes::kCount;
  const double steps = double{kDistanceSteps} * double{view.nearest};
  for (int node = 0; node < DistanceNodes::kCount; ++node) {
    const auto i = static_cast<std::size_t>(node);
    const std::uint32_t inverse = words[i] & 0xffffu;
    const double along = steps / norm_of(DistanceNodes::direction(node));
    out.distance_m[i] = inverse == 0 ? 0.0f : static_cast<float>(along / inverse);
    out.deviation_per_m[i] = static_cast<float>((words[i] >> 16) / steps);
  }
}

}  // namespace herr
