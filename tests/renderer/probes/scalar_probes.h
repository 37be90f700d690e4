// A look-up of indirect light in double, written out probe by probe: what the kernels are held against.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/probes/probe_volume.h"

namespace herr::test {

struct LookupPoint {
  glm::dvec3 position, normal, geometric_normal, to_viewer;  // position: metres from the grid's lower corner
};

// Three nodes around a direction and their weights.
template <int N>
struct ScalarTaps {
  int node[3];
  double weight[3];

  explicit ScalarTaps(const glm::dvec3& direction) {
    const glm::dvec2 place = octahedral_from_direction(direction);
    const double a = std::abs(place.x) * N / 2, b = std::abs(place.y) * N / 2;
    const double i = std::min(std::floor(a), N / 2 - 1.0), j = std::min(std::floor(b), N / 2 - 1.0);
    const double fx = a - i, fy = b - j;
    const auto at = [&](double x, double y) {
      return OctahedralNodes<N>::at(N / 2 + static_cast<int>(std::copysign(x, direction.x)),
                                    N / 2 + static_cast<int>(std::copysign(y, direction.y)));
    };
    const bool beyond = fx + fy > 1;
    node[0] = beyond ? at(i + 1, j + 1) : at(i, j);
    node[1] = at(i + 1, j), node[2] = at(i, j + 1);
    weight[0] = std::abs(fx + fy - 1);
    weight[1] = beyond ? 1 - fy : fx;
    weight[2] = beyond ? 1 - fx : fy;
  }
};

inline glm::dvec3 unpacked_light(const std::uint32_t* words) {
  const auto of_bits = [](std::uint32_t bits) {
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return double{value};
  };
  return {of_bits((words[0] >> 11) << 10), of_bits((words[1] >> 11) << 10),
          of_bits((words[0] & 0x7ff) << 20 | (words[1] & 0x3ff) << 10)};
}

// Chebyshev's bound on the share of the probe's sight that reaches the point, cubed, and poor sight poorer.
inline double scalar_sight(const ProbeView& view, int probe, const glm::dvec3& from_probe) {
  const ScalarTaps<kDistanceNodes> taps(from_probe);
  const std::uint32_t* words = view.distances + static_cast<std::size_t>(probe) * DistanceNodes::kCount;
  double seen = 0, deviation = 0;
  for (int tap = 0; tap < 3; ++tap) {
    seen += taps.weight[tap] * (words[taps.node[tap]] & 0xffff);
    deviation += taps.weight[tap] * (words[taps.node[tap]] >> 16);
  }
  const double steps = double{kDistanceSteps} * view.nearest;
  const double distance = std::abs(from_probe.x) + std::abs(from_probe.y) + std::abs(from_probe.z);
  const double behind = std::max(seen - steps / distance, 0.0);
  const double tolerance = deviation + 0.5 + seen * seen * view.tolerance_m / steps;
  const double bound = tolerance * tolerance / (tolerance * tolerance + behind * behind);
  const double sight = bound * bound * bound;
  return sight < 0.2 ? std::max(sight * std::pow(sight / 0.2, 2), 1e-7) : sight;
}

struct ScalarWeight {
  int probe;
  double trilinear, side, sight, weight;
};

inline glm::dvec3 scalar_lookup(const ProbeView& view, const glm::dvec3& environment, const LookupPoint& at,
                                std::vector<ScalarWeight>* weights = nullptr) {
  glm::ivec3 cell{0};
  glm::dvec3 place{0.0};
  bool faces_out = false;
  for (int axis = 0; axis < 3; ++axis) {
    // A thousandth of the smallest spacing, a tenth of the tolerance, before the surface: where it lies in a
    // plane of probes, rounding must not choose the cell.
    const double x = at.position[axis] + 0.1 * double{view.tolerance_m} * at.geometric_normal[axis];
    const double g = x * double{view.inverse_spacing[axis]} - 0.5, last = view.counts[axis] - 1;
    faces_out =
        faces_out || (g < 0 && at.geometric_normal[axis] < 0) || (g > last && at.geometric_normal[axis] > 0);
    const double inside = std::clamp(g, 0.0, last);
    cell[axis] = static_cast<int>(std::min(std::floor(inside), std::max(last - 1, 0.0)));
    place[axis] = inside - cell[axis];
  }
  const glm::dvec3 seen_point = at.position + double{view.normal_bias_m} * at.geometric_normal +
                                double{view.view_bias_m} * at.to_viewer;
  const ScalarTaps<kLightNodes> taps(at.normal);
  glm::dvec3 sum{0.0};
  double total = 0;
  for (int corner = 0; corner < 8; ++corner) {
    glm::ivec3 where = cell;
    double trilinear = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const int upper = corner >> axis & 1;
      where[axis] = std::min(cell[axis] + upper, view.counts[axis] - 1);
      trilinear *= upper ? place[axis] : 1 - place[axis];
    }
    const int probe = (where.z * view.counts[1] + where.y) * view.counts[0] + where.x;
    const float* stand = view.places + 4 * static_cast<std::size_t>(probe);
    const glm::dvec3 from{stand[0], stand[1], stand[2]};
    const glm::dvec3 to_probe = glm::normalize(from - at.position);
    const double facing = 0.5 + 0.5 * glm::dot(to_probe, at.normal);
    const double side = facing * facing * std::clamp(8 * glm::dot(to_probe, at.geometric_normal), 0.0, 1.0);
    const double sight = scalar_sight(view, probe, seen_point - from);
    const double weight = trilinear * side * double{stand[3]} * sight;
    if (weights) weights->push_back({probe, trilinear, side, sight, weight});
    glm::dvec3 light{0.0};
    for (int tap = 0; tap < 3; ++tap) {
      light +=
          taps.weight[tap] *
          unpacked_light(view.light + kLightWords * (static_cast<std::size_t>(probe) * LightNodes::kCount +
                                                     static_cast<std::size_t>(taps.node[tap])));
    }
    sum += weight * light;
    total += weight;
  }
  constexpr double kSmallestKnowledge = 1e-10;
  const double unknown = faces_out ? std::max(1 - total / kSmallestKnowledge, 0.0) : 0.0;
  return sum / std::max(total, kSmallestKnowledge) + unknown * environment;
}

}  // namespace herr::test
