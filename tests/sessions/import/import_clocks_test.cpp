// Stamps that rows do not carry whole: counted with a rate, or times of day without a day.
#include <gtest/gtest.h>

#include <string>

#include "tests/sessions/import/plain_import.h"

namespace herr::test {
namespace {

class ImportClocks : public PlainImport {
 protected:
  void use_time(const std::string& time) {
    for (TimeColumns* columns : {&map_.head.front().time, &map_.gaze.front().time})
      *columns =
          parse_column_map(R"({"format_version": 1, "name": "t", "note": "", "head": [{"time": )" + time +
                               R"(, "position": {"columns": ["x", "y", "z"], "unit": "m"},
      "orientation": {"fixed": true}, "world_axes": ["right", "up", "back"],
      "head_axes": ["right", "up", "back"]}]})",
                           "time.json")
              .head.front()
              .time;
  }
};

std::string row(const std::string& t, int x) {
  return t + "," + std::to_string(x) + ",1.6,0,0,0,0,1\n";
}

// Four rows of 10 Hz lie at 0, 100, 200 and 300 ms, whichever of them cannot be read.
TEST_F(ImportClocks, CountBadRowsToo) {
  use_time(R"({"rate_hz": 10})");
  for (const std::string bad : {"9,1\n", "9,lost,1.6,0,0,0,0,1\n"}) {
    const Imported got = import(kHead + row("9", 0) + bad + row("9", 2) + row("9", 3), "",
                                [](ImportRequest& request) { request.keep_going = true; });
    ASSERT_EQ(got.poses.size(), 3u) << bad;
    EXPECT_EQ(got.poses[1].stamp_ns, 200'000'000) << bad;
    EXPECT_EQ(got.poses[2].stamp_ns, 300'000'000) << bad;
    EXPECT_EQ(got.report.poses.last_ns, 300'000'000);
  }
}

constexpr const char* kTimeOfDay = R"({"column": "t", "date": "%H:%M:%S.%f"})";
constexpr TimeNs kDayNs = 86'400'000'000'000, kMs = 1'000'000;

TEST_F(ImportClocks, CarryTimesOfDayOverMidnight) {
  use_time(kTimeOfDay);
  // A row of the day before comes late, and a wild one lies in the morning.
  const Imported got =
      import(kHead + row("23:59:59.900", 0) + row("23:59:59.950", 1) + row("00:00:00.000", 2) +
             row("23:59:59.980", 3) + row("00:00:00.050", 4) + row("00:00:00.100", 5));
  ASSERT_EQ(got.poses.size(), 5u);
  EXPECT_EQ(fates(got.report.poses), "backward_stamp 1@5");
  EXPECT_EQ(got.poses[0].stamp_ns, kDayNs - 100 * kMs);
  EXPECT_EQ(got.poses[2].stamp_ns, kDayNs);
  EXPECT_EQ(got.poses[4].stamp_ns, kDayNs + 100 * kMs);
  EXPECT_EQ(all(got.report.assumed),
            "stamps name no day: from line 4 on, where they start again, they are those of the next");
}

// 13:00 is more than half a day before 01:00 of the next day, and the next row is again at 13:00.
TEST_F(ImportClocks, LeaveOneWildTimeOfDayOut) {
  use_time(kTimeOfDay);
  std::string text = kHead;
  for (int i = 0; i < 10; ++i) text += row("13:00:00." + std::to_string(i), i);
  text += row("00:00:00.0", 10);
  for (int i = 0; i < 10; ++i) text += row("13:00:01." + std::to_string(i), 11 + i);
  const Imported got = import(text);
  EXPECT_EQ(got.poses.size(), 20u);
  EXPECT_EQ(fates(got.report.poses), "wild_stamp 1@12");
  EXPECT_EQ(got.poses.back().stamp_ns, (13 * 3600 * 1000 + 1900) * kMs);
  EXPECT_EQ(all(got.report.assumed), "");
}

TEST_F(ImportClocks, PutTwoFilesOnOneDay) {
  use_time(kTimeOfDay);
  const std::string head = kHead + row("23:59:59.990", 0) + row("00:00:00.010", 1) + row("00:00:00.030", 2);
  const Imported got = import(head, kGaze + "00:00:00.000,0,0,-1\n00:00:00.020,0,0,-1\n");
  ASSERT_EQ(got.gaze.size(), 2u);
  EXPECT_EQ(got.gaze[0].stamp_ns, kDayNs);
  EXPECT_EQ(got.poses[1].stamp_ns, kDayNs + 10 * kMs);
  EXPECT_TRUE(holds(all(got.report.assumed), "stamps name no day: the gaze begins in the next one"));
}

// Without hours they start again every hour.
TEST_F(ImportClocks, CarryMinutesOverTheHour) {
  use_time(R"({"column": "t", "date": "%M:%S.%f"})");
  const Imported got = import(kHead + row("59:59.950", 0) + row("00:00.000", 1) + row("00:00.050", 2));
  ASSERT_EQ(got.poses.size(), 3u);
  EXPECT_EQ(got.poses[1].stamp_ns - got.poses[0].stamp_ns, 50 * kMs);
  EXPECT_TRUE(holds(all(got.report.assumed), "stamps name no hour: from line 3 on"));
}

}  // namespace
}  // namespace herr::test
