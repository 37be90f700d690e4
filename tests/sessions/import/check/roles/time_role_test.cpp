#include "sessions/import/check/roles/time_role.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using namespace test;

// Forty rows of `header`, the fields of row i by `fields`.
TimeRole time_of(const std::string& header, const std::function<std::string(int)>& fields) {
  const RecordedFolder folder;
  std::string text = header.empty() ? "" : header + "\n";
  for (int i = 0; i < 40; ++i) text += fields(i) + "\n";
  folder.write("a.csv", text);
  return find_time(*sniff_table(folder / "a.csv"));
}

// 11 ms a row are 90.9 Hz; as seconds, or as microseconds, they would be no rate of a tracker.
TEST(TimeRole, TakesTheUnitThatGivesAUsualRate) {
  const TimeRole role = time_of("t,x", [](int i) { return std::to_string(5000 + 11 * i) + ",1"; });
  EXPECT_EQ(role.time.unit, TimeUnit::ms);
  EXPECT_NEAR(role.step_s, 0.011, 1e-9);
  EXPECT_TRUE(role.questions.empty());
}

// 1.7e12 ms after 1970 is in 2023.
TEST(TimeRole, TellsTheUnitOfAnEpochByItsSize) {
  const TimeRole role =
      time_of("unix,x", [](int i) { return std::to_string(1700000000000 + 100 * i) + ",1"; });
  EXPECT_EQ(role.time.unit, TimeUnit::ms);
}

// 637850000000000000 x 100 ns after year 1 is in 2022, 132812345678901234 after 1601 in 2021.
TEST(TimeRole, KnowsTheTicksOfWindows) {
  const auto ticks = [](long long first) {
    return time_of("time(100ns),x", [first](int i) { return std::to_string(first + 83333 * i) + ",1"; })
        .time.unit;
  };
  EXPECT_EQ(ticks(637850000000000000), TimeUnit::dotnet_ticks);
  EXPECT_EQ(ticks(132812345678901234), TimeUnit::filetime);
}

TEST(TimeRole, PutsSecondsAndNanosecondsTogether) {
  const TimeRole role = time_of("stamp.sec,stamp.nanosec,x", [](int i) {
    return std::to_string(1700000000 + i / 20) + "," + std::to_string(50000000 * (i % 20)) + ",1";
  });
  EXPECT_EQ(role.time.kind, TimeColumns::Kind::seconds_nanoseconds);
  EXPECT_NEAR(role.step_s, 0.05, 1e-6);
}

TEST(TimeRole, ReadsDates) {
  const TimeRole role =
      time_of("When,x", [](int i) { return "2016-12-13 21:21:13." + std::to_string(100 + 11 * i) + ",1"; });
  EXPECT_EQ(role.time.kind, TimeColumns::Kind::date);
  EXPECT_EQ(role.time.column.name, "When");
}

TEST(TimeRole, BelievesTheFirstColumnWhateverItIsCalled) {
  const TimeRole role = time_of("Zeit,x", [](int i) { return std::to_string(5000 + 11 * i) + ",1"; });
  EXPECT_EQ(role.time.unit, TimeUnit::ms);
  EXPECT_EQ(role.time.column.name, "Zeit");
}

TEST(TimeRole, TakesNoNumberOfTheRowForATime) {
  const TimeRole role = time_of("frame,x", [](int i) { return std::to_string(i) + ",1"; });
  EXPECT_EQ(role.time.kind, TimeColumns::Kind::rate);
  ASSERT_EQ(role.questions.size(), 1u);
  EXPECT_TRUE(holds(role.questions[0], "How many rows a second")) << role.questions[0];
}

TEST(TimeRole, SaysThatAllStampsAreEqual) {
  const TimeRole role = time_of("t,x", [](int i) { return "1.627531E+09," + std::to_string(i % 3); });
  ASSERT_EQ(role.questions.size(), 1u);
  EXPECT_TRUE(holds(role.questions[0], "all stamps of 't' are equal")) << role.questions[0];
}

// 11 ms a row, called microseconds: 90909 Hz.
TEST(TimeRole, AsksWhenNameAndRateContradictEachOther) {
  const TimeRole role = time_of("time_us,x", [](int i) { return std::to_string(11 * i) + ",1"; });
  ASSERT_EQ(role.questions.size(), 1u);
  EXPECT_TRUE(holds(role.questions[0], "'time_us' is in microseconds")) << role.questions[0];
}

}  // namespace
}  // namespace herr
