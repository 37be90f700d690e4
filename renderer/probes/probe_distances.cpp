#include "renderer/probes/probe_distances.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/probes/probe_view.h"

namespace herr {
namespace {

constexpr int kSide = DistanceNodes::kStride;

// Rays look past their nodes by 0.01 degrees: probes and walls both like round numbers, and a ray that meets
// the edge of two triangles exactly may slip between them.
const glm::dvec3 kAside{1.07e-4, 0.62e-4, -1.31e-4};

constexpr float kGoldenShare = 0.618034f;

double norm_of(const glm::vec3& d) {
  return std::abs(double{d.x}) + std::abs(double{d.y}) + std::abs(double{d.z});
}

// What a map of half the resolution gives at a node: its own value where both have one, or half-way between
// two. In the middle of four nodes these are the two along the cut that is parallel to the outer fold.
double coarsely(const std::vector<double>& inverse, int x, int y) {
  const auto at = [&](int column, int row) {
    return inverse[static_cast<std::size_t>(DistanceNodes::at(column, row))];
  };
  const bool between_x = x % 2 != 0, between_y = y % 2 != 0;
  if (!between_x && !between_y) return at(x, y);
  if (!between_y) return 0.5 * (at(x - 1, y) + at(x + 1, y));
  if (!between_x) return 0.5 * (at(x, y - 1) + at(x, y + 1));
  const bool falls = (x > kSide / 2) == (y > kSide / 2);
  return falls ? 0.5 * (at(x - 1, y + 1) + at(x + 1, y - 1)) : 0.5 * (at(x - 1, y - 1) + at(x + 1, y + 1));
}

// Root mean square of what the coarser map misses around a node, halved: at an edge between planes the error
// of linear interpolation goes with the distance of nodes. `misses`: squared, of each node.
double deviation(const std::vector<double>& misses, int column, int row) {
  double sum = 0;
  int count = 0;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, kSide - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, kSide - 1); ++x) {
      if (x % 2 == 0 && y % 2 == 0) continue;
      sum += misses[static_cast<std::size_t>(DistanceNodes::at(x, y))];
      ++count;
    }
  }
  return 0.5 * std::sqrt(sum / count);
}

std::uint32_t steps(double value) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 1.0) * double{kDistanceSteps}));
}

}  // namespace

const std::vector<glm::vec3>& distance_directions() {
  static const std::vector<glm::vec3> directions = [] {
    std::vector<glm::vec3> all;
    for (int node = 0; node < DistanceNodes::kCount; ++node) {
      all.emplace_back(glm::normalize(DistanceNodes::direction(node) + kAside));
    }
    return all;
  }();
  return directions;
}

void trace_distances(RTCScene scene, const glm::dvec3& origin, unsigned mask,
                     std::span<const glm::vec3> directions, std::vector<float>& out) {
  constexpr std::size_t kWidth = 16;
  const glm::vec3 from(origin);
  out.resize(directions.size());
  for (std::size_t first = 0; first < directions.size(); first += kWidth) {
    alignas(64) RTCRayHit16 packet;
    alignas(64) int valid[kWidth];
    for (std::size_t i = 0; i < kWidth; ++i) {
      const bool used = first + i < directions.size();
      const glm::vec3 d = used ? directions[first + i] : glm::vec3{0, 0, 1};
      packet.ray.org_x[i] = from.x, packet.ray.org_y[i] = from.y, packet.ray.org_z[i] = from.z;
      packet.ray.dir_x[i] = d.x, packet.ray.dir_y[i] = d.y, packet.ray.dir_z[i] = d.z;
      packet.ray.tnear[i] = 0, packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
      // Evenly spread (tiles/ray_packets-inl.h: set_chance).
      packet.ray.time[i] = std::fmod(kGoldenShare * static_cast<float>(first + i), 1.0f);
      packet.ray.mask[i] = mask, packet.ray.flags[i] = packet.ray.id[i] = 0;
      packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      valid[i] = used ? -1 : 0;
    }
    intersect_packet<kWidth>(valid, scene, true, &packet);
    for (std::size_t i = 0; i < kWidth && first + i < directions.size(); ++i) {
      const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      out[first + i] = hit ? packet.ray.tfar[i] : std::numeric_limits<float>::infinity();
    }
  }
}

void pack_distances(std::span<const float> distances, double nearest_m, DistanceScratch& scratch,
                    std::uint32_t* words) {
  const std::vector<glm::vec3>& directions = distance_directions();
  auto& [inverse, misses, deviations] = scratch;
  inverse.resize(directions.size()), misses.resize(directions.size()), deviations.resize(directions.size());
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    inverse[i] = std::min(
        1.0, nearest_m / (std::max(double{distances[i]}, 1e-9 * nearest_m) * norm_of(directions[i])));
  }
  const auto for_each_node = [](const auto& visit) {
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        visit(static_cast<std::size_t>(DistanceNodes::at(column, row)), column, row);
      }
    }
  };
  for_each_node([&](std::size_t node, int column, int row) {
    const double miss = inverse[node] - coarsely(inverse, column, row);
    misses[node] = miss * miss;
  });
  for_each_node(
      [&](std::size_t node, int column, int row) { deviations[node] = deviation(misses, column, row); });
  for_each_node([&](std::size_t node, int, int) {
    // Both places of a border direction see half of what surrounds it.
    const auto first = static_cast<std::size_t>(DistanceNodes::first_of(static_cast<int>(node)));
    const double spread = std::max(deviations[node], deviations[first]);
    words[node] = steps(inverse[node]) | steps(spread) << 16;
  });
}

void blend_distances(const std::uint32_t* now, double kept, std::uint32_t* words) {
  const auto mixed = [kept](std::uint32_t before, std::uint32_t after) {
    const double value = kept * static_cast<double>(before) + (1 - kept) * static_cast<double>(after);
    return static_cast<std::uint32_t>(std::lround(value));
  };
  for (std::size_t node = 0; node < DistanceNodes::kCount; ++node) {
    const std::uint32_t before = words[node], after = now[node];
    words[node] = mixed(before & 0xffffu, after & 0xffffu) | mixed(before >> 16, after >> 16) << 16;
  }
}

}  // namespace herr
