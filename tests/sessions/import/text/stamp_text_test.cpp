// Stamps as text: exact to the nanosecond, signed, in every unit.
#include "sessions/import/text/stamp_text.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>

#include "sessions/format/session_header.h"

namespace herr {
namespace {

TEST(StampText, IsReadToTheNanosecond) {
  // As a double, 1706706430.3645852 s is 1706706430364585161 ns: 39 ns off.
  EXPECT_EQ(parse_stamp("1706706430.3645852", TimeUnit::s), 1706706430364585200);
  EXPECT_EQ(parse_stamp("1.305031102175300e+09", TimeUnit::s), 1305031102175300000);
  EXPECT_EQ(parse_stamp("92.15434", TimeUnit::s), 92154340000);
  EXPECT_EQ(parse_stamp("149202610", TimeUnit::us), 149202610000);
  EXPECT_EQ(parse_stamp("1403715273262142976", TimeUnit::ns), 1403715273262142976);
  EXPECT_EQ(parse_stamp("12.5", TimeUnit::ms), 12500000);
  EXPECT_EQ(parse_stamp("0.5", TimeUnit::ns), 1) << "half a nanosecond is rounded up";
  EXPECT_EQ(parse_stamp("0.4999", TimeUnit::ns), 0);
  EXPECT_EQ(parse_stamp("0", TimeUnit::s), 0);
  EXPECT_EQ(parse_stamp("000.000", TimeUnit::s), 0);
  EXPECT_EQ(parse_stamp("1e-30", TimeUnit::s), 0);
  EXPECT_EQ(parse_stamp("+7.", TimeUnit::us), 7000);
  EXPECT_EQ(parse_stamp(".25", TimeUnit::us), 250);
}

TEST(StampText, HoldsMoreDigitsThanAWord) {
  // 20 and more digits that count: the first 19 and the rounding behind them decide.
  EXPECT_EQ(parse_stamp("1706706430.36458520049999999999999", TimeUnit::s), 1706706430364585200);
  EXPECT_EQ(parse_stamp("1706706430.36458520050000000000000", TimeUnit::s), 1706706430364585201);
  EXPECT_EQ(parse_stamp("1403715273262142976.5", TimeUnit::ns), 1403715273262142977)
      << "the 20th digit rounds";
  EXPECT_EQ(parse_stamp("1403715273262142976.49", TimeUnit::ns), 1403715273262142976);
  EXPECT_EQ(parse_stamp("00000000000000000000000000001.5", TimeUnit::ns), 2) << "leading zeros do not count";
  EXPECT_EQ(parse_stamp("0.00000000000000000000000000015e20", TimeUnit::s), 15);
  EXPECT_EQ(parse_stamp("14037152732621429760e-1", TimeUnit::ns), 1403715273262142976);
}

TEST(StampText, MayLieBeforeTheZeroOfItsClock) {
  EXPECT_EQ(parse_stamp("-0.3", TimeUnit::s), -300000000);
  EXPECT_EQ(parse_stamp("-1", TimeUnit::ns), -1);
  EXPECT_EQ(parse_stamp("-0.5", TimeUnit::ns), -1) << "halves go away from zero";
  EXPECT_EQ(parse_stamp("-2.5e-3", TimeUnit::ms), -2500);
  EXPECT_EQ(parse_stamp("-0.000", TimeUnit::s), 0);
  EXPECT_EQ(parse_stamp("-4000000000", TimeUnit::s), -kLastStampNs);
}

TEST(StampText, MayHaveADecimalComma) {
  EXPECT_EQ(parse_stamp("2,5", TimeUnit::s, ','), 2500000000);
  EXPECT_EQ(parse_stamp("-1,5E1", TimeUnit::ms, ','), -15000000);
  EXPECT_FALSE(parse_stamp("2.5", TimeUnit::s, ','));
  EXPECT_FALSE(parse_stamp("1.234,5", TimeUnit::s, ','));
}

TEST(StampText, OfDotNetCountsFrom1970) {
  // 621355968000000000 ticks of 100 ns lie between 0001-01-01 and 1970-01-01.
  EXPECT_EQ(parse_stamp("621355968000000000", TimeUnit::dotnet_ticks), 0);
  // 2023-10-24 19:51:28.2596202 is Unix time 1698177088.2596202.
  EXPECT_EQ(parse_stamp("638337738882596202", TimeUnit::dotnet_ticks), 1698177088259620200);
  EXPECT_EQ(parse_stamp("621355967999999999", TimeUnit::dotnet_ticks), -100);
  EXPECT_FALSE(parse_stamp("0", TimeUnit::dotnet_ticks)) << "the year 1";
  EXPECT_FALSE(parse_stamp("-621355968000000000", TimeUnit::dotnet_ticks));
}

TEST(StampText, OfWindowsCountsFrom1970) {
  // 116444736000000000 steps of 100 ns lie between 1601-01-01 and 1970-01-01 (134774 days of 86400 s).
  EXPECT_EQ(parse_stamp("116444736000000000", TimeUnit::filetime), 0);
  EXPECT_EQ(parse_stamp("132812345678901234", TimeUnit::filetime), 1636760967890123400);
  EXPECT_EQ(parse_stamp("132812345678901234.25", TimeUnit::filetime), 1636760967890123425);
  EXPECT_EQ(parse_stamp("1.32812345678901234E+17", TimeUnit::filetime), 1636760967890123400);
  EXPECT_FALSE(parse_stamp("1636760967890123400", TimeUnit::filetime))
      << "nanoseconds since 1970 are no FILETIME";
}

TEST(StampText, ThatIsNoStampIsRefused) {
  for (const char* text : {"",
                           "-",
                           "+",
                           "+-1",
                           "--1",
                           "nan",
                           "inf",
                           "1,5",
                           "1.5.2",
                           "12a",
                           "0x10",
                           "1e",
                           "1e+",
                           "1e+-2",
                           "1e99",
                           "e5",
                           ".",
                           " 1",
                           "1 ",
                           "12345678:9",
                           "123456789012345678/",
                           "4000000000.000000001",
                           "-4000000000.000000001",
                           "99999999999999999999",
                           "999999999999999999999999999999",
                           "1e20"})
    EXPECT_FALSE(parse_stamp(text, TimeUnit::s)) << "'" << text << "'";
  EXPECT_FALSE(parse_stamp(std::string(65, '0'), TimeUnit::s)) << "no tool writes such numbers";
  EXPECT_EQ(parse_stamp("4000000000", TimeUnit::s), kLastStampNs) << "the last stamp that is allowed";
}

TEST(StampText, HasWordsForItsUnits) {
  for (const char* word : {"s", "ms", "us", "ns", "dotnet-ticks", "filetime"}) {
    const std::optional<TimeUnit> unit = time_unit(word);
    ASSERT_TRUE(unit) << word;
    EXPECT_STREQ(word_of(*unit), word);
  }
  EXPECT_FALSE(time_unit("min"));
}

// The same by moving the point through the text, for values well within range.
TimeNs moved_point(const std::string& whole, const std::string& fraction, int power) {
  std::string digits = fraction + std::string(40, '0');
  const std::string ns = whole + digits.substr(0, static_cast<std::size_t>(power));
  return std::stoll(ns) + (digits[static_cast<std::size_t>(power)] >= '5' ? 1 : 0);
}

TEST(StampText, AgreesWithAPointThatIsMovedInTheText) {
  std::mt19937 random(15);
  const auto digits = [&](unsigned most) {
    std::string text;
    for (auto n = random() % (most + 1); n > 0; --n) text += static_cast<char>('0' + random() % 10);
    return text;
  };
  for (int i = 0; i < 20000; ++i) {
    const int power = static_cast<int>(random() % 4) * 3;
    const TimeUnit unit = power == 0   ? TimeUnit::ns
                          : power == 3 ? TimeUnit::us
                          : power == 6 ? TimeUnit::ms
                                       : TimeUnit::s;
    const std::string whole = "0" + digits(static_cast<unsigned>(18 - power)), fraction = digits(25);
    const std::string text = whole + "." + fraction;
    ASSERT_EQ(parse_stamp(text, unit), moved_point(whole, fraction, power)) << text << " " << word_of(unit);
    ASSERT_EQ(parse_stamp("-" + text, unit), -moved_point(whole, fraction, power)) << text;
  }
}

}  // namespace
}  // namespace herr
