// Stamps of rows by the time columns of a map.
#include "sessions/import/rows/time_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/sessions/import/rows/fake_rows.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

using Kind = TimeColumns::Kind;
using Stamps = std::vector<TimeNs>;

TimeColumns in_unit(TimeUnit unit) {
  TimeColumns columns;
  columns.column.name = "t";
  columns.unit = unit;
  return columns;
}

Stamps stamps_of(const TimeColumns& columns, const std::vector<std::string>& rows, char decimal = '.') {
  FakeRows source("t ns", rows, decimal);
  TimeReader reader(source, columns);
  Stamps stamps;
  while (source.next()) stamps.push_back(reader.read(source));
  return stamps;
}

TEST(TimeColumnsOfRows, AreNumbersOfAUnitWithSign) {
  EXPECT_EQ(stamps_of(in_unit(TimeUnit::ms), {"10", "-0.5", "1750000000350.25"}),
            (Stamps{10'000'000, -500'000, 1'750'000'000'350'250'000}));
  EXPECT_EQ(stamps_of(in_unit(TimeUnit::s), {"2,5"}, ','), Stamps{2'500'000'000});
  // (132812344678901234 - 116444736000000000) x 100 ns since 1970.
  EXPECT_EQ(stamps_of(in_unit(TimeUnit::filetime), {"132812344678901234"}),
            Stamps{1'636'760'867'890'123'400});
}

TEST(TimeColumnsOfRows, AreMovedAndScaledToTheNanosecond) {
  TimeColumns columns = in_unit(TimeUnit::ns);
  columns.offset_ns = -1'700'000'000'000'000'001;
  EXPECT_EQ(stamps_of(columns, {"1700000000123456789", "0"}),
            (Stamps{123'456'788, -1'700'000'000'000'000'001}));
  // A counter of 24 MHz: 24000000 ticks are a second, 7 are 291.67 ns.
  columns = in_unit(TimeUnit::s);
  columns.scale = 1.0 / 24e6;
  EXPECT_EQ(stamps_of(columns, {"24000000", "7"}), (Stamps{1'000'000'000, 292}));
  // Days since 1899-12-30, as spreadsheets write dates: 45000.25 is 2023-03-15 06:00, 1678860000 s since
  // 1970. A second is 1 / 86400 of a day, and twelve decimals of a day are known to 43 ns; a double near
  // 45000 to 0.3 us.
  columns.scale = 86400;
  columns.offset_ns = -2'209'161'600'000'000'000;
  const Stamps days = stamps_of(columns, {"45000.25", "45000.250011574074"});
  EXPECT_EQ(days[0], 1'678'860'000'000'000'000);
  EXPECT_NEAR(static_cast<double>(days[1] - days[0]), 1e9, 400);
}

TEST(TimeColumnsOfRows, AreWholeSecondsAndNanoseconds) {
  TimeColumns columns;
  columns.kind = Kind::seconds_nanoseconds;
  columns.column.name = "t";
  columns.nanoseconds.name = "ns";
  EXPECT_EQ(stamps_of(columns, {"1700000000 950000001", "-1 700000000", "3.0 0"}),
            (Stamps{1'700'000'000'950'000'001, -300'000'000, 3'000'000'000}));
  EXPECT_INPUT_ERROR(stamps_of(columns, {"1 0", "1.5 0"}),
                     "log.csv:3: column 't' is '1.5', no whole seconds");
  EXPECT_INPUT_ERROR(stamps_of(columns, {"1 1000000000"}), "column 'ns' is '1000000000', not 0 to 999999999");
  EXPECT_INPUT_ERROR(stamps_of(columns, {"1 -1"}), "column 'ns' is '-1', not 0 to 999999999");
}

TEST(TimeColumnsOfRows, AreDatesInTheZoneOfTheMap) {
  TimeColumns columns;
  columns.kind = Kind::date;
  columns.column.name = "t";
  columns.zone_minutes = 60;
  // 2016-12-13 is day 17148 since 1970; 21:21:13.011 an hour east of Greenwich is 20:21:13.011 there.
  EXPECT_EQ(stamps_of(columns, {"2016-12-13_21:21:13.011"}),
            Stamps{(17148LL * 86400 + 20 * 3600 + 21 * 60 + 13) * 1'000'000'000 + 11'000'000});
  EXPECT_INPUT_ERROR(
      stamps_of(columns, {"1700000000.5"}),
      "is '1700000000.5', no date as year-month-day hour:minute:second; a number: write its \"unit\"");
  columns.date_format = "%d.%m.%Y";
  EXPECT_INPUT_ERROR(stamps_of(columns, {"2016-12-13"}),
                     "is '2016-12-13', no date as '%d.%m.%Y'; check \"date\"");
}

TEST(TimeColumnsOfRows, AreCountedWithARate) {
  TimeColumns columns;
  columns.kind = Kind::rate;
  columns.rate_hz = 30;
  columns.offset_ns = 500;
  EXPECT_EQ(stamps_of(columns, {"a b", "a b", "a b", "a b"}),
            (Stamps{500, 33'333'833, 66'667'167, 100'000'500}));
  // A row that cannot be cut has its time all the same.
  FakeRows source("t ns", {"a b", "a b"});
  TimeReader reader(source, columns);
  EXPECT_EQ(reader.read(source), 500);
  reader.pass_over();
  EXPECT_EQ(reader.read(source), 66'667'167);
  std::vector<ColumnRef> asked;
  add_columns(columns, asked);
  EXPECT_TRUE(asked.empty());
}

struct Fault {
  std::string field, words;
  TimeUnit unit = TimeUnit::s;
  char decimal = '.';
};

class IllegibleStamp : public ::testing::TestWithParam<Fault> {};

TEST_P(IllegibleStamp, IsQuotedWithItsLikelyCause) {
  const Fault& fault = GetParam();
  EXPECT_INPUT_ERROR(stamps_of(in_unit(fault.unit), {fault.field + " 0"}, fault.decimal),
                     "log.csv:2: column 't' " + fault.words);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, IllegibleStamp,
    ::testing::Values(
        Fault{"12,5", "is '12,5': a decimal comma; write \"decimal\": \",\" into the map"},
        Fault{"12.5", "is '12.5': a decimal point; write \"decimal\": \".\" into the map", TimeUnit::s, ','},
        Fault{"2016-12-13_21:21:13",
              "is '2016-12-13 21:21:13': a date; write {\"column\": ..., \"date\": \"\"}"},
        Fault{"13.12.2016", "is '13.12.2016': a date"},
        Fault{"1700000000000000000000",
              "is '1700000000000000000000', no time stamp in range; check the time unit"},
        Fault{"1700000000000", "is '1700000000000', no time stamp in range; check the time unit"},
        // Seconds since 1970 as ticks since the year 1 lie in that year, more than 126 years before 1970.
        Fault{"1700000000", "is '1700000000', no time stamp in range; check the time unit",
              TimeUnit::dotnet_ticks},
        Fault{"timestamp", "is 'timestamp', no time stamp; if the line names the columns, put # before it"},
        Fault{"t1", "is 't1', no time stamp; correct or remove the line"},
        Fault{"-", "is empty, no time stamp; remove the line"},
        Fault{"nan", "is 'nan', no time stamp; remove the line"}));

TEST(TimeColumnsOfRows, BeyondTheRangeOnceMovedAreRefused) {
  TimeColumns columns = in_unit(TimeUnit::s);
  columns.scale = 1000;
  EXPECT_INPUT_ERROR(stamps_of(columns, {"1700000000"}),
                     "is '1700000000', with scale and offset no time stamp");
  columns.scale = 1;
  columns.offset_ns = 9'000'000'000'000'000'000;
  EXPECT_INPUT_ERROR(stamps_of(columns, {"3900000000"}),
                     "is '3900000000', with scale and offset no time stamp");
}

}  // namespace
}  // namespace herr::test
