// The table of average frame times, for people and for machines, and which frames `herr bench` takes.
#include "server/bench/frame_time_table.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "renderer/settings_presets.h"
#include "server/bench/session_sequence.h"

namespace herr {
namespace {

std::vector<FrameTimeRow> two_rows() {
  std::vector<FrameTimeRow> rows = empty_table(RenderSettings(), false);
  rows[0].cells[0] = {60, 160.0, 128.0, 20.0, 240.0, 1000};
  rows[0].memory_bytes[0] = 512'300'000;
  rows[1].cells[2] = {4, 3000.0, 2000.0, 0.0, {}, 1000};
  return rows;
}

TEST(FrameTimeTable, HasThePapersTwoSizesOrTheOneAskedFor) {
  // Table 1: both eyes together 1576 x 768 and 2048 x 1024.
  const std::vector<FrameTimeRow> both = empty_table(RenderSettings(), false);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(2 * both[0].polar_width, 1576);
  EXPECT_EQ(both[0].polar_height, 768);
  EXPECT_EQ(2 * both[1].polar_width, 2048);
  EXPECT_EQ(both[1].polar_height, 1024);
  RenderSettings small;
  small.polar_width = 100, small.polar_height = 90;
  const std::vector<FrameTimeRow> one = empty_table(small, true);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].polar_width, 100);
  EXPECT_EQ(one[0].polar_height, 90);
}

TEST(FrameTimeTable, StatesEachCellWithItsRatio) {
  const nlohmann::ordered_json json = frame_times_json(two_rows(), BenchSubject(), 10);
  ASSERT_EQ(json["table"].size(), 6u);
  EXPECT_EQ(json["table"][0]["polar"], "1576x768");
  EXPECT_EQ(json["table"][0]["light_samples"], 1);
  EXPECT_EQ(json["table"][0]["frame_ms"], 160.0);
  EXPECT_EQ(json["table"][0]["ratio"], 1.25);  // 160 / 128
  EXPECT_EQ(json["table"][5]["polar"], "2048x1024");
  EXPECT_EQ(json["table"][5]["light_samples"], 256);
  EXPECT_EQ(json["table"][5]["ratio"], 1.5);  // 3000 / 2000
  EXPECT_EQ(json["seconds"], 10);
  BenchSubject direct;
  direct.settings = direct_light_settings();
  const std::string text = frame_times_table(two_rows(), direct, 10);
  EXPECT_NE(text.find("1576x768"), std::string::npos) << text;
  EXPECT_NE(text.find("160.0 (1.25)"), std::string::npos) << text;
  EXPECT_NE(text.find("3000.0 (1.50)"), std::string::npos) << text;
  EXPECT_EQ(text.find("probe update"), std::string::npos) << text;
  const BenchSubject with_probes;
  EXPECT_NE(frame_times_table(two_rows(), with_probes, 10).find("probe update"), std::string::npos);
}

TEST(FrameTimeTable, StatesTheLoadOfEachCell) {
  BenchSubject subject;
  subject.load = {2, 790'000'000};
  const nlohmann::ordered_json json = frame_times_json(two_rows(), subject, 10);
  EXPECT_EQ(json["table"][0]["cpu_ms"], 240.0);
  EXPECT_EQ(json["table"][0]["cpu_share"], 0.75);  // 240 / (160 * 2)
  EXPECT_EQ(json["table"][0]["memory_bytes"], 512'300'000);
  EXPECT_TRUE(json["table"][5]["cpu_ms"].is_null());
  EXPECT_TRUE(json["table"][5]["cpu_share"].is_null());
  EXPECT_EQ(json["peak_resident_bytes"], 790'000'000);
  EXPECT_EQ(json["cores"], 2);
  const std::string text = frame_times_table(two_rows(), subject, 10);
  EXPECT_NE(text.find("240.0 (75.0 %)"), std::string::npos) << text;
  EXPECT_NE(text.find("512.3"), std::string::npos) << text;
  EXPECT_NE(text.find("n/a"), std::string::npos) << text;
  EXPECT_NE(text.find("at most 790.0 MB resident"), std::string::npos) << text;
}

TEST(SpreadFrames, AreTheMiddlesOfEqualPartsAndEachOnce) {
  FrameRange range;
  range.first = 100, range.count = 8;
  EXPECT_EQ(spread_frames(range, 1), (std::vector<std::int64_t>{104}));
  EXPECT_EQ(spread_frames(range, 2), (std::vector<std::int64_t>{102, 106}));
  EXPECT_EQ(spread_frames(range, 3), (std::vector<std::int64_t>{101, 104, 106}));  // 8/6, 24/6, 40/6
  // As many as there are: all of them, in order.
  for (const int count : {8, 9, 1000}) {
    const std::vector<std::int64_t> all = spread_frames(range, count);
    ASSERT_EQ(all.size(), 8u);
    for (std::int64_t i = 0; i < 8; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)], 100 + i);
  }
}

}  // namespace
}  // namespace herr
