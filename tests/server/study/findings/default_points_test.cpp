// The default as a point of each sweep that it lies on: once measured, never twice.
#include "server/study/findings/default_points.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/study/findings/study_fits.h"
#include "tests/server/study/report/study_records.h"

namespace herr {
namespace {

StudySetting edge(const std::string& value, const std::string& base) {
  StudySetting made;
  made.knob = "edge", made.base = base, made.value = value;
  made.name = "edge " + value + ", " + base;
  made.n = std::stod(value);
  return made;
}

StudyPoint base_point(const std::string& base, double error) {
  StudyPoint made = test::study_point("default", base, "", 0, error, 1);
  made.name = "default, " + base;
  made.on_front = true;
  made.flicker.emplace();
  return made;
}

TEST(DefaultPoints, AreTheDefaultsUnderNamesOfTheirSweeps) {
  std::vector<StudyPoint> points{base_point("N = 1", 0.08),
                                 test::study_point("edge", "N = 1", "4", 4, 0.02, 2)};
  const std::vector<StudySetting> of_default{edge("1", "N = 1"), edge("1", "N = 64")};
  add_points_of_default(of_default, points);
  ASSERT_EQ(points.size(), 3u);  // the default with soft light was not measured
  const StudyPoint& added = points.back();
  EXPECT_EQ(added.name, "edge 1, N = 1");
  EXPECT_EQ(added.knob, "edge");
  EXPECT_EQ(added.value, "1");
  EXPECT_EQ(added.n, 1);
  EXPECT_EQ(added.error.at(Metric::acuity_rmse), 0.08);
  EXPECT_EQ(added.time_ratio.estimate, 1);
  EXPECT_TRUE(added.of_default);
  EXPECT_FALSE(added.on_front || added.flicker);
  EXPECT_TRUE(points.front().on_front && points.front().flicker);
  // Nothing else of this sweep was measured.
  StudySetting other = edge("1", "N = 1");
  other.knob = "filter", other.name = "filter 1, N = 1";
  add_points_of_default(std::vector{other}, points);
  EXPECT_EQ(points.size(), 3u);
  // Rows of an earlier program that measured it stay the point.
  add_points_of_default(of_default, points);
  EXPECT_EQ(points.size(), 3u);
}

// 0.08 at 1, 0.04 at 2 and 0.02 at 4: half the error for twice the effort, so the exponent is -1. Two points
// are too few for a fit.
TEST(DefaultPoints, AreInTheFitsOfTheirSweeps) {
  std::vector<StudyPoint> points{base_point("N = 1", 0.08),
                                 test::study_point("edge", "N = 1", "2", 2, 0.04, 2),
                                 test::study_point("edge", "N = 1", "4", 4, 0.02, 4)};
  const std::vector<Knob> knobs{{"edge", "edge", "rays", "", 1, 0}};
  EXPECT_FALSE(fit_knobs(knobs, points, {}).fits.at(0).fit);
  add_points_of_default(std::vector{edge("1", "N = 1")}, points);
  const StudyFits with_default = fit_knobs(knobs, points, {});
  ASSERT_TRUE(with_default.fits.at(0).fit);
  EXPECT_NEAR(with_default.fits.at(0).fit->p.estimate, -1, 1e-6);
}

}  // namespace
}  // namespace herr
