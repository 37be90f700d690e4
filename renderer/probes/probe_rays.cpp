#include "renderer/probes/probe_rays.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace herr {
namespace {

// 32 random bits: the "lowbias32" integer hash (Chris Wellons, 2018).
std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

}  // namespace

glm::dvec3 fibonacci_direction(int i, int n) {
  constexpr double kGoldenTurn = 0.6180339887498949;
  const double turns = i * kGoldenTurn;
  const double phi = glm::two_pi<double>() * (turns - std::floor(turns));
  const double z = 1 - (2.0 * i + 1) / n, r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

glm::dquat rotation_of(std::uint32_t key) {
  const auto unit = [key](std::uint32_t counter) { return hash(key + counter * 0x9e3779b9u) * 0x1p-32; };
  const double u = unit(1), a = glm::two_pi<double>() * unit(2), b = glm::two_pi<double>() * unit(3);
  const double s = std::sqrt(1 - u), c = std::sqrt(u);
  return {c * std::cos(b), s * std::sin(a), s * std::cos(a), c * std::sin(b)};
}

void ProbeDirections::allocate(int rays, int directions) {
  const auto n = static_cast<std::size_t>(rays);
  x.resize(n), y.resize(n), z.resize(n);
  first_weight.resize(static_cast<std::size_t>(directions) + 1);
  weights.reserve(n * static_cast<std::size_t>(directions));
  sky.reserve(n * static_cast<std::size_t>(directions));
}

void ProbeDirections::aim(std::uint32_t frame_key, const std::vector<glm::dvec3>& node_directions) {
  key = frame_key;
  const glm::dquat turn = rotation_of(key);
  for (int i = 0; i < rays(); ++i) {
    const glm::dvec3 d = turn * fibonacci_direction(i, rays());
    const auto ray = static_cast<std::size_t>(i);
    x[ray] = static_cast<float>(d.x), y[ray] = static_cast<float>(d.y), z[ray] = static_cast<float>(d.z);
  }
  weights.clear();
  sky.clear();
  for (std::size_t node = 0; node < node_directions.size(); ++node) {
    first_weight[node] = static_cast<std::int32_t>(weights.size());
    const glm::vec3 n(node_directions[node]);
    double sum = 0;
    for (std::size_t ray = 0; ray < x.size(); ++ray) {
      const float cosine = n.x * x[ray] + n.y * y[ray] + n.z * z[ray];
      if (!(cosine > 0)) continue;
      weights.push_back({static_cast<std::int32_t>(ray), cosine});
      sum += cosine;
    }
    for (std::size_t i = static_cast<std::size_t>(first_weight[node]); i < weights.size(); ++i) {
      weights[i].weight = static_cast<float>(weights[i].weight / sum);
    }
  }
  first_weight.back() = static_cast<std::int32_t>(weights.size());
}

}  // namespace herr
