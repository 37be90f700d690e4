// Small recordings of every kind of disorder, each through a plain map, against what its rows say.
#include "sessions/import/import_rows.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "tests/sessions/import/plain_import.h"

namespace herr::test {
namespace {

using ImportRows = PlainImport;

TEST_F(ImportRows, CarriesGoodRowsOver) {
  const Imported got = import(kHead + poses(90), kGaze + gaze(1) + gaze(1.01, "0.6,0,-0.8"));
  ASSERT_EQ(got.poses.size(), 90u);
  EXPECT_EQ(got.poses[1].stamp_ns, 1'011'111'000) << "1 + 1 / 90 s with six decimals";
  EXPECT_EQ(got.poses[1].world_from_head.position, glm::dvec3(0.001, 1.6, 0));
  ASSERT_EQ(got.gaze.size(), 2u);
  EXPECT_EQ(got.gaze[1].head_direction[0], glm::dvec3(0.6, 0, -0.8));
  EXPECT_TRUE(got.gaze[1].valid[0] && got.gaze[1].valid[1]);
  EXPECT_TRUE(got.report.has_gaze && got.report.gaze_combined);
  EXPECT_EQ(got.report.poses.rows_read, 90);
  EXPECT_EQ(got.report.poses.rows, 90);
  EXPECT_EQ(got.report.poses.first_ns, 1'000'000'000);
  EXPECT_EQ(got.report.poses.last_ns, got.poses.back().stamp_ns);
  EXPECT_NEAR(got.report.poses.rate_hz(), 90, 0.9) << "intervals are known within 1 %";
  EXPECT_EQ(
      fates(got.report.poses) + all(got.report.remarks) + all(got.report.warnings) + all(got.report.assumed),
      "");
  EXPECT_EQ(got.report.poses.lost_share(), 0);
}

TEST_F(ImportRows, TellsOfAClockThatWasReset) {
  const Imported got = import(kHead + poses(60, 0.5) + poses(60, 0.5));
  EXPECT_EQ(got.poses.size(), 60u);
  EXPECT_EQ(fates(got.report.poses), "other_clock 60@62");
  EXPECT_EQ(all(got.report.poses.remarks),
            "60 of 120 rows lie before the newest stamp: the clock was reset at line 62");
  EXPECT_EQ(all(got.report.warnings), "") << "one remark, not 60 warnings";
  EXPECT_EQ(got.report.poses.lost_share(), 0.5);
  EXPECT_EQ(got.poses.back().world_from_head.position.x, 0.059) << "the first recording";
}

// The eleventh of 90 rows, in line 12, lies 2147483 s ahead.
TEST_F(ImportRows, LeaveOneWildStampOut) {
  const Imported got = import(kHead + poses(10) + pose(2147483.647) + poses(79, 1.122222));
  EXPECT_EQ(got.poses.size(), 89u);
  EXPECT_EQ(fates(got.report.poses), "wild_stamp 1@12");
  EXPECT_EQ(all(got.report.warnings), "") << "its count names the line";
  EXPECT_NEAR(got.report.poses.lost_share(), 1.0 / 90, 1e-12);
}

TEST_F(ImportRows, RefusesStampsThatAreAllEqual) {
  std::string head = kHead;
  for (int i = 0; i < 60; ++i) head += "1.627531E+09,0,1.6,0,0,0,0,1\n";
  EXPECT_INPUT_ERROR(import(head), "head.csv: all 60 stamps are equal: written in single precision?");
}

// Every thirtieth row changes places with the next: the second of the two comes too late, 8 of 240.
std::string gaze_out_of_order() {
  std::vector<double> stamps;
  for (int i = 0; i < 240; ++i) stamps.push_back(1 + i / 120.0);
  for (std::size_t i = 10; i < 240; i += 30) std::swap(stamps[i], stamps[i + 1]);
  std::string text = kGaze;
  for (const double t : stamps) text += gaze(t);
  return text;
}

TEST_F(ImportRows, LeavesLateRowsOutOrSortsThem) {
  const Imported left_out = import(kHead + poses(180), gaze_out_of_order());
  EXPECT_EQ(left_out.gaze.size(), 232u);
  EXPECT_EQ(fates(left_out.report.gaze), "backward_stamp 8@13") << "rows 11 and 12 are in lines 12 and 13";
  const auto& late = left_out.report.gaze.fates.lines[static_cast<std::size_t>(RowFate::backward_stamp)];
  EXPECT_EQ(late[0], 13);
  EXPECT_GT(late[7], late[6]) << "each of the eight is named";
  const Imported sorted =
      import(kHead + poses(180), gaze_out_of_order(), [](ImportRequest& request) { request.sort_rows = 4; });
  ASSERT_EQ(sorted.gaze.size(), 240u);
  EXPECT_EQ(sorted.report.gaze.sorted_rows, 8);
  EXPECT_EQ(fates(sorted.report.gaze), "");
  for (std::size_t i = 1; i < 240; ++i) ASSERT_GT(sorted.gaze[i].stamp_ns, sorted.gaze[i - 1].stamp_ns);
}

// A row 3 rows late fits into a window of 3 rows and not into one of 2.
TEST_F(ImportRows, SortsWithinTheWindowOnly) {
  const std::string head = kHead + pose(1.00) + pose(1.02) + pose(1.03) + pose(1.04) + pose(1.01, 7) +
                           pose(1.05) + pose(1.06) + pose(1.07);
  const Imported wide = import(head, "", [](ImportRequest& request) { request.sort_rows = 3; });
  ASSERT_EQ(wide.poses.size(), 8u);
  EXPECT_EQ(wide.poses[1].world_from_head.position.x, 7);
  EXPECT_EQ(wide.report.poses.sorted_rows, 1);
  const Imported narrow = import(head, "", [](ImportRequest& request) { request.sort_rows = 2; });
  EXPECT_EQ(narrow.poses.size(), 7u);
  EXPECT_EQ(fates(narrow.report.poses), "backward_stamp 1@6");
}

TEST_F(ImportRows, KeepsTheFirstOfEqualStamps) {
  for (const std::size_t sort_rows : {0u, 4u}) {
    const Imported got = import(kHead + pose(1) + pose(1.01, 5) + pose(1.01, 6) + pose(1.02), "",
                                [&](ImportRequest& request) { request.sort_rows = sort_rows; });
    ASSERT_EQ(got.poses.size(), 3u);
    EXPECT_EQ(got.poses[1].world_from_head.position.x, 5);
    EXPECT_EQ(fates(got.report.poses), "repeated_stamp 1@4");
  }
}

// The recording begins 0.3 s before its zero: 1 s is the least whole number of seconds that makes all stamps
// 0 or more. The gaze moves with the head.
TEST_F(ImportRows, MovesNegativeStampsByWholeSeconds) {
  const Imported got = import(kHead + poses(60, -0.3), kGaze + gaze(-0.25) + gaze(0.5));
  ASSERT_EQ(got.poses.size(), 60u);
  EXPECT_EQ(got.poses[0].stamp_ns, 700'000'000);
  EXPECT_EQ(got.poses[1].stamp_ns, 711'111'000);
  EXPECT_EQ(got.gaze[0].stamp_ns, 750'000'000);
  EXPECT_EQ(got.report.shift_ns, 1'000'000'000);
  EXPECT_EQ(got.report.poses.first_ns, 700'000'000);
  EXPECT_EQ(all(got.report.assumed), "stamps are negative: 1 s was added to every stamp");
  const Imported gaze_first = import(kHead + poses(60, 0), kGaze + gaze(-2.0) + gaze(0.5));
  EXPECT_EQ(gaze_first.report.shift_ns, 2'000'000'000);
  EXPECT_EQ(gaze_first.poses[0].stamp_ns, 2'000'000'000);
  EXPECT_EQ(gaze_first.gaze[0].stamp_ns, 0);
}

// A wild stamp below zero moves nothing.
TEST_F(ImportRows, MovesNothingForARowThatIsLeftOut) {
  const Imported got = import(kHead + poses(20, 100) + pose(-5000) + poses(40, 100.3));
  EXPECT_EQ(got.report.shift_ns, 0);
  EXPECT_EQ(fates(got.report.poses), "wild_stamp 1@22");
}

// 40 pairs 0.091 ms apart, 33.333333 ms from pair to pair.
TEST_F(ImportRows, KeepsOnePoseOfEachPairOfCameras) {
  std::string head = kHead;
  for (long long i = 0; i < 40; ++i)
    for (const long long ns : {i * 33333333, i * 33333333 + 91000})
      head += std::to_string(60000 + ns / 1000000000) + "." +
              std::to_string(1000000000 + ns % 1000000000).substr(1) + ",0,1.6,0,0,0,0,1\n";
  const Imported got = import(head);
  ASSERT_EQ(got.poses.size(), 40u);
  EXPECT_EQ(got.poses[1].stamp_ns, 60'000'033'333'333);
  EXPECT_EQ(fates(got.report.poses), "thinned 40@3");
  EXPECT_EQ(got.report.poses.lost_share(), 0);
  EXPECT_NEAR(got.report.poses.rate_hz(), 30, 0.3);
  EXPECT_EQ(all(got.report.poses.remarks),
            "poses at the stamps of 2 cameras in one table: of stamps 0.091 ms apart the first was kept");
}

TEST_F(ImportRows, CountsRowsWithoutNumbersAsLostTracking) {
  const Imported got =
      import(kHead + poses(10) + "1.111111,nan,nan,nan,nan,nan,nan,nan\n" + poses(10, 1.122222));
  EXPECT_EQ(got.poses.size(), 20u);
  EXPECT_EQ(fates(got.report.poses), "lost_tracking 1@12");
  EXPECT_NEAR(got.report.poses.lost_share(), 1.0 / 21, 1e-12);
}

TEST_F(ImportRows, NamesTheOptionsForRowsThatAreBadOrLate) {
  EXPECT_INPUT_ERROR(import(kHead + poses(10) + "1.111111,abc,1.6,0,0,0,0,1\n" + poses(10, 1.122222)),
                     "--keep-going");
  const std::string all_bad =
      error_of([&] { import(kHead + "1.1,abc,1.6,0,0,0,0,1\n1.2,abc,1.6,0,0,0,0,1\n"); });
  EXPECT_FALSE(holds(all_bad, "--keep-going")) << all_bad << ": the columns are wrong, not a row";
  const Imported late = import(kHead + poses(10) + pose(1.095) + poses(10, 1.111111));
  EXPECT_EQ(fates(late.report.poses), "backward_stamp 1@12");
  EXPECT_TRUE(holds(std::string(row_fate_texts()[static_cast<std::size_t>(RowFate::backward_stamp)].sentence),
                    "--sort"));
}

TEST_F(ImportRows, ThrowsOrCountsBadRows) {
  const std::string head = kHead + poses(10) + "1.111111,abc,1.6,0,0,0,0,1\n" + "oops,0,1.6,0,0,0,0,1\n" +
                           "1.133333,0,1.6\n" + poses(10, 1.144444);
  EXPECT_INPUT_ERROR(import(head), "head.csv:12: ");
  const Imported got = import(head, "", [](ImportRequest& request) { request.keep_going = true; });
  EXPECT_EQ(got.poses.size(), 20u);
  EXPECT_EQ(fates(got.report.poses), "bad 3@12");
  EXPECT_EQ(got.report.poses.rows_read, 23);
  EXPECT_EQ(got.report.warnings.size(), 3u);
  EXPECT_NEAR(got.report.poses.lost_share(), 3.0 / 23, 1e-12);
}

TEST_F(ImportRows, WarnsAHundredTimesAtMost) {
  std::string head = kHead + poses(300);
  for (int i = 0; i < 150; ++i) head += pose(4.4 + i * 0.01) + "oops,0,1.6,0,0,0,0,1\n";
  const Imported got = import(head, "", [](ImportRequest& request) { request.keep_going = true; });
  EXPECT_EQ(got.report.poses.fates[RowFate::bad], 150);
  ASSERT_EQ(got.report.warnings.size(), 100u);
  EXPECT_EQ(got.report.warnings.back(), "further warnings are only counted");
}

TEST_F(ImportRows, RefusesAStreamWithoutRows) {
  EXPECT_INPUT_ERROR(import(kHead), "head.csv: holds a header line and no rows");
  EXPECT_INPUT_ERROR(import(kHead + poses(3), kGaze), "gaze.csv: holds a header line and no rows");
  EXPECT_INPUT_ERROR(import(kHead + "1,nan,nan,nan,nan,nan,nan,nan\n2,nan,nan,nan,nan,nan,nan,nan\n"),
                     "tracking was lost in all 2 rows");
  EXPECT_INPUT_ERROR(import(kHead + "a,0,0,0,0,0,0,1\nb,0,0,0,0,0,0,1\n", "",
                            [](ImportRequest& request) { request.keep_going = true; }),
                     "has no usable row among 2");
}

TEST_F(ImportRows, StopsAfterSoManyRows) {
  const Imported got = import(kHead + poses(90), kGaze + gaze(1) + gaze(1.1) + gaze(1.2),
                              [](ImportRequest& request) { request.most_rows = 2; });
  EXPECT_EQ(got.poses.size(), 2u);
  EXPECT_EQ(got.gaze.size(), 2u);
}

TEST_F(ImportRows, LetsTheHeadOrTheGazeStandStill) {
  const Imported head = import("", kGaze + gaze(1, "0.6,0,-0.8") + gaze(1.1),
                               [](ImportRequest& request) { request.still.head = true; });
  ASSERT_EQ(head.poses.size(), 2u);
  EXPECT_EQ(head.poses[1].stamp_ns, 1'100'000'000);
  EXPECT_EQ(head.poses[1].world_from_head.position, glm::dvec3(0));
  EXPECT_EQ(head.poses[1].world_from_head.orientation, glm::dquat(1, 0, 0, 0));
  EXPECT_EQ(head.gaze.size(), 2u);
  EXPECT_EQ(head.report.poses.rows, 2);
  EXPECT_TRUE(holds(all(head.report.assumed), "the head stands still at the origin"));

  const Imported gaze =
      import(kHead + poses(20), "", [](ImportRequest& request) { request.still.gaze = true; });
  ASSERT_EQ(gaze.gaze.size(), 20u);
  EXPECT_EQ(gaze.gaze[3].stamp_ns, gaze.poses[3].stamp_ns);
  EXPECT_EQ(gaze.gaze[3].head_direction[1], glm::dvec3(0, 0, -1));
  EXPECT_TRUE(gaze.gaze[3].valid[0] && gaze.gaze[3].valid[1]);
  EXPECT_TRUE(gaze.report.has_gaze && gaze.report.gaze_combined);
  EXPECT_EQ(gaze.report.poses.rows, 20);
  EXPECT_TRUE(holds(all(gaze.report.assumed), "the gaze looks straight ahead"));
}

TEST_F(ImportRows, SaysThatStampsWereNotRecorded) {
  std::string json = kMap;
  for (const char* word : {"HEAD", "GAZE", "MORE"}) json.replace(json.find(word), 4, "");
  const std::string time = R"({"column": "t", "unit": "s"})";
  json.replace(json.find(time), time.size(), R"({"rate_hz": 50})");
  map_ = parse_column_map(json, "plain.json");
  const Imported got = import(kHead + poses(10));
  ASSERT_EQ(got.poses.size(), 10u);
  EXPECT_EQ(got.poses[3].stamp_ns, 60'000'000) << "3 / 50 s";
  EXPECT_EQ(all(got.report.assumed), "stamps were not recorded: 50 rows a second");
}

// 1481664073 s since 1970 is 2016-12-13 21:21:13 in UTC, and 13:21:13 UTC is 21:21:13 eight hours east.
TEST_F(ImportRows, SaysThatDatesNameNoZone) {
  std::string json = kMap;
  for (const char* word : {"HEAD", "GAZE", "MORE"}) json.replace(json.find(word), 4, "");
  const std::string time = R"({"column": "t", "unit": "s"})";
  json.replace(json.find(time), time.size(), R"({"column": "t", "date": ""})");
  map_ = parse_column_map(json, "plain.json");
  const std::string rest = ",0,1.6,0,0,0,0,1\n";
  const Imported local = import(kHead + "2016-12-13 21:21:13.000" + rest + "2016-12-13 21:21:13.011" + rest);
  EXPECT_EQ(local.poses[1].stamp_ns, 1'481'664'073'011'000'000);
  EXPECT_EQ(all(local.report.assumed), "dates name no zone: they were taken as UTC");
  const Imported zoned = import(kHead + "2016-12-13 21:21:13.000+08:00" + rest);
  EXPECT_EQ(zoned.poses[0].stamp_ns, 1'481'635'273'000'000'000);
  EXPECT_EQ(all(zoned.report.assumed), "");
}

}  // namespace
}  // namespace herr::test
