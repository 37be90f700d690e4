// The settings of `herr study --hz` in their order.
#include "server/study/rate/rate_ladder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace herr {
namespace {

void expect_ascending(const std::vector<RateSetting>& ladder) {
  for (std::size_t i = 1; i < ladder.size(); ++i) {
    const RateSetting &a = ladder[i - 1], &b = ladder[i];
    EXPECT_GE(b.polar_width, a.polar_width) << i;
    EXPECT_GE(b.polar_height, a.polar_height) << i;
    EXPECT_GE(b.light_samples, a.light_samples) << i;
    EXPECT_GE(b.profile_scale, a.profile_scale) << i;
    EXPECT_FALSE(a == b) << i;
    EXPECT_EQ(b.polar_height % 2, 0) << i;
    // A scale is what a flag takes, and hundredths.
    EXPECT_NEAR(100 * b.profile_scale, std::round(100 * b.profile_scale), 1e-9) << i;
  }
}

// An eighth of 788 is 98, a quarter of 768 is 192. From 98 x 192 to 788 x 768 samples grow 32.2 times: 72
// steps of 5 % at least. Then 2, 3, 4, 6, 8 ... 256 light samples: 15 more.
TEST(RateLadder, OfThePaperGrowsInPictureThenInLight) {
  const std::vector<RateSetting> ladder = rate_ladder({788, 768, 256, 1});
  EXPECT_EQ(ladder.front(), (RateSetting{98, 192, 1, 0.1}));
  EXPECT_EQ(ladder.back(), (RateSetting{788, 768, 256, 1}));
  EXPECT_GE(ladder.size(), 80u);
  EXPECT_LE(ladder.size(), 95u);
  expect_ascending(ladder);
  bool whole = false;
  std::vector<int> light;
  for (std::size_t i = 1; i < ladder.size(); ++i) {
    const auto samples = [](const RateSetting& s) { return double(s.polar_width) * s.polar_height; };
    // 5 %, and what a width of 98 and a height of 192 round to: 1 / 98 and 2 / 192.
    EXPECT_LE(samples(ladder[i]) / samples(ladder[i - 1]), 1.05 * (1 + 1.0 / 98) * (1 + 2.0 / 192)) << i;
    if (ladder[i].light_samples > 1) {
      EXPECT_EQ(ladder[i].polar_width, 788);
      EXPECT_EQ(ladder[i].polar_height, 768);
      EXPECT_EQ(ladder[i].profile_scale, 1);
      light.push_back(ladder[i].light_samples);
    } else {
      whole = whole || ladder[i] == RateSetting{788, 768, 1, 1};
    }
  }
  EXPECT_TRUE(whole) << "the paper's frame itself is one of them";
  EXPECT_EQ(light, (std::vector<int>{2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256}));
}

TEST(RateLadder, OfAnythingEndsAtTheMostAndIsAscending) {
  for (const int width : {1, 2, 7, 8, 64, 788, 8192}) {
    for (const int height : {2, 4, 48, 768, 8192}) {
      for (const int light : {1, 2, 5, 64, 4096}) {
        for (const double scale : {0.1, 0.13, 0.5, 1.0}) {
          SCOPED_TRACE(testing::Message() << width << "x" << height << ", " << light << ", " << scale);
          const RateSetting most{width, height, light, scale};
          const std::vector<RateSetting> ladder = rate_ladder(most);
          ASSERT_FALSE(ladder.empty());
          EXPECT_EQ(ladder.back(), most);
          EXPECT_GE(ladder.front().profile_scale, 0.1);
          expect_ascending(ladder);
        }
      }
    }
  }
}

TEST(RateLadder, TextsAreThoseThatFlagsTake) {
  EXPECT_EQ(polar_text({394, 384, 16, 0.5}), "788x384");
  EXPECT_EQ(text_of(RateSetting{394, 384, 16, 0.5}), "polar 788x384, light samples 16, profile scale 0.5");
}

}  // namespace
}  // namespace herr
