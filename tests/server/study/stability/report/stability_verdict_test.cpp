// What results say together: which decide, which is closest to its limit, which are worst.
#include "server/study/stability/report/stability_verdict.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "server/process/exit_code.h"
#include "tests/server/study/stability/report/stability_records.h"

namespace herr {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RelationResult off(RelationResult result) {
  result.relation.option = "adaptive light samples";
  return result;
}

RelationResult absent(RelationResult result) {
  result.not_applicable = "the scene has no light";
  return result;
}

TEST(StabilityVerdict, OneFailureDecidesUnlessItIsOfWhatIsOffOrWasNotAsked) {
  const struct {
    std::vector<RelationResult> results;
    int exit_code;
  } cases[] = {
      {{}, kExitDone},
      {{test::result_of("a", 1, 1)}, kExitDone},  // the bound itself is no fault
      {{test::result_of("a", 0, 0)}, kExitDone},
      {{test::result_of("a", 1.0000001, 1)}, kExitRegression},
      {{test::result_of("a", kNaN, 1)}, kExitRegression},
      {{test::result_of("a", kInfinity, 1)}, kExitRegression},
      {{off(test::result_of("a", 2, 1))}, kExitDone},
      {{absent(test::result_of("a", kNaN, 1))}, kExitDone},
      {{off(test::result_of("a", 2, 1)), test::result_of("b", 0, 1), test::result_of("c", 2, 1)},
       kExitRegression},
  };
  for (std::size_t i = 0; i < std::size(cases); ++i)
    EXPECT_EQ(stability_exit_code(cases[i].results), cases[i].exit_code) << "case " << i;
}

TEST(StabilityVerdict, CountsEachKindOnceAndInWords) {
  const RelationCounts counts = counts_of(test::rich_stability().results);
  EXPECT_EQ(counts.hold, 3);
  EXPECT_EQ(counts.fail, 3);
  EXPECT_EQ(counts.fail_off, 1);
  EXPECT_EQ(counts.not_applicable, 1);
  EXPECT_EQ(counts_text(counts), "3 FAIL, 1 fails of what is off in this run, 3 hold, 1 not applicable");
  EXPECT_EQ(counts_text({}), "no relations");
}

TEST(StabilityVerdict, SaysOfAFailureWhereAndOfWhatIsOffThatItIs) {
  EXPECT_EQ(failure_line(test::rich_stability().results[3]),
            "light: too large FAILS: 0.300, bound 0.1 (largest relative difference); left, pixel (3, 5): 0.3 "
            "instead of 0.2");
  EXPECT_EQ(verdict_text(off(test::result_of("a", 2, 1))), "fails (off in this run: adaptive light samples)");
  EXPECT_EQ(verdict_text(off(test::result_of("a", 1, 1))), "holds");
  EXPECT_EQ(verdict_text(absent(test::result_of("a", 2, 1))), "not applicable");
}

TEST(StabilityVerdict, ClosestToItsLimitIsTheOneThatHoldsWithTheLargestShareOfABoundAboveZero) {
  const StabilityRecord record = test::rich_stability();
  ASSERT_NE(closest_to_limit(record.results), nullptr);
  // 0.00083 of 0.001; the one that is beyond its bound has none left to be close to.
  EXPECT_EQ(closest_text(record.results), "light, near its limit: 83 % of its bound");
  EXPECT_EQ(closest_to_limit(std::vector<RelationResult>{test::result_of("a", 0, 0)}), nullptr);
  const std::vector<RelationResult> quiet{test::result_of("a", 0, 1), absent(test::result_of("b", 0.9, 1))};
  EXPECT_EQ(closest_text(quiet), "none: every error is 0");
}

TEST(StabilityVerdict, WorstAreFailuresThatCountThenOtherFailuresThenThoseNearTheirBound) {
  const StabilityRecord record = test::rich_stability();
  std::string order;
  for (const RelationResult* result : worst_first(record.results)) order += result->relation.name + "; ";
  EXPECT_EQ(order, "no number; beyond all; too large; adaptive mean; near its limit; half way; quiet; ");
}

TEST(StabilityVerdict, NumbersThatAreNoneAreWords) {
  EXPECT_EQ(error_figure(kNaN), "no number");
  EXPECT_EQ(error_figure(kInfinity), "infinite");
  EXPECT_EQ(bound_figure(0.001), "0.001");
  EXPECT_EQ(bound_figure(1.0 / 3), "0.333");
  EXPECT_EQ(share_text(test::result_of("a", 0.03, 1)), "3 %");
  EXPECT_EQ(share_text(test::result_of("a", 27, 1)), "27.0 times");
}

}  // namespace
}  // namespace herr
