// What a narrow lobe has beyond a wider one with the same tails, against sums over slopes in double.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/reflectance/sky_in_lobe-inl.h"

namespace herr {
namespace {

namespace kernels = HWY_NAMESPACE;

// GGX over slopes, in alpha, is 1 / pi (1 + r^2)^2; one of k times its alpha^2, counted 1 / k, is
// 1 / pi (k + r^2)^2. The share of their difference within r, summed over rings.
double share_within(double r, double k) {
  constexpr int kSteps = 200000;
  const double farthest = 2000;
  double within = 0, all = 0;
  for (int i = 0; i < kSteps; ++i) {
    // Steps that grow outwards: r = x^3.
    const double x = std::cbrt(farthest) * (i + 0.5) / kSteps, at = x * x * x, s = at * at;
    const double ring = at * 3 * x * x;
    const double more = ring * (1 / std::pow(1 + s, 2) - 1 / std::pow(k + s, 2));
    all += more;
    if (at < r) within += more;
  }
  return within / all;
}

TEST(LobeCoreTest, RingsHoldEqualSharesOfTheCore) {
  for (const double k : {1.05, 1.5, 4.0, 30.0, 2000.0}) {
    for (const double q : {1.0 / 12, 0.25, 0.5, 0.75, 11.0 / 12}) {
      const double s = double{kernels::hn::GetLane(
          kernels::core_within(static_cast<float>(q), kernels::set(static_cast<float>(k))))};
      EXPECT_NEAR(share_within(std::sqrt(s), k), q, 2e-3) << "k " << k << ", q " << q;
    }
  }
}

}  // namespace
}  // namespace herr
