// Numbers of foreign files: the value is the nearest double, whatever the notation; what is no number is
// none.
#include "sessions/import/tables/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace herr::test {
namespace {

TEST(NumberText, IsTheNearestDouble) {
  // strtod of the C library rounds correctly, in the locale "C" that tests run in.
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    std::string text = i % 2 == 0 ? "-" : "";
    const int digits = 1 + static_cast<int>(random() % 22);
    for (int d = 0; d < digits; ++d) text += static_cast<char>('0' + random() % 10);
    text.insert(text.size() - random() % static_cast<unsigned>(digits), ".");
    if (i % 3 == 0) text += "e" + std::to_string(static_cast<int>(random() % 60) - 30);
    const auto value = parse_number(text, '.');
    ASSERT_TRUE(value) << text;
    EXPECT_EQ(*value, std::strtod(text.c_str(), nullptr)) << text;
    text.replace(text.find('.'), 1, ",");
    EXPECT_EQ(parse_number(text, ','), value) << text;
  }
}

TEST(NumberText, HasTheFormsThatProgramsWrite) {
  EXPECT_EQ(parse_number("+1.5", '.'), 1.5);
  EXPECT_EQ(parse_number(".5", '.'), 0.5);
  EXPECT_EQ(parse_number("5.", '.'), 5.0);
  EXPECT_EQ(parse_number("1.305031102175300121E+09", '.'), 1305031102.1753001);
  EXPECT_EQ(parse_number("1e-999", '.'), 0.0);
  EXPECT_TRUE(std::signbit(*parse_number("-0.0", '.')));
  for (const char* text : {"",     "-",   "+",   ".",  "1,5", "1.2.3", "1e",    "1e+",     "1e+-5",  "+-1",
                           "0x10", "inf", "nan", "1 ", " 1",  "1f",    "1e999", "1.234,5", "1.#INF", "e5"})
    EXPECT_FALSE(parse_number(text, '.')) << text;
  EXPECT_FALSE(parse_number("1.5", ','));
}

TEST(NumberText, KnowsTheWordsForNone) {
  for (const char* text :
       {"", "nan", "NaN", "NAN", "-nan", "-nan(ind)", "nan(snan)", "1.#QNAN", "-1.#IND", "-1.#IND00", "NULL",
        "null", "None", "N/A", "NA", "(nan, nan, nan)", "[1 2 NaN]", "()"})
    EXPECT_TRUE(stands_for_no_number(text)) << text;
  for (const char* text :
       {"0", "-1", "1.5", "inf", "1.#INF", "nanny", "none of them", "VALID", "(1, 2, 3)", "-"})
    EXPECT_FALSE(stands_for_no_number(text)) << text;
}

TEST(NumberText, OfSeveralNumbersPartsThem) {
  const auto parts = [](std::string_view rest, char decimal) {
    std::string result;
    for (auto part = take_number(rest, decimal); !part.empty(); part = take_number(rest, decimal))
      result += (result.empty() ? "" : "|") + std::string(part);
    return result;
  };
  EXPECT_EQ(parts("1.0, 2.0,3.0", '.'), "1.0|2.0|3.0");
  EXPECT_EQ(parts("  1.0   2.0;3.0 ", '.'), "1.0|2.0|3.0");
  EXPECT_EQ(parts("0,1, 1,6, 0,2", ','), "0,1|1,6|0,2");
  EXPECT_EQ(parts("0,1; 1,6 0,2", ','), "0,1|1,6|0,2");
  EXPECT_EQ(without_brackets("(1, 2)"), "1, 2");
  EXPECT_EQ(without_brackets("[1, 2)"), "[1, 2)");
  EXPECT_TRUE(reads_as_number("(0,1, 1,6)", ','));
  EXPECT_FALSE(reads_as_number("(0,1, 1,6)", '.')) << "a comma in two meanings";
  EXPECT_FALSE(reads_as_number("(0.1, 1.6)", ','));
}

}  // namespace
}  // namespace herr::test
