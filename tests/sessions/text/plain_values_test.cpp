#include "sessions/text/plain_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace herr {
namespace {

template <typename Reader>
std::string complaint(Reader&& read) {
  try {
    read();
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(PlainValues, WholeNumbersAreDigitsAlone) {
  EXPECT_EQ(whole_number_from("0", 0, 9), 0);
  EXPECT_EQ(whole_number_from("4294967295", 0, 4294967295), 4294967295);
  for (const char* text : {"", "-1", "+1", "010", "1e3", "1.0", " 5", "5 ", "0x10", "99999999999999999999"}) {
    EXPECT_NE(complaint([&] { whole_number_from(text, 0, 1000); }), "") << text;
  }
  EXPECT_EQ(complaint([] { whole_number_from("65", 1, 64); }), "'65' is out of range: 1 to 64");
  EXPECT_EQ(complaint([] { whole_number_from("-5", 1, 64); }), "'-5' is out of range: 1 to 64");
  EXPECT_EQ(complaint([] { whole_number_from("99999999999999999999", 1, 64); }),
            "'99999999999999999999' is out of range: 1 to 64");
  EXPECT_EQ(complaint([] { whole_number_from("6e1", 1, 64); }),
            "'6e1' is not a whole number from 1 to 64; write 60");
}

TEST(PlainValues, RealNumbersHaveAtMostOnePoint) {
  EXPECT_EQ(real_number_from("0.3", 0, 1), 0.3);
  for (const char* text : {"", ".5", "5.", "1e3", "nan", "inf", "01", "1,5", "-0.1", "1.5.2", "1e999"}) {
    EXPECT_NE(complaint([&] { real_number_from(text, 0, 1000); }), "") << text;
  }
  EXPECT_EQ(complaint([] { real_number_from("2", 0.001, 1e-2); }), "'2' is out of range: 0.001 to 0.01");
  EXPECT_EQ(complaint([] { real_number_from("-20", -15, 15); }), "'-20' is out of range: -15 to 15");
  EXPECT_EQ(complaint([] { real_number_from("-0.5", 0, 1); }), "'-0.5' is out of range: 0 to 1");
  EXPECT_EQ(complaint([] { real_number_from("2m", 0, 1); }),
            "'2m' is not a number from 0 to 1; write the number alone, without a unit");
  EXPECT_EQ(complaint([] { whole_number_from("50 %", 0, 100); }),
            "'50 %' is not a whole number from 0 to 100; write the number alone, without a unit");
}

TEST(PlainValues, ANumberWrittenOtherwiseIsToldAsItIsWrittenHere) {
  const struct {
    const char *text, *written;
  } whole[] = {{"+1", "1"},
               {"010", "10"},
               {"1e2", "100"},
               {" 5", "5"},
               {"1.0", "1"},
               {"-010", "plain decimal digits"},  // out of range: no advice
               {"1e9", "plain decimal digits"},
               {"1.5", "plain decimal digits"},
               {"0x10", "plain decimal digits"},
               {"nan", "plain decimal digits"},
               {"", "plain decimal digits"}};
  for (const auto& [text, written] : whole)
    EXPECT_EQ(complaint([&, t = text] { whole_number_from(t, 0, 1000); }),
              std::string("'") + text + "' is not a whole number from 0 to 1000; write " + written);
  const struct {
    const char *text, *written;
  } real[] = {{"+1.50", "1.5"},
              {".5", "0.5"},
              {"5.", "5"},
              {"1,5", "1.5"},
              {"1e1", "10"},
              {"-.5", "-0.5"},
              {"007", "7"},
              {"-00", "0"},
              {"1,5,2", "it as 12 or 1.5"},
              {"1e3", "it as 12 or 1.5"},
              {"inf", "it as 12 or 1.5"},
              {"1.5.2", "it as 12 or 1.5"}};
  for (const auto& [text, written] : real)
    EXPECT_EQ(complaint([&, t = text] { real_number_from(t, -15, 15); }),
              std::string("'") + text + "' is not a number from -15 to 15; write " + written);
}

TEST(PlainValues, NumbersReadBackAsTheSame) {
  for (const double value : {0.0, 0.1, 1e6, 1.0 / 3, 1e-300, 1.7976931348623157e308}) {
    EXPECT_EQ(real_number_from(plain_number_text(value), 0, value), value) << plain_number_text(value);
  }
  EXPECT_EQ(plain_number_text(1e6), "1000000");
}

TEST(PlainValues, AnUnknownWordNamesTheNearest) {
  EXPECT_EQ(word_from("off", {"on", "off"}), 1u);
  EXPECT_EQ(complaint([] {
              word_from("virtul", {"virtual", "max"});
            }),
            "'virtul' is not one of virtual, max; did you mean virtual?");
  // Two letters of four differ: no guess is better than a wrong one.
  EXPECT_EQ(complaint([] {
              word_from("high", {"hard", "soft", "adaptive"});
            }),
            "'high' is not one of hard, soft, adaptive");
}

}  // namespace
}  // namespace herr
