#include "renderer/environment/bright_sources.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

namespace herr {
namespace {

// Spots within this are one: a quarter of a degree, half the sun.
constexpr double kSmallestRim2 = 0.00436 * 0.00436;
// A texel fades to nothing a texel further along each axis: a sixth of its square each, twice both.
constexpr double kTexelRim2 = 2.0 / 3;
// Clusters among which the brightest are chosen.
constexpr std::size_t kMostClusters = 128;

// What is too bright of a texel.
struct Spot {
  glm::dvec3 direction;
  glm::dvec3 irradiance;
  int x = 0, y = 0;
  double power() const { return irradiance.x + irradiance.y + irradiance.z; }
};

// Spots that are shown as one, its middle and the mean square of their distance from it.
struct Cluster {
  std::span<Spot> spots;
  glm::dvec3 middle{0.0};
  double power = 0, mean_square = 0;
  // Of a disc of even brightness the rim's square is twice the mean.
  double rim2() const { return 2 * mean_square; }
  double worth() const { return spots.size() > 1 && rim2() > kSmallestRim2 ? power * mean_square : 0; }
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

// Where to cut spots in their order so that both sides are as small as can be: the sum of power x distance^2
// from each side's middle is least where |sum of power x place|^2 / power of both sides is most.
std::size_t best_cut(std::span<const Spot> spots) {
  glm::dvec3 all{0.0}, before{0.0};
  double power = 0, power_before = 0;
  for (const Spot& spot : spots) {
    all += spot.power() * spot.direction;
    power += spot.power();
  }
  std::size_t best = 1;
  double most = -1;
  for (std::size_t i = 0; i + 1 < spots.size(); ++i) {
    before += spots[i].power() * spots[i].direction;
    power_before += spots[i].power();
    const glm::dvec3 after = all - before;
    const double held = glm::dot(before, before) / power_before +
                        glm::dot(after, after) / std::max(power - power_before, 1e-300);
    if (held > most) most = held, best = i + 1;
  }
  return best;
}

// Across the axis along which it is longest.
std::pair<Cluster, Cluster> cut(const Cluster& whole) {
  glm::dvec3 spread{0.0};
  for (const Spot& spot : whole.spots) {
    const glm::dvec3 off = spot.direction - whole.middle;
    spread += spot.power() * off * off;
  }
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  std::stable_sort(whole.spots.begin(), whole.spots.end(),
                   [&](const Spot& a, const Spot& b) { return a.direction[axis] < b.direction[axis]; });
  const std::size_t at = best_cut(whole.spots);
  return {cluster_of(whole.spots.first(at)), cluster_of(whole.spots.subspan(at))};
}

// Cuts the cluster of most `worth` in two, while one has any and there are fewer than `most`.
template <typename Worth>
void cut_apart(std::vector<Cluster>& clusters, std::size_t most, const Worth& worth) {
  while (clusters.size() < most) {
    const auto first = std::max_element(clusters.begin(), clusters.end(),
                                        [&](const auto& a, const auto& b) { return worth(a) < worth(b); });
    if (first == clusters.end() || worth(*first) <= 0) return;
    const auto [one, other] = cut(*first);
    *first = one;
    clusters.push_back(other);
  }
}

double brightness(const std::array<float, 4>& texel) {
  return (double{texel[0]} + double{texel[1]} + double{texel[2]}) / 3;
}

// Texels that are too bright, side by side ones one after another, and where each such patch ends.
class Patches {
 public:
  std::vector<Spot> spots;
  std::vector<std::size_t> ends;

