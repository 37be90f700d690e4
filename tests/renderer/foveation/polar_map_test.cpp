// The log-polar map against its inverse and its density.
#include "renderer/foveation/polar_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace herr {
namespace {

constexpr std::array<double, 6> kRanges_deg{1e-3, 1.0, 45.0, 90.0, 134.5, 180.0};

double ulp(double x) {
  return std::nextafter(x, std::numeric_limits<double>::infinity()) - x;
}

// Dense, random, and at both ends, in [0, highest].
std::vector<double> values_up_to(double highest, unsigned seed) {
  std::vector<double> values{0.0, std::numeric_limits<double>::denorm_min(), 1e-300, 1e-16, highest};
  constexpr int kSteps = 20000;
  for (int i = 1; i < kSteps; ++i) values.push_back(highest * i / kSteps);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, highest);
  std::uniform_real_distribution<double> exponent(-40.0, 0.0);
  for (int i = 0; i < kSteps; ++i) values.push_back(uniform(random));
  for (int i = 0; i < kSteps; ++i) values.push_back(highest * std::exp(exponent(random)));
  return values;
}

// Four roundings stand between a u and its return (product, expm1, log1p, quotient), each of at most one ulp
// of its own result; log1p and expm1 pass relative errors on with factors of at most 1 and L / (1 - e^-L) of
// a value that u is divided from, so 4 ulp of u is what arithmetic allows.
constexpr double kRoundTrip_ulp = 4.0;

TEST(PolarMapTest, UReturnsThroughThetaWithinFourUlp) {
  double worst = 0;
  for (const double range : kRanges_deg) {
    const PolarMap map = PolarMap::up_to(range);
    for (const double u : values_up_to(1.0, 11)) {
      const double error = std::abs(map.u_from_theta(map.theta_from_u(u)) - u) / ulp(u);
      worst = std::max(worst, error);
      ASSERT_LE(error, kRoundTrip_ulp) << "u = " << u << ", theta_max = " << range << " deg";
    }
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  std::cout << "worst u -> theta -> u: " << worst << " ulp of u\n";
}

TEST(PolarMapTest, ThetaReturnsThroughUWithinFourUlpOfU) {
  double worst = 0;
  for (const double range : {45.0, 90.0, 179.0, 180.0}) {
    const PolarMap map = PolarMap::up_to(range);
    for (const double theta : values_up_to(std::min(range, 179.0), 12)) {
      const double u = map.u_from_theta(theta);
      // The distance between theta and its return, seen in u.
      const double moved = std::abs(map.theta_from_u(u) - theta) * map.radial_density(theta, 1.0);
      worst = std::max(worst, moved / ulp(u));
      ASSERT_LE(moved, kRoundTrip_ulp * ulp(u)) << "theta = " << theta << " deg of " << range;
    }
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  std::cout << "worst theta -> u -> theta: " << worst << " ulp of u\n";
}

TEST(PolarMapTest, BothEndsAreExact) {
  for (const double range : kRanges_deg) {
    const PolarMap map = PolarMap::up_to(range);
    EXPECT_EQ(map.u_from_theta(0.0), 0.0);
    EXPECT_EQ(map.theta_from_u(0.0), 0.0);
    EXPECT_EQ(map.u_from_theta(range), 1.0);
    // expm1 of the rounded log1p: the argument's half ulp is worth (1 + theta)
    // log1p(theta) / theta half ulps.
    EXPECT_NEAR(map.theta_from_u(1.0), range, 8 * ulp(range));
  }
}

TEST(PolarMapTest, AnglesWrapIntoOneTurnOnBothSidesOfTheSeam) {
  constexpr double kTurn = glm::two_pi<double>();
  EXPECT_EQ(v_from_phi(0.0), 0.0);
  EXPECT_EQ(v_from_phi(-0.0), 0.0);
  EXPECT_EQ(v_from_phi(kTurn), 0.0);
  // So little below the seam that adding a turn rounds to a whole one: that is the seam itself, not 1.
  EXPECT_EQ(v_from_phi(-1e-300), 0.0);
  EXPECT_EQ(v_from_phi(-1e-17), 0.0);
  EXPECT_NEAR(v_from_phi(-1e-9), 1.0 - 1e-9 / kTurn, 1e-15);
  for (int i = -4000; i <= 4000; ++i) {
    const double v = v_from_phi(0.01 * i);
    ASSERT_GE(v, 0.0);
    ASSERT_LT(v, 1.0);
    // The angles differ by whole turns; the remainder of 40 rad carries 40 * 2^-53 twice.
    const double turns = (0.01 * i - phi_from_v(v)) / kTurn;
    ASSERT_NEAR(turns, std::round(turns), 1e-14) << "phi = " << 0.01 * i;
  }
}

TEST(PolarMapTest, VReturnsThroughPhiWithinOneUlp) {
  // A product and a quotient with the same constant: two roundings of half an ulp each, of which the first
  // can count double where the product lies just above a power of two.
  for (const double v : values_up_to(1.0 - 1e-12, 13)) {
    ASSERT_NEAR(v_from_phi(phi_from_v(v)), v, 1.5 * ulp(v));
  }
}

TEST(PolarMapTest, RadialDensityIsTheDerivativeOfTheColumn) {
  constexpr double kWidth = 788.0;
  for (const double range : {45.0, 90.0, 180.0}) {
    const PolarMap map = PolarMap::up_to(range);
    for (double theta = 0.01; theta < range - 0.01; theta += 0.37) {
      // Central difference of c(theta) = W log1p(theta) / L: its error is h^2 / 6 |c'''| = h^2 / 3 W / (L (1
      // + theta)^3), relative to c' at most h^2 / 3 = 3.4e-9; rounding adds 2^-53 * 788 / (2 h c'), at most
      // 1e-9.
      constexpr double kStep_deg = 1e-4;
      const double slope = kWidth *
                           (map.u_from_theta(theta + kStep_deg) - map.u_from_theta(theta - kStep_deg)) /
                           (2 * kStep_deg);
      const double density = map.radial_density(theta, kWidth);
      ASSERT_NEAR(slope, density, 2e-8 * density) << "theta = " << theta;
    }
  }
}

TEST(PolarMapTest, AngularDensityTimesTheCircumferenceIsTheHeight) {
  for (double theta = 0.5; theta < 180.0; theta += 0.5) {
    const double circumference_deg = 360.0 * std::sin(theta / kDegreesPerRadian);
    EXPECT_NEAR(PolarMap::angular_density(theta, 768.0) * circumference_deg, 768.0, 1e-9);
  }
}

TEST(PolarMapTest, ThePapersWidthAt45DegreesIs766) {
  // 200 ln(46) = 765.73.
  EXPECT_NEAR(PolarMap::up_to(45.0).paper_width(), 765.73, 0.005);
  EXPECT_EQ(std::ceil(PolarMap::up_to(45.0).paper_width()), 766.0);
  // There the density is the acuity itself, k / (theta + 1).
  const PolarMap map = PolarMap::up_to(45.0);
  EXPECT_NEAR(map.radial_density(0.0, map.paper_width()), 200.0, 1e-10);
  EXPECT_NEAR(map.radial_density(19.0, map.paper_width()), 10.0, 1e-11);
}

}  // namespace
}  // namespace herr
