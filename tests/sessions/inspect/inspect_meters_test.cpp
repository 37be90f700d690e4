// The measuring parts of inspect by themselves, and all of it on real recordings.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/import_rows.h"
#include "sessions/import/presets/choose_format.h"
#include "sessions/inspect/meters/median_pose.h"
#include "sessions/inspect/time_profile.h"
#include "sessions/record/session_recorder.h"
#include "sessions/streams/interval_census.h"
#include "tests/sessions/inspect/inspected_folder.h"

namespace herr {
namespace {

using test::finding_with;
using test::RecordedFolder;
constexpr TimeNs kMs = 1'000'000;

TEST(FindingList, StaysSmallWhateverItIsTold) {
  FindingList findings;
  for (int i = 0; i < 10'000; ++i)
    findings.add(Severity::error, InputError("f", i + 1, "column " + std::string(1 + i % 1000, 'x'), ""));
  EXPECT_LE(findings.sorted().size(), 202u);
  EXPECT_EQ(findings.count(Severity::error), 10'000);
}

TEST(FindingList, TakesNumbersAndQuotedNamesForTheSameKind) {
  FindingList findings;
  findings.add(Severity::error, InputError("f", 1, "image 'a 1.png' has 3 x 4 pixels", ""));
  findings.add(Severity::error, InputError("f", 2, "image 'b' has 30 x 4.5 pixels", ""));
  findings.add(Severity::error, InputError("g", 2, "image 'b' has 30 x 4.5 pixels", ""));
  findings.add(Severity::error, InputError("f", 3, "image 'b' is gone", ""));
  EXPECT_EQ(findings.kinds(Severity::error), 3);
  EXPECT_EQ(findings.sorted()[0].count, 2);
}

// Turned by 90 degrees about +Y the head looks along -X, and 30 degrees down: (-cos 30, -sin 30, 0).
TEST(MedianPose, IsAnUprightPoseThatLooksAlongTheMedian) {
  MedianPose median;
  EXPECT_EQ(median.pose(), Pose{});
  const double half = 3.14159265358979323846 / 12;
  const Pose row{
      {1, 2, 3},
      glm::dquat(std::sqrt(0.5), 0, std::sqrt(0.5), 0) * glm::dquat(std::cos(half), -std::sin(half), 0, 0)};
  for (int i = 0; i < 3; ++i) median.add(row);
  EXPECT_EQ(median.pose().position, glm::dvec3(1, 2, 3));
  const glm::dvec3 ahead = median.pose().orientation * glm::dvec3(0, 0, -1);
  EXPECT_NEAR(ahead.x, -std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(ahead.y, -0.5, 1e-12);
  EXPECT_NEAR((median.pose().orientation * glm::dvec3(1, 0, 0)).y, 0, 1e-12);  // upright
  EXPECT_EQ(median.kept().size(), 3u);
}

TEST(MedianPose, IsExactUpTo4096RowsAndEvenlyThinnedBeyond) {
  MedianPose few;
  EXPECT_EQ(few.place_m(), glm::dvec3(0.0));
  for (const double x : {5.0, -1.0, 2.0}) few.add({{x, 1.6, -x}, {1, 0, 0, 0}});
  EXPECT_EQ(few.place_m(), glm::dvec3(2, 1.6, -2));
  EXPECT_EQ(few.forward(), glm::dvec3(0, 0, -1));
  MedianPose many;
  for (int i = 0; i < 1'000'000; ++i) many.add({{1e-3 * i, 0, 0}, {0, 0, 1, 0}});
  // 0 ... 999.999 in even steps: the median of any even thinning is within a step of it of 500, 0.512 at
  // most.
  EXPECT_NEAR(many.place_m().x, 500, 0.512);
  EXPECT_NEAR(many.forward().z, 1, 1e-12) << "half a turn about y";
}

TEST(TimeProfile, KeepsEveryValueWhenItsBinsGrow) {
  TimeProfile profile;
  // 2000 s of 10 ms in 4096 bins that begin with 1 ms.
  for (int i = 0; i < 200'000; ++i)
    profile.add(i * 10 * kMs, i == 123'456 ? std::optional(9.0)
                              : i % 4 == 0 ? std::nullopt
                                           : std::optional(1.0));
  const std::vector<ProfileSpan> columns = profile.columns(0, 2'000'000 * kMs, 10);
  ASSERT_EQ(columns.size(), 10u);
  // 123456 of 200000 is in the seventh tenth.
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(columns[i].peak, i == 6 ? 9 : 1) << i;
  // A column is 200 s; bins of 0.512 s at its two ends may be shared with its neighbours: 52 values each.
  for (const ProfileSpan& column : columns) EXPECT_NEAR(static_cast<double>(column.values), 15'000, 2 * 52);
  for (const ProfileSpan& column : columns) EXPECT_NEAR(static_cast<double>(column.without), 5'000, 2 * 52);
}

TEST(IntervalCensus, KnowsQuantilesWithinOnePercentAndTheJitterOfOrdinaryIntervals) {
  IntervalCensus census;
  for (int i = 1; i <= 1000; ++i) census.count(i * kMs, i);
  EXPECT_NEAR(census.median_ns(), 500e6, 5e6);
  EXPECT_NEAR(census.quantile_ns(0.95), 950e6, 9.5e6);
  EXPECT_EQ(census.quantile_ns(1), 1e9);
  IntervalCensus two;
  two.count(10 * kMs, 2, 3);
  two.count(12 * kMs, 3, 1);
  two.count(100 * kMs, 4, 1);
  // Mean 10.5, squares 3 * 0.25 + 2.25 = 3 over 4: 0.866 ms. The hitch of 100 ms does not count.
  EXPECT_NEAR(two.jitter_ns(), 0.8660254e6, 1);
  EXPECT_EQ(two.hitches(), 1);
}

TEST(StreamOffset, TellsADriftOnlyBeyondWhatTheRatesHide) {
  const auto offset = [](double ppm) {
    StreamSummary poses, gaze;
    for (int i = 0; i <= 60'000; ++i) {
      poses.count(i * 10 * kMs, i, false);
      gaze.count(std::llround(i * 1e7 * (1 + ppm * 1e-6)), i, false);
    }
    return offset_to(poses, gaze);
  };
  // 600 s: 100 ppm are 60 ms, more than the 20 ms of two intervals; 20 ppm are 12.
  ASSERT_TRUE(offset(100).drift_ppm);
  EXPECT_NEAR(*offset(100).drift_ppm, 100, 0.01);
  EXPECT_EQ(offset(100).change_ns, 60 * kMs);
  EXPECT_FALSE(offset(20).drift_ppm);
  EXPECT_FALSE(offset(5000).drift_ppm) << "no clock is so bad: one stream ended early";
}

// A trial through the built-in map, as `herr convert` makes a session of it.
void import_trial(const std::filesystem::path& trials, const std::string& name,
                  const RecordedFolder& folder) {
  const FormatRequest request{
      {trials / (name + "_head.csv"), trials / (name + "_gaze.csv")}, "jov2023", nullptr, "", {}};
  SessionRecorder recorder(folder / "made");
  import_rows(import_request(request, choose_format(request).format.columns),
              {[&](const PoseRow& row) { recorder.add_pose(row); },
               [&](const GazeRow& row) { recorder.add_gaze(row); }});
  SessionHeader header;
  header.name = name;
  header.profile = xr1_profile();
  header.head_from_eye[0].position.x = -0.0315;
  header.head_from_eye[1].position.x = 0.0315;
  header.gaze_combined = true;
  recorder.write_header(header);
  recorder.finish();
}

TEST(InspectedRecordings, NameHitchesAndLostPupilsOfRealTrials) {
  const std::filesystem::path trials = test::real_data() / "sessions" / "jov2023_vive_pro_eye";
  if (test::real_data().empty()) GTEST_SKIP() << "the real recordings are not here";
  const struct {
    std::string name;
    // Longest interval of the file's own stamps in ms and the line that ends it, 0: none above 1.5 of 11.1.
    double gap_ms;
    std::int64_t line;
  } expected[] = {
      {"kitchen_cube_13_S004_T002", 0, 0},     {"kitchen_fixed_9_S002_T002", 0, 0},
      {"kitchen_object_10_S003_T011", 0, 0},   {"office_fixed_6_S004_T002", 47.8, 609},
      {"office_fixed_7_S001_T001", 333.4, 3},  {"office_fixed_7_S001_T002", 45.1, 1068},
      {"office_laser_6_S001_T011", 44.1, 393}, {"office_object_8_S004_T011", 43.5, 311},
  };
  for (const auto& [name, gap_ms, line] : expected) {
    SCOPED_TRACE(name);
    const RecordedFolder folder;
    import_trial(trials, name, folder);
    const SessionInspection got = inspect_session({folder / "made"});
    EXPECT_EQ(got.findings.first_error(), nullptr);
    if (line == 0) {
      EXPECT_TRUE(got.poses.longest_gaps().empty());
      continue;
    }
    const Finding gap = finding_with(got, "a gap of ");
    EXPECT_EQ(gap.severity, Severity::warning);
    EXPECT_EQ(gap.first.line(), line);
    EXPECT_NEAR(static_cast<double>(got.poses.longest_gaps()[0].length_ns) * 1e-6, gap_ms, 0.051);
    if (name != "office_object_8_S004_T011") continue;
    // 84.2 % of the rows of the file lack a pupil (959 of 1139), 455 of them both. In 22 rows, 20 of which
    // have one pupil or both, the tracker wrote no ray, and 2 rays point more than 60 degrees off.
    EXPECT_EQ(finding_with(got, "of the rows have no gaze").severity, Severity::warning);
    EXPECT_NEAR(static_cast<double>(got.eyes.either_lost_rows()) / 1139, 0.842, 0.004);
    EXPECT_EQ(got.eyes.lost_rows(), 477 + got.eyes.off_axis_rows());
    EXPECT_EQ(finding_with(got, "the right eye alone is lost").severity, Severity::warning);
  }
}

}  // namespace
}  // namespace herr
