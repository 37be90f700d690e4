// What the line of progress of a check says.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "server/check/check_progress.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Noise kQuiet{0.01, 0.0};

TEST(CheckProgress, SaysHowThingsStandSoFar) {
  EXPECT_EQ(state_so_far(kQuiet, {0.01, std::log(1.08), 0.02, 0.1}), "slower so far (+8.0 %)");
  EXPECT_EQ(state_so_far(kQuiet, {0.99, std::log(0.9), -0.2, -0.02}), "faster so far (-10.0 %)");
  EXPECT_EQ(state_so_far(kQuiet, {0.5, std::log(1.004), -0.01, 0.02}), "same so far (+0.4 %)");
  EXPECT_EQ(state_so_far(kQuiet, {0.25, 0.2, -kInfinity, kInfinity}), "too early to tell");
  EXPECT_EQ(state_so_far({0.09, 0}, {0.01, 0.2, 0.1, 0.3}), "noisy so far");
  EXPECT_EQ(state_so_far({0.01, std::nan("")}, {}), "noisy so far");
}

TEST(CheckProgress, CountsPairsWithTheTimeToTheNextLookAndTheLast) {
  const PairDesign design;
  // 8 pairs of 2 s to the look after 15, 23 to the last one.
  EXPECT_EQ(pair_progress(7, design, "noisy so far", 2, kInfinity),
            "pair 7 of 15–30, noisy so far; 0:16 to 0:46 left");
  EXPECT_EQ(pair_progress(15, design, "same so far (+0.4 %)", 6, kInfinity),
            "pair 15 of 15–30, same so far (+0.4 %); 0:30 to 1:30 left");
  // No longer than --max-seconds leaves.
  EXPECT_EQ(pair_progress(7, design, "noisy so far", 2, 20.5),
            "pair 7 of 15–30, noisy so far; 0:16 to 0:21 left");
  EXPECT_EQ(pair_progress(7, design, "noisy so far", 2, -1),
            "pair 7 of 15–30, noisy so far; 0:00 to 0:00 left");
  EXPECT_EQ(pairs_text(7, design), "7 of 15–30 pairs");
}

TEST(CheckProgress, CountsSingleRunsToo) {
  EXPECT_EQ(run_progress(3, 10, "quiet so far", 2, kInfinity), "run 3 of 10, quiet so far; 0:14 left");
  EXPECT_EQ(run_progress(3, 10, "quiet so far", 2, 5), "run 3 of 10, quiet so far; 0:05 left");
}

TEST(MinutesText, RoundsUp) {
  EXPECT_EQ(minutes_text(0), "0:00");
  EXPECT_EQ(minutes_text(59.2), "1:00");
  EXPECT_EQ(minutes_text(3601), "60:01");
}

}  // namespace
}  // namespace herr
