// Dates as text: days counted by hand, zones, fractions; what is no date is refused.
#include "sessions/import/text/date_text.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <optional>
#include <string>

#include "sessions/format/session_header.h"

namespace herr {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;

// 2016-12-13 is day 17148 (46 years of 365 days, 12 leap days, 346 days before it): 17148 * 86400 =
// 1481587200; 21:21:13 is 76873 s later.
constexpr TimeNs kDay = 1481587200 * kSecond, kInstant = 1481664073 * kSecond;

std::optional<TimeNs> iso(const std::string& text, std::optional<int> zone_minutes = {}) {
  return parse_date(text, "", zone_minutes);
}

TEST(DateText, OfIsoIsReadInItsVariants) {
  EXPECT_EQ(iso("2016-12-13 21:21:13.011"), kInstant + 11'000'000);
  for (const char* text :
       {"2016-12-13 21:21:13", "2016-12-13T21:21:13Z", "2016/12/13 21:21:13", "20161213T212113",
        "2016-12-13t21:21:13.000z", " 2016-12-13  21:21:13 UTC ", "2016-12-13T22:21:13+01:00",
        "2016-12-13 22:51:13 +0130", "2016-12-13 13:21:13-08", "2016-12-13 21:21:13,0"})
    EXPECT_EQ(iso(text), kInstant) << text;
  EXPECT_EQ(iso("2016-12-13T21:21"), kInstant - 13 * kSecond);
  EXPECT_EQ(iso("2016-12-13T21:21:13.123456789"), kInstant + 123'456'789);
  EXPECT_EQ(iso("2016-12-13T21:21:13.1234567895"), kInstant + 123'456'790);
  EXPECT_EQ(iso("2016-12-13T21:21:13.9999999999"), kInstant + kSecond) << "rounds into the next second";
}

TEST(DateText, TakesTheZoneOfTheTextBeforeTheGivenOne) {
  EXPECT_EQ(iso("2016-12-13 22:21:13", 60), kInstant);
  EXPECT_EQ(iso("2016-12-13 15:51:13", -330), kInstant);
  EXPECT_EQ(iso("2016-12-13 22:21:13+01:00", -480), kInstant);
  EXPECT_TRUE(date_names_zone("2016-12-13 22:21:13+01:00", ""));
  EXPECT_FALSE(date_names_zone("2016-12-13 22:21:13", ""));
  EXPECT_TRUE(date_names_zone("13.12.2016 22:21:13 +0100", "%d.%m.%Y %H:%M:%S %z"));
}

TEST(DateText, FollowsAFormat) {
  const auto read = [](const char* text, const char* format) {
    EXPECT_FALSE(date_format_fault(format)) << format;
    return parse_date(text, format, {});
  };
  EXPECT_EQ(read("13.12.2016 21:21:13,5", "%d.%m.%Y %H:%M:%S,%f"), kInstant + kSecond / 2);
  EXPECT_EQ(read("12/13/16 9:21:13 PM", "%m/%d/%y %I:%M:%S %p"), kInstant);
  EXPECT_EQ(read("Dec  13 2016, 21h21 13s", "%b %d %Y, %Hh%M %Ss"), kInstant);
  EXPECT_EQ(read("13-DECEMBER-2016@21:21:13", "%d-%b-%Y@%H:%M:%S"), kInstant);
  EXPECT_EQ(read("20161213_212113011", "%Y%m%d_%H%M%S%f"), kInstant + 11'000'000);
  EXPECT_EQ(read("2016-348 21:21:13", "%Y-%j %H:%M:%S"), kInstant)
      << "334 days to the end of November, 13 more, the 348th";
  EXPECT_EQ(read("2016:12:13 21:21:13-0100", "%Y:%m:%d %H:%M:%S%z"), kInstant + 3600 * kSecond);
  EXPECT_EQ(read("100% 2016-12-13 21", "100%% %Y-%m-%d %H"), kDay + 21 * 3600 * kSecond);
}

TEST(DateText, KnowsNoonAndMidnightOfTwelveHours) {
  const auto hour = [](const char* text) { return parse_date(text, "%Y-%m-%d %I %p", {}); };
  EXPECT_EQ(hour("2016-12-13 12 AM"), kDay);
  EXPECT_EQ(hour("2016-12-13 12 pm"), kDay + 12 * 3600 * kSecond);
  EXPECT_EQ(hour("2016-12-13 1 PM"), kDay + 13 * 3600 * kSecond);
  EXPECT_FALSE(hour("2016-12-13 13 PM"));
  EXPECT_FALSE(hour("2016-12-13 0 AM"));
}

TEST(DateText, MayLeaveAFractionOfZeroOut) {
  const char* format = "%Y-%m-%d %H:%M:%S.%f %z";
  EXPECT_EQ(parse_date("2016-12-13 21:21:13 Z", format, {}), kInstant);
  EXPECT_EQ(parse_date("2016-12-13 21:21:13.25 Z", format, {}), kInstant + kSecond / 4);
  EXPECT_FALSE(parse_date("2016-12-13 21:21:13. Z", format, {}));
}

TEST(DateText, WithoutADayIsTimeSinceMidnight) {
  EXPECT_EQ(parse_date("00:01:02.5", "%H:%M:%S.%f", {}), 62'500'000'000);
  EXPECT_EQ(parse_date("3:04.250", "%M:%S.%f", {}), 184'250'000'000);
}

TEST(DateText, CountsEveryDay) {
  // Day by day from 1850-01-01, 43829 days before 1970 (120 years, 29 leap days: 1900 is none).
  const int lengths[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  std::int64_t day = -43829;
  for (int year = 1850; year < 2096; ++year)
    for (int month = 1; month <= 12; ++month) {
      const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
      const int length = lengths[month - 1] + (month == 2 && leap ? 1 : 0);
      for (int d = 1; d <= 31; ++d) {
        char text[64];
        std::snprintf(text, sizeof text, "%04d-%02d-%02d 23:59:59", year, month, d);
        if (d > length)
          ASSERT_FALSE(iso(text)) << text;
        else
          ASSERT_EQ(iso(text), (day++ * 86400 + 86399) * kSecond) << text;
      }
    }
}

TEST(DateText, ThatIsNoDateIsRefused) {
  for (const char* text : {"",
                           "2016-12-13",
                           "21:21:13",
                           "2016-13-01 00:00:00",
                           "2016-00-01 00:00:00",
                           "2016-04-31 00:00:00",
                           "2015-02-29 00:00:00",
                           "2016-12-13 24:00:00",
                           "2016-12-13 21:60:00",
                           "2016-12-31 23:59:60",
                           "2016-12-13 21:21:13.",
                           "2016-12-13 21:21:13 CET",
                           "2016-12-13 21:21:13+15:00",
                           "2016-12-13 21:21:13+1",
                           "2016-12-13 21:21:13+01:60",
                           "2016-12-13 21:21:13 x",
                           "2016-12/13 21:21:13",
                           "16-12-13 21:21:13",
                           "2016-12-13X21:21:13",
                           "1481664073",
                           "1601-01-01 00:00:00",
                           "9999-12-31 00:00:00"})
    EXPECT_FALSE(iso(text)) << "'" << text << "'";
  EXPECT_FALSE(parse_date("2015 366 00", "%Y %j %H", {}));
  EXPECT_FALSE(parse_date("2015 0 00", "%Y %j %H", {}));
  EXPECT_FALSE(parse_date("2016-12-1321", "%Y-%m-%d %H", {})) << "a blank is a blank";
  EXPECT_FALSE(parse_date("Foo 13 2016 21", "%b %d %Y %H", {}));
}

TEST(DateText, EndsWhereStampsEnd) {
  // kLastStampNs is 4e9 s: 2096-10-02 07:06:40.
  EXPECT_EQ(iso("2096-10-02 07:06:40"), kLastStampNs);
  EXPECT_FALSE(iso("2096-10-02 07:06:40.000000001"));
  EXPECT_EQ(iso("1969-12-31 23:59:59.75"), -kSecond / 4);
}

TEST(DateText, FindsFaultsOfFormats) {
  const auto problem = [](const char* format) {
    const auto fault = date_format_fault(format);
    return fault ? fault->problem : "sound";
  };
  EXPECT_EQ(problem(""), "sound");
  EXPECT_EQ(problem("%Y-%m-%d %Q"), "has %Q");
  EXPECT_EQ(problem("%Y-%m-%d %H:%M:%"), "ends with a single %");
  EXPECT_EQ(problem("%H:%M:%S %H"), "has %H twice");
  EXPECT_EQ(problem("%Y-%m-%d %H:%I %p"), "has both %H and %I");
  EXPECT_EQ(problem("%m-%d %H:%M"), "names no whole day");
  EXPECT_EQ(problem("%Y %H:%M"), "names no whole day");
  EXPECT_EQ(problem("%Y-%m-%d"), "names a day without an hour");
  EXPECT_EQ(problem("time"), "names no time");
  EXPECT_EQ(problem("%I:%M"), "has %I without %p");
  EXPECT_EQ(problem("%H:%M %p"), "has %p without %I");
  EXPECT_EQ(problem("%H:%S"), "has hours and seconds without minutes");
  EXPECT_EQ(problem("%H:%M.%f"), "has %f without %S");
}

TEST(DateText, ReadsZones) {
  EXPECT_EQ(parse_zone("Z"), 0);
  EXPECT_EQ(parse_zone("+01:00"), 60);
  EXPECT_EQ(parse_zone("-0330"), -210);
  EXPECT_EQ(parse_zone("+14"), 840);
  for (const char* text : {"", "01:00", "+1", "+14:01", "+01:00x", "Europe/Berlin", "CET"})
    EXPECT_FALSE(parse_zone(text)) << text;
}

}  // namespace
}  // namespace herr
