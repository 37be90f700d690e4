// What rays of probes bring of an open sky, against the whole of it.
#include "renderer/environment/sky_of_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "renderer/probes/probe_view.h"

namespace herr {
namespace {

void one_by_one(int count, const std::function<void(int)>& job) {
  for (int i = 0; i < count; ++i) job(i);
}

// Brighter above, with three lamps of a few texels that send most of the light.
EnvironmentImage picture_of_lamps() {
  EnvironmentImage picture;
  picture.width_px = 256;
  picture.height_px = 128;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      float value = 1.0f - static_cast<float>(y) / 256;
      for (const glm::ivec2& lamp : {glm::ivec2{30, 20}, glm::ivec2{150, 70}, glm::ivec2{200, 50}}) {
        if (std::abs(x - lamp.x) < 2 && std::abs(y - lamp.y) < 2) value = 4000;
      }
      picture.rgba.insert(picture.rgba.end(), {value, 0.5f * value, 0.25f * value, 0.0f});
    }
  }
  return picture;
}

// Irradiance over pi of the picture turned by a quarter: texel by texel.
double even(const EnvironmentImage& picture, const glm::dvec3& n) {
  double sum = 0;
  for (int y = 0; y < picture.height_px; ++y) {
    const double polar = (y + 0.5) / picture.height_px * glm::pi<double>();
    const double each =
        std::sin(polar) * glm::pi<double>() / picture.height_px * glm::two_pi<double>() / picture.width_px;
    for (int x = 0; x < picture.width_px; ++x) {
      const double azimuth = ((x + 0.5) / picture.width_px - 0.5 - 0.25) * glm::two_pi<double>();
      const glm::dvec3 d{std::sin(polar) * std::sin(azimuth), std::cos(polar),
                         -std::sin(polar) * std::cos(azimuth)};
      sum += std::max(glm::dot(n, d), 0.0) * each *
             double{picture.rgba[static_cast<std::size_t>(4 * (y * picture.width_px + x))]};
    }
  }
  return sum * glm::one_over_pi<double>();
}

TEST(SkyOfRaysTest, OpenNodesReceiveExactlyWhatThePictureSends) {
  const EnvironmentImage picture = picture_of_lamps();
  std::vector<glm::dvec3> nodes;
  for (int node = 0; node < LightNodes::kCount; ++node) {
    if (LightNodes::first_of(node) == node) nodes.push_back(LightNodes::direction(node));
  }
  for (const int rays : {8, 64}) {
    const FilteredEnvironment filtered(picture, rays, one_by_one);
    ProbeDirections directions;
    directions.allocate(rays, static_cast<int>(nodes.size()));
    for (const std::uint32_t key : {1u, 77u}) {
      directions.aim(key, nodes);
      EXPECT_TRUE(directions.sky.empty());
      aim_sky(directions, nodes, filtered, 0.25f);
      ASSERT_EQ(directions.sky.size(), directions.weights.size());
      for (std::size_t node = 0; node < nodes.size(); ++node) {
        double red = 0, blue = 0;
        for (auto i = directions.first_weight[node]; i < directions.first_weight[node + 1]; ++i) {
          const auto& share = directions.sky[static_cast<std::size_t>(i)];
          EXPECT_GE(share.light[0], 0);
          red += double{share.light[0]};
          blue += double{share.light[2]};
        }
        // Half a texel of the picture that even light is summed from, and its interpolation: 2 %.
        const double exact = even(picture, nodes[node]);
        EXPECT_NEAR(red, exact, 0.02 * exact) << rays << " rays, node " << node;
        EXPECT_NEAR(blue, 0.25 * red, 0.001 * red);
      }
    }
  }
}

}  // namespace
}  // namespace herr
