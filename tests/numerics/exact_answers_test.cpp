// Each row of the exact answers holds. Error, bound and words go into the test's record, of which
// scripts/numerics makes the page.
#include <gtest/gtest.h>

#include <charconv>
#include <string>
#include <vector>

#include "tests/numerics/exact_answer.h"

namespace herr {
namespace {

std::vector<test::ExactAnswer> all_answers() {
  std::vector<test::ExactAnswer> all;
  for (const auto& rows :
       {test::geometry_answers(), test::light_answers(), test::furnace_answers(), test::probe_answers()}) {
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

// The fewest digits that read back the same.
std::string digits(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

class ExactAnswerTest : public testing::TestWithParam<test::ExactAnswer> {};

TEST_P(ExactAnswerTest, Holds) {
  const test::ExactAnswer& answer = GetParam();
  const double error = answer.error();
  RecordProperty("asks", answer.asks);
  RecordProperty("error", digits(error));
  RecordProperty("bound", digits(answer.bound));
  RecordProperty("unit", answer.unit);
  RecordProperty("bound_from", answer.bound_from);
  EXPECT_GE(error, 0) << answer.asks;  // no NaN
  EXPECT_LE(error, answer.bound) << answer.asks;
}

INSTANTIATE_TEST_SUITE_P(Rows, ExactAnswerTest, testing::ValuesIn(all_answers()),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace herr
