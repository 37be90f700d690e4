// GGX over discs in closed form, against sums.
#include "renderer/highlights/disc_lobe-inl.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace herr {
namespace {

namespace kernels = HWY_NAMESPACE;

double closed(double off, double alpha, double rim) {
  const auto lanes = [](double x) { return kernels::set(static_cast<float>(x)); };
  return double{hwy::HWY_NAMESPACE::GetLane(
      kernels::ggx_over_disc(lanes(off * off), lanes(alpha * alpha), lanes(rim * rim)))};
}

// The mean of alpha^2 / pi (r^2 + alpha^2)^2 over rings and azimuths of the disc.
double summed(double off, double alpha, double rim) {
  constexpr int kRings = 400, kAzimuths = 400;
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double radius = rim * std::sqrt((i + 0.5) / kRings);
    for (int j = 0; j < kAzimuths; ++j) {
      const double turn = glm::two_pi<double>() * (j + 0.5) / kAzimuths;
      const double r2 = off * off + radius * radius + 2 * off * radius * std::cos(turn);
      sum += alpha * alpha / (glm::pi<double>() * std::pow(r2 + alpha * alpha, 2));
    }
  }
  return sum / (kRings * kAzimuths);
}

// From lobes much narrower than the disc to much wider ones, in its middle, at its rim and far from it.
TEST(DiscLobeTest, IsTheMeanOverTheDisc) {
  for (const double alpha : {0.005, 0.02, 0.1, 0.5}) {
    for (const double rim : {0.005, 0.02, 0.05}) {
      for (const double off : {0.0, 0.004, 0.019, 0.05, 0.3}) {
        const double exact = summed(off, alpha, rim);
        // Rings and azimuths resolve a tenth of the narrowest lobe: 1 %.
        EXPECT_NEAR(closed(off, alpha, rim), exact, 0.01 * exact) << alpha << ", " << rim << ", " << off;
      }
    }
  }
}

TEST(DiscLobeTest, APointIsGgxItself) {
  for (const double off : {0.0, 0.01, 0.2}) {
    const double q = off * off + 0.05 * 0.05, exact = 0.05 * 0.05 / (glm::pi<double>() * q * q);
    EXPECT_NEAR(closed(off, 0.05, 0), exact, 1e-5 * exact);
  }
}

}  // namespace
}  // namespace herr
