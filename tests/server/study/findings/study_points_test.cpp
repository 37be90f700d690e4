// Points from rows by hand.
#include "server/study/findings/study_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/server/study/report/study_records.h"

namespace herr {
namespace {

StudyReference reference_of(const std::string& name, double acuity_rmse) {
  StudyReference reference;
  reference.name = name;
  reference.error = test::error_table(acuity_rmse);
  return reference;
}

StudyRow row_of(const std::string& name, std::int64_t frame, double error, double log_ratio) {
  StudyRow row;
  row.name = name, row.knob = "filter", row.base = "N = 1", row.value = "nearest";
  row.flags = "--filter nearest";
  row.frame = frame;
  row.reference = "endless effort";
  row.error = test::error_table(error);
  // Alike, and enough of them for an interval.
  row.log_ratios.assign(4, log_ratio);
  row.work_log_ratios.assign(4, log_ratio - 1);
  return row;
}

const std::vector<StudyReference> kReferences{reference_of("endless effort", 0.001),
                                              reference_of("endless effort, --probes", 0.01)};

TEST(StudyPoints, TakeErrorsAndTimesOverTheirFrames) {
  std::vector<StudyRow> rows{row_of("a", 3, 0.3, 0.5), row_of("b", 3, 0.1, 0.7), row_of("a", 7, 0.4, 0.5)};
  rows[0].bias = 0.01, rows[2].bias = 0.07;
  rows[0].frame_ms = 10, rows[2].frame_ms = 30;
  rows[0].counters.commits = 1, rows[2].counters.commits = 4;
  rows[0].own_error = test::error_table(0.03), rows[2].own_error = test::error_table(0.04);
  rows[0].own_reference = rows[2].own_reference = "hard light";
  const std::vector<StudyPoint> points = points_of(rows, kReferences);
  ASSERT_EQ(points.size(), 2u);
  const StudyPoint& a = points[0];
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(points[1].name, "b");
  EXPECT_EQ(a.flags, "--filter nearest");
  EXPECT_EQ(a.frames, 2);
  EXPECT_EQ(points[1].frames, 1);
  // Sums of two or three doubles, and a root: some units in the last place.
  constexpr double kRounding = 1e-15;
  EXPECT_NEAR(a.error.at(Metric::acuity_rmse), std::sqrt((0.09 + 0.16) / 2), kRounding);
  ASSERT_TRUE(a.own_error && a.bias);
  EXPECT_NEAR(a.own_error->at(Metric::acuity_rmse), std::sqrt((0.0009 + 0.0016) / 2), kRounding);
  EXPECT_NEAR(isolated_error(a), a.own_error->at(Metric::acuity_rmse), 0);
  EXPECT_NEAR(isolated_error(points[1]), 0.1, kRounding);
  EXPECT_NEAR(*a.bias, 0.05, kRounding);  // sqrt((1 + 49) / 2) = 5
  EXPECT_NEAR(a.time_ratio.estimate, std::exp(0.5), 1e-15 * 4);
  EXPECT_NEAR(a.time_ratio.lower, std::exp(0.5), 1e-15 * 4);  // eight alike
  EXPECT_NEAR(a.work_ratio.estimate, std::exp(-0.5), 1e-15 * 4);
  EXPECT_TRUE(std::isinf(points[1].time_ratio.upper));  // four are too few for 95 %
  EXPECT_EQ(a.frame_ms, 20);
  ASSERT_EQ(a.counters.size(), 1u);  // zeros are left out
  EXPECT_EQ(a.counters[0], (std::pair<std::string, double>{"commits", 2.5}));
}

// Two renderers of one setting: what they differ by is no ratio of the setting.
TEST(StudyPoints, TheDefaultTakesExactlyAsLongAsItselfWhateverWasMeasured) {
  std::vector<StudyRow> rows{row_of("default, N = 1", 1, 0.1, 0.04), row_of("nearest", 1, 0.2, 0.04)};
  rows[0].flags.clear();
  rows[0].log_ratios = {0.2, -0.1, 0.04, 0.08};
  const std::vector<StudyPoint> points = points_of(rows, kReferences);
  for (const Interval& ratio : {points[0].time_ratio, points[0].work_ratio}) {
    EXPECT_EQ(ratio.estimate, 1);
    EXPECT_EQ(ratio.lower, 1);
    EXPECT_EQ(ratio.upper, 1);
  }
  EXPECT_NEAR(points[1].time_ratio.estimate, std::exp(0.04), 1e-15);
  EXPECT_TRUE(points[0].on_front) << "nothing is better and as fast";
  const std::vector<StudyPoint> alone = points_of({rows.data(), 1}, kReferences);
  EXPECT_EQ(alone.front().time_ratio.estimate, 1) << "of one setting alone, too";
}

TEST(StudyPoints, AreAtTheFloorBelowThreeTimesTheErrorOfTheirReference) {
  std::vector<StudyRow> rows{row_of("below", 1, 0.0029, 0), row_of("above", 1, 0.0031, 0),
                             row_of("other", 1, 0.029, 0)};
  rows[2].reference = kReferences[1].name;
  const std::vector<StudyPoint> points = points_of(rows, kReferences);
  EXPECT_TRUE(points[0].at_floor);
  EXPECT_FALSE(points[1].at_floor);
  EXPECT_TRUE(points[2].at_floor);
  EXPECT_TRUE(points[0].comparable);
  EXPECT_FALSE(points[2].comparable);
}

TEST(StudyPoints, TheFrontIsOfPointsOnOneModelAndAllFrames) {
  std::vector<StudyRow> rows;
  for (const std::int64_t frame : {1, 2}) {
    rows.push_back(row_of("slow and good", frame, 0.1, 1));
    rows.push_back(row_of("fast and bad", frame, 0.3, -1));
    rows.push_back(row_of("slow and bad", frame, 0.3, 1));
    rows.push_back(row_of("of another model", frame, 0.01, -2));
    rows.back().reference = kReferences[1].name;
  }
  rows.push_back(row_of("of one frame", 1, 0.01, -3));
  std::vector<std::string> front;
  for (const StudyPoint& point : points_of(rows, kReferences)) {
    if (point.on_front) front.push_back(point.name);
    EXPECT_EQ(point.front_confidence, point.on_front ? 1 : 0) << point.name;  // all frames are alike
  }
  EXPECT_EQ(front, (std::vector<std::string>{"slow and good", "fast and bad"}));
}

TEST(StudyPoints, ARowOfAClipAddsItsFlickerAndIsNoFrame) {
  StudyRow clip = row_of("a", 40, 9, 9);
  clip.error.reset();
  clip.log_ratios.clear(), clip.work_log_ratios.clear();
  clip.flicker.emplace();
  clip.flicker->excess.fill(0.25);
  const std::vector<StudyPoint> points =
      points_of(std::vector<StudyRow>{row_of("a", 1, 0.3, 0.5), clip}, kReferences);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].frames, 1);
  ASSERT_TRUE(points[0].flicker);
  EXPECT_EQ(points[0].flicker->excess[kAllPixels], 0.25);
  EXPECT_TRUE(points_of({}, {}).empty());
}

TEST(StudyPoints, WidthsOfTwoRatiosAddInSquares) {
  // In logarithms of 2: 2 [1, 3] and 1 [0, 3]. The quotient: 1, down sqrt(1 + 2^2), up sqrt(1 + 1).
  const Interval ratio = ratio_between({4, 2, 8}, {2, 1, 8});
  EXPECT_NEAR(ratio.estimate, 2, 1e-14);
  EXPECT_NEAR(ratio.lower, std::exp2(1 - std::sqrt(5)), 1e-14);
  EXPECT_NEAR(ratio.upper, std::exp2(1 + std::sqrt(2)), 1e-13);
  const Interval unknown = ratio_between({4, 2, 8}, {2, -HUGE_VAL, HUGE_VAL});
  EXPECT_NEAR(unknown.estimate, 2, 1e-14);
  EXPECT_EQ(unknown.lower, -HUGE_VAL);
  EXPECT_EQ(unknown.upper, HUGE_VAL);
}

}  // namespace
}  // namespace herr
