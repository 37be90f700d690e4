// What a check that could not tell asks for.
#include "server/check/check_advice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace herr {
namespace {

TEST(CheckAdvice, CountsThePairsThatAreMissingAndTheSecondsThatTheyTake) {
  // (100 + 18 x 4) x 1.2 = 206.4 s, rounded up to tens.
  EXPECT_EQ(more_runs_advice({"pair", "pairs", 3, 18, 100, 4}),
            "it takes 3 more pairs at least, 18 at most: --max-seconds 210");
  // (10 + 1 x 2.5) x 1.2 = 15.
  EXPECT_EQ(more_runs_advice({"pair", "pairs", 1, 1, 10, 2.5}), "it takes 1 more pair: --max-seconds 20");
  EXPECT_EQ(more_runs_advice({"run", "runs", 7, 7, 3, 1}), "it takes 7 more runs: --max-seconds 20");
}

TEST(CheckAdvice, SaysThatNoNumberHelps) {
  EXPECT_EQ(noisy_advice({0.09, 0.01}, "pairs"),
            "no number of pairs helps: repeat it when the machine is quieter, or take --only counters");
  EXPECT_EQ(noisy_advice({0.01, std::nan("")}, "runs"),
            "no number of runs helps: take --only counters, or a machine whose kernel tells");
}

TEST(CheckAdvice, DoublesTheRunsByTheFlagThatSaysTheirLength) {
  EXPECT_EQ(longer_runs_advice({}, 1.5), "all pairs are done, and longer runs tell more: --run-seconds 3");
  EXPECT_EQ(longer_runs_advice(20, 1.5), "all pairs are done, and longer runs tell more: --frames 40");
}

}  // namespace
}  // namespace herr
