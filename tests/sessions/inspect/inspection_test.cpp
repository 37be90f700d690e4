// What inspect finds in sessions with known faults.
#include "sessions/inspect/session_inspection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/session.h"
#include "tests/sessions/inspect/inspected_folder.h"

namespace herr {
namespace {

using test::finding_with;
using test::inspected;
using test::RecordedFolder;
using test::write_camera_session;
constexpr TimeNs kMs = 1'000'000;

TEST(Inspection, FindsNothingWrongInAGoodSession) {
  const RecordedFolder folder;
  write_camera_session(folder);
  const SessionInspection got = inspected(folder, true, true);
  ASSERT_EQ(got.findings.sorted().size(), 1u);
  EXPECT_EQ(finding_with(got, "100.0 % of the rows say the same").severity, Severity::note);  // gaze ahead
  EXPECT_EQ(got.poses.rows, 10);
  EXPECT_DOUBLE_EQ(got.poses.median_hz(), 100);
  EXPECT_DOUBLE_EQ(got.poses.mean_hz(), 100);
  EXPECT_NEAR(got.poses.intervals.jitter_ns(), 0, 1);
  EXPECT_EQ(got.decoded_pictures, 3);
  ASSERT_TRUE(got.span);
  EXPECT_EQ(got.span->end_ns, 90 * kMs);
  // 0.01 m each 10 ms is 1 m/s, over windows of 20 ms; the last row is no whole window.
  EXPECT_NEAR(got.head.move_m_s().max(), 1, 1e-9);
  EXPECT_NEAR(got.head.path_m(), 0.08, 1e-12);
}

TEST(Inspection, GoesOnAfterBadRowsAndCountsAlikeOnesTogether) {
  const RecordedFolder folder;
  test::write_good_session(folder);
  std::string rows = test::kPoseHeader;
  for (int i = 0; i < 100; ++i) {
    rows += test::pose_row(i * 10 * kMs, 0.01 * i);
    if (i % 10 == 9) rows += test::pose_row(i * 10 * kMs, 0);  // ten stamps that repeat
    if (i == 50) rows += "x,0,0,0,0,0,0,1\n";
  }
  folder.write("pose/data.csv", rows);
  folder.write("gaze/data.csv", "nothing\n");
  const SessionInspection got = inspected(folder);
  EXPECT_EQ(got.poses.rows, 100);
  // Line 1 is the header, the tenth row on line 11, the first repeat behind it; the last repeat is the last
  // of 1 + 100 + 10 + 1 lines.
  const Finding repeats = finding_with(got, "repeats the one before");
  EXPECT_EQ(repeats.count, 10);
  EXPECT_EQ(repeats.first.line(), 12);
  EXPECT_EQ(repeats.rest(), "and 9 more, the last at line 112");
  EXPECT_EQ(finding_with(got, "not a whole number").first.line(), 58);  // behind 51 rows and five repeats
  EXPECT_EQ(finding_with(got, "has no column timestamp_ns").first.line(), 1);
  EXPECT_EQ(got.findings.count(Severity::error), 12);
  EXPECT_EQ(got.findings.skippable_errors(), 11);
}

TEST(Inspection, NamesTheLongestGapFirst) {
  const RecordedFolder folder;
  test::write_good_session(folder);
  std::string rows = test::kPoseHeader;
  TimeNs stamp_ns = 0;
  for (int i = 0; i < 100; ++i) {
    stamp_ns += (i == 20 ? 60 : i == 40 ? 300 : i == 60 ? 30 : 10) * kMs;
    rows += test::pose_row(stamp_ns, 0.01 * i);
  }
  folder.write("pose/data.csv", rows);
  const SessionInspection got = inspected(folder);
  const Finding gap = finding_with(got, "a gap of 300.0 ms (30.0 intervals of 10.0 ms) ends here");
  EXPECT_EQ(gap.severity, Severity::warning);
  EXPECT_EQ(gap.first.line(), 42);  // row 40 of rows that start on line 2
  EXPECT_EQ(gap.count, 3);
  // Since the first stamp: 19 steps of 10 ms and one of 60 are 250 ms; 57 steps, 60, 300 and 30 are 960.
  EXPECT_EQ(gap.rest(), "and 2 more: 60.0 ms at line 22 (0.25 s), 30.0 ms at line 62 (0.96 s)");
}

TEST(Inspection, TellsGapsOnceWhereGazeIsLoggedWithEachPose) {
  const RecordedFolder folder;
  test::write_good_session(folder);
  std::string poses = test::kPoseHeader, gaze = test::kGazeHeader;
  for (int i = 0; i < 50; ++i) {
    const TimeNs stamp_ns = (i < 25 ? i : i + 10) * 10 * kMs;
    poses += test::pose_row(stamp_ns, 0.01 * i);
    gaze += test::gaze_row(stamp_ns, 0.1 * i, true, 0, true);
  }
  folder.write("pose/data.csv", poses);
  folder.write("gaze/data.csv", gaze);
  const SessionInspection got = inspected(folder);
  int gaps = 0;
  for (const Finding& finding : got.findings.sorted())
    gaps += test::holds(finding.first.problem(), "a gap of 110.0 ms") ? 1 : 0;
  EXPECT_EQ(gaps, 1);
}

TEST(Inspection, TellsBlinksFromLossesAndCountsEachEye) {
  const RecordedFolder folder;
  test::write_good_session(folder);
  std::string poses = test::kPoseHeader, gaze = test::kGazeHeader;
  for (int i = 0; i < 400; ++i) {
    poses += test::pose_row(i * 10 * kMs, 0.01 * i);
    const bool blink = i >= 50 && i < 65;   // 150 ms
    const bool loss = i >= 100 && i < 161;  // 610 ms: beyond the hold of 600
    const bool left_only = i >= 200 && i < 300;
    gaze +=
        test::gaze_row(i * 10 * kMs, 10, !blink && !loss, i == 350 ? 70 : 10, !blink && !loss && !left_only);
  }
  folder.write("pose/data.csv", poses);
  folder.write("gaze/data.csv", gaze);
  const SessionInspection got = inspected(folder);
  EXPECT_EQ(got.eyes.blinks(), 1);
  EXPECT_EQ(got.eyes.losses(), 1);
  EXPECT_EQ(got.eyes.longest_loss_ns(), 610 * kMs);
  EXPECT_EQ(got.eyes.longest_loss_line(), 102);
  EXPECT_EQ(got.eyes.lost_rows(), 15 + 61);
  EXPECT_EQ(got.eyes.either_lost_rows(), 15 + 61 + 100 + 1);
  EXPECT_EQ(got.eyes.lost_rows_of(1), 15 + 61 + 100 + 1);  // 70 degrees is more than an eye can
  EXPECT_EQ(got.eyes.off_axis_rows(), 1);
  EXPECT_NEAR(got.eyes.eccentricity_deg().max(), 10, 1e-9);
  // 76 of 400.
  EXPECT_EQ(finding_with(got, "19.0 % of the rows have no gaze (1 blink, 1 loss").severity,
            Severity::warning);
  EXPECT_EQ(finding_with(got, "the right eye alone is lost in 25.2 %").severity, Severity::warning);
  EXPECT_EQ(finding_with(got, "more than 60 degrees").first.line(), 352);
}

// The ages that replay writes into frames.csv are those of Session::sample at the frames' times.
TEST(Inspection, TellsTheAgesThatReplayWillSee) {
  const RecordedFolder folder;
  write_camera_session(folder);
  std::string poses = test::kPoseHeader, gaze = test::kGazeHeader;
  for (int i = 0; i < 600; ++i) {
    poses += test::pose_row(i * 11 * kMs + i % 3 * kMs, 0.001 * i);
    // Late to start, a blink, a loss of 3 s that is let go after 2.1 s.
    const bool seen = i > 30 && (i < 60 || i > 75) && (i < 200 || i > 500);
    gaze += test::gaze_row(i * 10 * kMs + 3, 0.01 * i, seen, 0, false);
  }
  folder.write("pose/data.csv", poses);
  folder.write("gaze/data.csv", gaze);
  folder.write("cam0/data.csv", test::kCameraHeader + "700000000,a.png\n740000000,b.png\n2180000000,c.png\n");
  for (const std::string& span :
       {std::string(), std::string("\"start_ns\": 500000001, \"end_ns\": 5123456789")}) {
    folder.write("session.json",
                 test::header_json(test::cameras_json(1, 6, 4) + (span.empty() ? "" : ", " + span)));
    const SessionInspection got = inspect_session({folder.path(), false, false, 72});
    Session session = Session::open(folder.path());
    std::array<std::vector<TimeNs>, 3> ages;
    std::int64_t frames = 0;
    for (;; ++frames) {
      const TimeNs t_ns = session.start_ns() + std::llround(static_cast<double>(frames) * (1e9 / 72));
      if (t_ns > session.end_ns()) break;
      const FrameSample frame = session.sample(t_ns);
      ages[0].push_back(frame.head.age_ns);
      if (frame.gaze.age_ns >= 0) ages[1].push_back(frame.gaze.age_ns);
      if (frame.cameras[0]) ages[2].push_back(frame.cameras[0]->age_ns);
    }
    const std::array<const StreamSummary*, 3> streams{&got.poses, &*got.gaze, &*got.cameras[0]};
    for (std::size_t i = 0; i < 3; ++i) {
      SCOPED_TRACE(streams[i]->name + span);
      std::sort(ages[i].begin(), ages[i].end());
      const FrameAges& told = *streams[i]->ages;
      EXPECT_EQ(told.frames(), frames);
      EXPECT_EQ(told.frames_without(), frames - static_cast<std::int64_t>(ages[i].size()));
      EXPECT_EQ(told.ages().widest_ns(), ages[i].back());
      const auto median = static_cast<double>(ages[i][(ages[i].size() + 1) / 2 - 1]);
      EXPECT_NEAR(told.ages().quantile_ns(0.5), median, 0.01 * median);
    }
  }
}

TEST(Inspection, DoesNotCountFramesOneByOneThroughAPauseOfDecades) {
  const RecordedFolder folder;
  test::write_good_session(folder);
  // Most neighbours are 10 ms apart, so the stamps are plausible; the last lies 100 years later.
  const TimeNs late_ns = 3'155'760'000LL * 1'000'000'000;
  std::string rows = test::kPoseHeader;
  for (int i = 0; i < 10; ++i) rows += test::pose_row(i * 10 * kMs, 0.01 * i);
  folder.write("pose/data.csv", rows + test::pose_row(late_ns, 1));
  const auto start = std::chrono::steady_clock::now();
  const SessionInspection got = inspected(folder);
  // One by one, 1.9e11 frames take hours.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  const double frames = static_cast<double>(late_ns) * 60e-9;
  EXPECT_NEAR(static_cast<double>(got.poses.ages->frames()), frames, 2);
}

TEST(Inspection, MeasuresTheTurnOfTheHeadAndItsJumps) {
  const RecordedFolder folder;
  test::write_good_session(folder);
  std::string rows = test::kPoseHeader;
  for (int i = 0; i < 200; ++i) {
    const double half = glm::radians(0.9 * i) / 2;  // 0.9 degrees each 10 ms: 90 degrees a second
    rows += std::to_string(i * 10 * kMs) + "," + (i >= 100 ? "2" : "0") + ",0,0,0," +
            std::to_string(std::sin(half)) + ",0," + std::to_string(std::cos(half)) + "\n";
  }
  folder.write("pose/data.csv", rows);
  const SessionInspection got = inspected(folder);
  // Six decimals of the quaternion are 1e-6 rad of half an angle: 0.01 degrees a second over 20 ms; the
  // histogram has steps of 1.
  EXPECT_NEAR(got.head.turn_deg_s().quantile(0.5), 90, 0.6);
  EXPECT_NEAR(got.head.turn_deg_s().max(), 90, 0.02);
  // 2 m between rows 99 and 100, whose window of 20 ms ends with row 100 on line 102.
  EXPECT_EQ(finding_with(got, "the head jumps here, at 90 degrees and 100 m a second").first.line(), 102);
}

TEST(Inspection, SaysWhereTheRateIsNotTheStatedOne) {
  const RecordedFolder folder;
  test::write_good_session(folder);
  folder.write("session.json", test::header_json(R"("rates_hz": {"pose": 90, "gaze": 101})"));
  const SessionInspection got = inspected(folder);
  EXPECT_EQ(finding_with(got, "runs at 100.00 Hz where session.json says 90.00 Hz").severity,
            Severity::warning);
  for (const Finding& finding : got.findings.sorted())
    EXPECT_FALSE(test::holds(finding.first.problem(), "says 101.00 Hz")) << "one percent is tolerated";
}

TEST(Inspection, FindsDamagedPixelsWhenItDecodes) {
  const RecordedFolder folder;
  write_camera_session(folder);
  folder.write_image("cam0/data/b.png", 6, 4);
  std::filesystem::resize_file(folder / "cam0/data/b.png",
                               std::filesystem::file_size(folder / "cam0/data/b.png") - 20);
  const SessionInspection got = inspected(folder, false, true);
  ASSERT_NE(got.findings.first_error(), nullptr);
  EXPECT_PRED2(test::holds, got.findings.first_error()->text(), "cam0/data.csv:3: image 'b.png' ");
  EXPECT_EQ(got.decoded_pictures, 2);
}

TEST(Inspection, StillReadsTheStreamsWhereTheHeaderIsBad) {
  const RecordedFolder folder;
  test::write_good_session(folder);
  folder.write("session.json", "{}");
  folder.write("pose/data.csv", test::kPoseHeader + test::pose_row(0, 0) + "1,2\n" + test::pose_row(kMs, 0));
  const SessionInspection got = inspected(folder);
  EXPECT_FALSE(got.header);
  EXPECT_EQ(got.poses.rows, 2);
  EXPECT_EQ(got.gaze->rows, 10);
  EXPECT_EQ(got.findings.count(Severity::error), 2);
}

}  // namespace
}  // namespace herr
