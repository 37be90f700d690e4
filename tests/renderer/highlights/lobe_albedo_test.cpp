// The table of what highlights send back of light from all sides, against sums over the hemisphere.
#include "renderer/highlights/lobe_albedo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>
#include <utility>

namespace herr {
namespace {

// Half vectors in proportion to GGX: an even grid of (share, azimuth), which needs no visible normals.
std::pair<double, double> summed(double cosine, double alpha) {
  constexpr int kShares = 1500, kAzimuths = 360;
  const glm::dvec3 v{std::sqrt(1 - cosine * cosine), 0, cosine};
  double all = 0, grazing = 0;
  for (int i = 0; i < kShares; ++i) {
    const double share = (i + 0.5) / kShares, tan2 = alpha * alpha * share / (1 - share);
    const double n_h = 1 / std::sqrt(1 + tan2), across = std::sqrt(1 - n_h * n_h);
    for (int j = 0; j < kAzimuths; ++j) {
      const double turn = glm::two_pi<double>() * (j + 0.5) / kAzimuths;
      const glm::dvec3 h{across * std::cos(turn), across * std::sin(turn), n_h};
      const double v_h = glm::dot(v, h);
      const double n_l = 2 * v_h * n_h - cosine;
      if (n_l <= 0 || v_h <= 0) continue;
      // D n.h is the density of h; of l it is that over 4 v.h.
      const double visibility = 0.5 / (alpha * (n_l + cosine) + (1 - alpha) * 2 * n_l * cosine);
      const double weight = 4 * v_h * n_l * visibility / n_h / (kShares * kAzimuths);
      all += weight;
      grazing += weight * std::pow(1 - v_h, 5);
    }
  }
  return {all, grazing};
}

TEST(LobeAlbedoTest, IsTheSumOverTheHemisphere) {
  for (const int row : {2, 5, 8, 12, 15}) {
    for (const int column : {2, 6, 13, 22, 31}) {
      const double roughness = row / 15.0;
      const auto [all, grazing] = summed(column / 31.0, roughness * roughness);
      const auto at = static_cast<std::size_t>(row * kAlbedoCosines + column);
      // Four decimals, and the heavy tail of the even grid.
      EXPECT_NEAR(kLobeAlbedoAll[at], all, 3e-3) << row << ", " << column;
      EXPECT_NEAR(kLobeAlbedoGrazing[at], grazing, 3e-3) << row << ", " << column;
    }
  }
}

TEST(LobeAlbedoTest, NothingIsMade) {
  for (std::size_t i = 0; i < kAlbedoCosines * kAlbedoRoughnesses; ++i) {
    EXPECT_LE(kLobeAlbedoAll[i], 1.0f);
    EXPECT_LE(kLobeAlbedoGrazing[i], kLobeAlbedoAll[i]);
  }
}

}  // namespace
}  // namespace herr
