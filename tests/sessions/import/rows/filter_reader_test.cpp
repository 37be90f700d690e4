// Conditions of a map on the fields of a row.
#include "sessions/import/rows/filter_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/sessions/import/rows/fake_rows.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

RowCondition condition(RowCondition::Kind kind, std::vector<std::string> texts, double limit = 0,
                       std::uint64_t bits = 0, const std::string& column = "a") {
  return {{column, 0}, kind, std::move(texts), limit, bits};
}

// One letter for each field: + where a row with it passes.
std::string passing(const RowCondition& condition, const std::string& fields) {
  std::vector<std::string> rows(1);
  for (const char c : fields)
    if (c == ' ')
      rows.emplace_back();
    else
      rows.back() += c;
  FakeRows source("a", rows);
  const RowFilter filter{{condition}, {}};
  const FilterReader reader(source, filter);
  std::string marks;
  while (source.next()) marks += reader.passes(source) ? '+' : '.';
  return marks;
}

using Kind = RowCondition::Kind;

TEST(RowConditions, CompareTheWholeFieldAsWritten) {
  EXPECT_EQ(passing(condition(Kind::is, {"1"}), "1 1.0 - 10"), "+...");
  EXPECT_EQ(passing(condition(Kind::is_not, {"0"}), "1 0 - 00"), "+.++");
  EXPECT_EQ(passing(condition(Kind::one_of, {"2", "VALID"}), "1 2 VALID valid 22 -"), ".++...");
}

TEST(RowConditions, OnNumbersDoNotPassWithoutANumber) {
  EXPECT_EQ(passing(condition(Kind::above, {}, 0.5), "0.5 0.6 1e3 -1 nan -nan(ind) inf -"), ".++.....");
  EXPECT_EQ(passing(condition(Kind::below, {}, 0.5), "0.5 0.4 -1e3 NaN -inf NULL -"), ".++....");
  EXPECT_EQ(passing(condition(Kind::finite, {}),
                    "0 -1.5 nan -nan(ind) inf -Infinity 1.#INF NULL - (1,_2) (1,_nan)"),
            "++.......+.");
}

// 31 = 11111, 27 = 11011, 4 = 00100 in binary; -1 has all bits.
TEST(RowConditions, TestBitsOfWholeNumbers) {
  EXPECT_EQ(passing(condition(Kind::has_bits, {}, 0, 5), "31 27 4 5 -1 31.0 0x1F 0x1a - nan"), "+..++++...");
  EXPECT_EQ(passing(condition(Kind::has_bits, {}, 0, std::uint64_t{1} << 63),
                    "9223372036854775808 9223372036854775807 -9223372036854775808"),
            "+.+");
  for (const std::string field : {"31.5", "abc", "0x", "-"}) {
    FakeRows source("a", {field == "-" ? "--" : field});
    const RowFilter filter{{condition(Kind::has_bits, {}, 0, 1)}, {}};
    const FilterReader reader(source, filter);
    ASSERT_TRUE(source.next());
    EXPECT_INPUT_ERROR(reader.passes(source), "log.csv:2: column 'a' is '" + (field == "-" ? "--" : field) +
                                                  "', not a whole number, and has no bits");
  }
}

TEST(RowConditions, OfAllMustPassAndOneOfAny) {
  const RowFilter filter{{condition(Kind::is, {"1"}, 0, 0, "a")},
                         {condition(Kind::above, {}, 0, 0, "b"), condition(Kind::above, {}, 0, 0, "c")}};
  FakeRows source("a b c", {"1 1 1", "1 0 1", "1 1 0", "1 0 0", "0 1 1"});
  const FilterReader reader(source, filter);
  std::string marks;
  while (source.next()) marks += reader.passes(source) ? '+' : '.';
  EXPECT_EQ(marks, "+++..");
  std::vector<ColumnRef> columns;
  add_columns(filter, columns);
  ASSERT_EQ(columns.size(), 3u);
  EXPECT_EQ(columns[2].name, "c");
  ASSERT_EQ(source.next(), false);
}

TEST(RowConditions, OnNumbersRefuseOtherText) {
  FakeRows source("a", {"good"});
  const RowFilter filter{{condition(Kind::above, {}, 0)}, {}};
  const FilterReader reader(source, filter);
  ASSERT_TRUE(source.next());
  EXPECT_INPUT_ERROR(reader.passes(source), "column 'a' is 'good'");
}

}  // namespace
}  // namespace herr::test