  explicit Patches(const SkyPicture& picture) : picture_(picture), seen_(picture.texels.size()) {
    double sum = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) sum += picture.solid_angle(y) * brightness(picture.at(x, y));
    }
    most_ = kBrightTimesMean * sum / 12.566370614359172;
    if (!(most_ > 0)) return;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (!reach(x, y)) continue;
        for (std::size_t i = ends.empty() ? 0 : ends.back(); i < spots.size(); ++i) add_neighbours(i);
        ends.push_back(spots.size());
      }
    }
  }

 private:
  bool reach(int x, int y) {
    const std::size_t at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(x);
    const std::array<float, 4>& texel = picture_.texels[at];
    if (seen_[at] || !(brightness(texel) > most_)) return false;
    seen_[at] = true;
    const double taken = picture_.solid_angle(y) * (1 - most_ / brightness(texel));
    const glm::dvec3 whole{texel[0], texel[1], texel[2]};
    spots.push_back({picture_.direction(x + 0.5, y + 0.5), taken * whole, x, y});
    return true;
  }
  void add_neighbours(std::size_t of) {
    const int x = spots[of].x, y = spots[of].y, width = picture_.width;
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, picture_.height - 1); ++row) {
      for (const int column : {x + width - 1, x, x + 1}) reach(column % width, row);
    }
  }

  const SkyPicture& picture_;
  std::vector<bool> seen_;
  double most_ = 0;
};

BrightDisc disc_of(const Cluster& cluster, double texel_rad) {
  BrightDisc out;
  glm::dvec3 irradiance{0.0};
  for (const Spot& spot : cluster.spots) irradiance += spot.irradiance;
  for (int c = 0; c < 3; ++c) {
    out.direction[c] = static_cast<float>(cluster.middle[c]);
    out.irradiance[c] = static_cast<float>(irradiance[c]);
  }
  // Twice a texel's own mean square is added, of what lies between texels too; half vectors turn by half.
  out.half_turn2 = static_cast<float>(0.25 * (cluster.rim2() + kTexelRim2 * texel_rad * texel_rad));
  return out;
}

// What shows most, small ones of much power; none that is too wide.
void choose(std::vector<Cluster>& clusters, double texel_rad) {
  std::erase_if(clusters, [](const Cluster& c) { return c.rim2() > kWidestRim * kWidestRim; });
  const auto shows = [&](const Cluster& c) {
    return c.power * c.power / (c.rim2() + kTexelRim2 * texel_rad * texel_rad);
  };
  std::stable_sort(clusters.begin(), clusters.end(),
                   [&](const Cluster& a, const Cluster& b) { return shows(a) > shows(b); });
  if (clusters.size() > kMostBrightSources) clusters.resize(kMostBrightSources);
}

void take_out(SkyPicture& picture, const Cluster& cluster) {
  for (const Spot& spot : cluster.spots) {
    std::array<float, 4>& texel = picture.texels[static_cast<std::size_t>(spot.y * picture.width + spot.x)];
    for (int c = 0; c < 3; ++c) {
      float& value = texel[static_cast<std::size_t>(c)];
      value =
          static_cast<float>(std::max(double{value} - spot.irradiance[c] / picture.solid_angle(spot.y), 0.0));
    }
  }
}

}  // namespace

BrightLight take_bright_sources(SkyPicture& picture) {
  Patches patches(picture);
  const double texel_rad = 3.141592653589793 / picture.height;
  std::vector<Cluster> clusters;
  std::size_t first = 0;
  for (const std::size_t end : patches.ends) {
    clusters.push_back(cluster_of(std::span(patches.spots).subspan(first, end - first)));
    first = end;
  }
  cut_apart(clusters, std::max(kMostClusters, clusters.size()),
            [](const Cluster& c) { return c.rim2() > kWidestRim * kWidestRim ? c.worth() : 0.0; });
  choose(clusters, texel_rad);
  const double wide_rim = kWideTexels * texel_rad;
  const auto wide = std::stable_partition(clusters.begin(), clusters.end(),
                                          [&](const Cluster& c) { return c.rim2() < wide_rim * wide_rim; });
  BrightLight out;
  out.small = static_cast<int>(wide - clusters.begin());
  if (wide != clusters.end()) {
    out.without_small = picture;
    std::for_each(clusters.begin(), wide, [&](const Cluster& c) { take_out(out.without_small, c); });
  }
  for (const Cluster& cluster : clusters) {
    std::vector<Cluster> parts{cluster};
    cut_apart(parts, kMostParts, [](const Cluster& c) { return c.worth(); });
    BrightSource source{disc_of(cluster, texel_rad)};
    source.first_part = static_cast<int>(out.parts.size());
    source.parts = static_cast<int>(parts.size());
    for (const Cluster& part : parts) out.parts.push_back(disc_of(part, texel_rad));
    out.sources.push_back(source);
    take_out(picture, cluster);
  }
  return out;
}

}  // namespace herr
