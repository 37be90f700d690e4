// Which points of a context viewport a focus viewport covers.
#include "sessions/format/covered_by_focus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

namespace herr {
namespace {

// xr1: viewports 0 and 2 are the contexts, 1 and 3 the focus viewports, +-20 by +-11.57 degrees less 1 of
// blend.
bool covered(std::size_t viewport, double x_deg, double y_deg,
             const DisplayProfile& profile = xr1_profile()) {
  return covered_by_focus(profile, viewport, std::tan(glm::radians(x_deg)), std::tan(glm::radians(y_deg)));
}

TEST(CoveredByFocusTest, ThePointsWithinTheBlendAreAndThoseOfTheBlendAreNot) {
  for (const std::size_t context : {0u, 2u}) {
    EXPECT_TRUE(covered(context, 0, 0));
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(covered(context, sign * 18.99, 10.56));
      EXPECT_FALSE(covered(context, sign * 19.01, 10.56));
      EXPECT_FALSE(covered(context, sign * 30, 0));
      EXPECT_TRUE(covered(context, 18.99, sign * 10.56));
      EXPECT_FALSE(covered(context, 18.99, sign * 10.58));
      EXPECT_FALSE(covered(context, 0, sign * 40));
    }
  }
}

TEST(CoveredByFocusTest, AFocusViewportIsNeverCovered) {
  EXPECT_FALSE(covered(1, 0, 0));
  EXPECT_FALSE(covered(3, 0, 0));
}

TEST(CoveredByFocusTest, TheOtherEyesFocusCoversNothing) {
  DisplayProfile profile = xr1_profile();
  profile.viewports.erase(profile.viewports.begin() + 3);
  EXPECT_TRUE(covered(0, 0, 0, profile));
  EXPECT_FALSE(covered(2, 0, 0, profile));
}

TEST(CoveredByFocusTest, ABlendThatMeetsItselfLeavesNothing) {
  DisplayProfile profile = xr1_profile();
  profile.viewports[1].edge_blend_deg = 11.6;  // more than half of 23.14 degrees of height
  for (const double y_deg : {-11.0, -5.0, 0.0, 5.0, 11.0}) EXPECT_FALSE(covered(0, 0, y_deg, profile));
}

TEST(CoveredByFocusTest, AFocusAsideOfTheMiddleIsShrunkByAngles) {
  DisplayProfile profile = xr1_profile();
  Viewport& focus = profile.viewports[1];
  // 40 to 44 degrees, less 1 at both sides: by angles 41 to 43.
  focus.tan_left = std::tan(glm::radians(40.0));
  focus.tan_right = std::tan(glm::radians(44.0));
  EXPECT_FALSE(covered(0, 40.99, 0, profile));
  EXPECT_TRUE(covered(0, 41.01, 0, profile));
  EXPECT_TRUE(covered(0, 42.99, 0, profile));
  EXPECT_FALSE(covered(0, 43.01, 0, profile));
}

}  // namespace
}  // namespace herr
