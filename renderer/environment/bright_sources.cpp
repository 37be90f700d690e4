#include "renderer/environment/bright_sources.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace herr {
namespace {

// Sources within this are one: a quarter of a degree, half the sun.
constexpr double kSmallestRim2 = 0.00436 * 0.00436;

struct Spot {
  glm::dvec3 direction;
  glm::dvec3 irradiance;
  double power() const { return irradiance.x + irradiance.y + irradiance.z; }
};

// Spots that are shown as one source, its middle and the mean square of their distance from it.
struct Cluster {
  std::span<Spot> spots;
  glm::dvec3 middle{0.0};
  double power = 0, mean_square = 0;
  // Of a disc of even brightness the rim's square is twice the mean.
  double worth() const {
    return spots.size() > 1 && 2 * mean_square > kSmallestRim2 ? power * mean_square : 0;
  }
};

Cluster cluster_of(std::span<Spot> spots) {
  Cluster out{spots};
  glm::dvec3 sum{0.0};
  for (const Spot& spot : spots) {
    sum += spot.power() * spot.direction;
    out.power += spot.power();
  }
  out.middle = glm::normalize(sum);
  for (const Spot& spot : spots) {
    const glm::dvec3 off = spot.direction - out.middle;
    out.mean_square += spot.power() / out.power * glm::dot(off, off);
  }
  return out;
}

// Cuts a cluster through its middle, across the axis along which it is longest.
std::pair<Cluster, Cluster> cut(const Cluster& whole) {
  glm::dvec3 spread{0.0};
  for (const Spot& spot : whole.spots) {
    const glm::dvec3 off = spot.direction - whole.middle;
    spread += spot.power() * off * off;
  }
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  std::sort(whole.spots.begin(), whole.spots.end(),
            [&](const Spot& a, const Spot& b) { return a.direction[axis] < b.direction[axis]; });
  double below = 0;
  std::size_t at = 0;
  while (at + 1 < whole.spots.size() && below < 0.5 * whole.power) below += whole.spots[at++].power();
  at = std::max<std::size_t>(at, 1);
  return {cluster_of(whole.spots.first(at)), cluster_of(whole.spots.subspan(at))};
}

double brightness(const std::array<float, 4>& texel) {
  return (double{texel[0]} + double{texel[1]} + double{texel[2]}) / 3;
}

// Leaves what may stay in the picture and returns the rest.
std::vector<Spot> take_spots(SkyPicture& picture) {
  double sum = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) sum += picture.solid_angle(y) * brightness(picture.at(x, y));
  }
  const double most = kBrightTimesMean * sum / 12.566370614359172;
  std::vector<Spot> spots;
  if (!(most > 0)) return spots;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      std::array<float, 4>& texel = picture.texels[static_cast<std::size_t>(y * picture.width + x)];
      const double bright = brightness(texel);
      if (bright <= most) continue;
      const double kept = most / bright, solid_angle = picture.solid_angle(y);
      const glm::dvec3 whole{texel[0], texel[1], texel[2]};
      spots.push_back({picture.direction(x + 0.5, y + 0.5), solid_angle * (1 - kept) * whole});
      for (std::size_t c = 0; c < 3; ++c) texel[c] = static_cast<float>(kept * double{texel[c]});
    }
  }
  return spots;
}

BrightSource source_of(const Cluster& cluster, double texel_rad) {
  BrightSource out;
  glm::dvec3 irradiance{0.0};
  for (const Spot& spot : cluster.spots) irradiance += spot.irradiance;
  for (int c = 0; c < 3; ++c) {
    out.direction[c] = static_cast<float>(cluster.middle[c]);
    out.irradiance[c] = static_cast<float>(irradiance[c]);
  }
  // The rim's square is twice the mean, a texel's own share of it included; half vectors turn by half.
  const double rim2 = 2 * (cluster.mean_square + texel_rad * texel_rad / 6);
  out.half_turn2 = static_cast<float>(0.25 * rim2);
  return out;
}

}  // namespace

std::vector<BrightSource> take_bright_sources(SkyPicture& picture) {
  std::vector<Spot> spots = take_spots(picture);
  std::vector<BrightSource> out;
  if (spots.empty()) return out;
  std::vector<Cluster> clusters{cluster_of(spots)};
  while (clusters.size() < kMostBrightSources) {
    const auto widest =
        std::max_element(clusters.begin(), clusters.end(),
                         [](const Cluster& a, const Cluster& b) { return a.worth() < b.worth(); });
    if (widest->worth() <= 0) break;
    const auto [one, other] = cut(*widest);
    *widest = one;
    clusters.push_back(other);
  }
  const double texel_rad = 3.141592653589793 / picture.height;
  for (const Cluster& cluster : clusters) out.push_back(source_of(cluster, texel_rad));
  return out;
}

}  // namespace herr
