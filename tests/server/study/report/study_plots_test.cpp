// Which points stand in which diagram, and where its lines run.
#include "server/study/report/study_plots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tests/server/study/report/study_records.h"

namespace herr {
namespace {

TEST(WorkPrecisionPlot, DrawsEachPointOnceAndNumbersTheFront) {
  const StudyRecord record = test::rich_record();
  const Plot plot = work_precision_plot(record, Metric::acuity_rmse, "p").plot;
  EXPECT_EQ(plot.marks.size(), record.points.size());
  EXPECT_EQ(plot.marks.back().title.substr(0, 7), "default");  // over all others
  std::vector<int> numbers;
  for (const PlotMark& mark : plot.marks) {
    if (!mark.label.empty()) numbers.push_back(std::stoi(mark.label));
  }
  std::sort(numbers.begin(), numbers.end());
  ASSERT_EQ(numbers.size(), front_of(record).size());
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], static_cast<int>(i) + 1);
  // The record's reference has an own error of 4e-4, and points count as told apart from 3 times that on.
  EXPECT_DOUBLE_EQ(plot.floor, 3 * 4e-4);
}

// Points of other light are held against another picture: neither mark nor legend, but told.
TEST(WorkPrecisionPlot, PointsThatDoNotCompareAreLeftOutAndCounted) {
  StudyRecord record;
  record.points = {test::study_point("a", "", "1", 1, 0.5, 1), test::study_point("lit", "", "1", 1, 0.25, 3),
                   test::study_point("lit", "", "2", 2, 0.2, 4)};
  record.points[1].comparable = record.points[2].comparable = false;
  const StudyPlot plot = work_precision_plot(record, Metric::acuity_rmse, "p");
  EXPECT_EQ(plot.plot.marks.size(), 1u);
  EXPECT_EQ(plot.legend.size(), 1u);
  EXPECT_NE(plot.caption.find("Not here, since their light or frames are others: 2 settings"),
            std::string::npos)
      << plot.caption;
}

TEST(WorkPrecisionPlot, TheFrontIsStairs) {
  StudyRecord record;
  record.points = {test::study_point("a", "", "1", 1, 0.5, 1), test::study_point("a", "", "2", 2, 0.25, 3)};
  for (StudyPoint& point : record.points) point.on_front = true;
  const Plot plot = work_precision_plot(record, Metric::acuity_rmse, "p").plot;
  ASSERT_EQ(plot.curves.size(), 1u);
  const std::vector<std::array<double, 2>> stairs{{1, 0.5}, {3, 0.5}, {3, 0.25}};
  EXPECT_EQ(plot.curves[0].at, stairs);
}

TEST(KnobPlot, DrawsFloorPlusPowerThroughTheEffortsMeasured) {
  StudyRecord record;
  record.points = {test::study_point("k", "b", "1", 1, 0.5, 1),
                   test::study_point("k", "b", "16", 16, 0.2, 3)};
  record.fits = {{"k", "b", "endless effort", Metric::acuity_rmse, "rays",
                  PowerFit{{-0.5, -1, 0}, {0.1, 0, 1}, 0.4, 0, 2}, "", ""}};
  const StudyPlot plot = knob_plot(record, "k", "p");
  ASSERT_EQ(plot.plot.curves.size(), 1u);
  const auto& at = plot.plot.curves[0].at;
  // 0.1 + 0.4 = 0.5 at n = 1 and 0.1 + 0.4 / 4 = 0.2 at n = 16; pow is right to 1e-15 of its result.
  EXPECT_NEAR(at.front()[0], 1, 1e-14);
  EXPECT_NEAR(at.front()[1], 0.5, 1e-14);
  EXPECT_NEAR(at.back()[0], 16, 1e-13);
  EXPECT_NEAR(at.back()[1], 0.2, 1e-14);
}

}  // namespace
}  // namespace herr
