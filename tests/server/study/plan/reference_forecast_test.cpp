// A study whose references would take its time says so after their first pass.
#include "server/study/plan/reference_forecast.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

// Two references: 60 s are half of 2 minutes, 60.4 are more.
TEST(ReferenceForecast, FitsWhereTwoPassesOfBothTakeNoMoreThanHalf) {
  EXPECT_EQ(too_long_references(30, 2, {}, 1), "");
  EXPECT_NE(too_long_references(30.1, 2, {}, 1), "");
}

// 2 x 80 s = 160 s, half of 5.3 minutes; with a quarter more 6.7, in whole minutes 7.
TEST(ReferenceForecast, SaysHowLongTheyTakeAndWhatToTypeInstead) {
  const std::string begin =
      "the references of one frame alone take about 160 s, more than half of --minutes 2: they have one pass "
      "in place of two or more, so that small errors are not told apart; give ";
  RenderSettings asked;
  asked.probes.on = true;
  EXPECT_EQ(too_long_references(80, 2, asked, 1),
            begin + "--preset direct --profile-scale 0.4 or --minutes 7");
  asked.probes.on = false;
  asked.occlusion_rays = 0;
  EXPECT_EQ(too_long_references(80, 2, asked, 0.5), begin + "--profile-scale 0.4 or --minutes 7");
  EXPECT_EQ(too_long_references(80, 2, asked, 0.4), begin + "--minutes 7");
}

}  // namespace
}  // namespace herr
