// References of a slanted edge, whose every pixel is known exactly: how much of it the edge covers.
#include "server/study/reference/reference_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "server/study/measure/references.h"
#include "tests/renderer/test_scenes.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

constexpr double kRadiance = 0.5, kSlope = 0.3, kShift = 0.05;
const ParallelFor kOneByOne = [](int count, const std::function<void(int)>& work) {
  for (int i = 0; i < count; ++i) work(i);
};

// A glowing sheet a metre ahead, of all points with y < kSlope x + kShift.
Scene edge_scene() {
  Scene scene;
  const glm::vec3 along{1, static_cast<float>(kSlope), 0};
  const glm::vec3 corner = glm::vec3{0, static_cast<float>(kShift), -1} - 5.0f * along - glm::vec3{0, 10, 0};
  test::add(scene, test::quad(corner, 10.0f * along, {0, 10, 0}), test::glowing(glm::vec3{0.5f}));
  return scene;
}

// Share of the box [x0, x1] x [y0, y1] below the edge: its height below the edge is limited to the box's, and
// is linear in x between the places where the edge enters and leaves.
double coverage(double x0, double x1, double y0, double y1) {
  const auto height = [&](double x) { return std::clamp(kSlope * x + kShift, y0, y1) - y0; };
  std::vector<double> cuts{x0, x1};
  for (const double y : {y0, y1}) cuts.push_back(std::clamp((y - kShift) / kSlope, x0, x1));
  std::sort(cuts.begin(), cuts.end());
  double area = 0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    area += 0.5 * (height(cuts[i - 1]) + height(cuts[i])) * (cuts[i] - cuts[i - 1]);
  }
  return area / ((x1 - x0) * (y1 - y0));
}

class ReferencePictureTest : public ::testing::Test {
 protected:
  ReferencePictureTest() {
    scene_state_at(scene_, 0.0, state_);
    instant_.number = 3;
    instant_.scene = &scene_, instant_.state = &state_, instant_.sample = &sample_;
    instant_.profile = &profile_;
    instant_.maps = viewport_maps(sample_, profile_);
  }
  // Of each pixel, rows from the top.
  std::vector<double> exact() const {
    const Viewport& v = profile_.viewports[0];
    std::vector<double> values;
    const double dx = (v.tan_right - v.tan_left) / v.width_px, dy = (v.tan_up - v.tan_down) / v.height_px;
    for (int row = 0; row < v.height_px; ++row) {
      for (int column = 0; column < v.width_px; ++column) {
        const double x = v.tan_left + column * dx, y = v.tan_up - (row + 1) * dy;
        values.push_back(kRadiance * coverage(x, x + dx, y, y + dy));
      }
    }
    return values;
  }
  ReferenceSpec spec(int passes, bool refined) const {
    ReferenceSpec made = endless_effort(test::small_settings(), {});
    made.passes = passes, made.refined = refined;
    return made;
  }
  References::Context context(ReferenceCache& cache, bool out_of_time) {
    References::Context made;
    made.subject = "edge";
    made.cache = &cache;
    made.parallel_for = kOneByOne;
    made.out_of_time = [out_of_time] { return out_of_time; };
    return made;
  }

  const Scene scene_ = edge_scene();
  const DisplayProfile profile_ = test::single_view(64, 48, 30, 23);
  const FrameSample sample_ = test::sample_from({0, 0, 0});
  SceneState state_;
  FrameInstant instant_;
};

bool never() {
  return false;
}

// Where the edge does not pass a pixel is exact. Of K pixels on the edge, each half is off by independent e1
// and e2 of one distribution: the mean of both by (e1 + e2) / 2, and what is stated is |e1 - e2| / 2, alike
// in the mean. The quotient of both sums of squares is about F(K, K), whose logarithm has standard deviation
// sqrt(4 / K); pixels that the edge only touches count for little, so half of K = 64 (one in each column at
// least) is taken: 0.35. Five of these: a factor exp(5 * 0.35 / 2) = 2.4 in the root. Half floats round by
// 2^-13 = 1.2e-4, much less than what 4 to 16 passes leave.
TEST_F(ReferencePictureTest, TheMeanOfPassesIsTheCoverageWithinTheStatedError) {
  const std::vector<double> expected = exact();
  double last = 1;
  for (const int passes : {2, 4, 16}) {
    const ReferenceSpec of_edge = spec(passes, false);
    const ReferencePicture reference =
        mean_of_halves(of_edge, instant_, render_halves(of_edge, instant_, never), kOneByOne);
    EXPECT_EQ(reference.passes, passes);
    EXPECT_EQ(reference.most_passes, passes);
    ASSERT_EQ(reference.picture.size(), 1u);
    double squares = 0, bias = 0;
    int on_edge = 0;
    for (const auto& plane : reference.picture[0].plane) {
      ASSERT_EQ(plane.size(), expected.size());
      for (std::size_t i = 0; i < plane.size(); ++i) {
        const double off = double{plane[i]} - expected[i];
        squares += off * off, bias += off;
        if (expected[i] == 0 || expected[i] == kRadiance) {
          EXPECT_EQ(double{plane[i]}, expected[i]) << i;
        } else {
          ++on_edge;
        }
      }
    }
    const double values = 3.0 * double(expected.size());
    const double rmse = std::sqrt(squares / values), stated = reference.error.at(Metric::rmse);
    EXPECT_GE(on_edge, 3 * 64);
    EXPECT_GT(rmse, stated / 2.4) << passes;
    EXPECT_LT(rmse, stated * 2.4) << passes;
    EXPECT_LT(rmse, last) << passes;
    last = rmse;
    // No bias: the mean over K pixels on the edge is off by their RMS over sqrt(K), 5 of these and rounding.
    const double edge = std::max(1.0, double(on_edge) / 3), rms_on_edge = std::sqrt(squares / (3 * edge));
    EXPECT_LT(std::abs(bias / (3 * edge)), 5 * rms_on_edge / std::sqrt(edge) + 1.3e-4) << passes;
  }
}

TEST_F(ReferencePictureTest, PassesGoOnOnlyWhereTheHalvesDiffer) {
  const ReferenceHalves halves = render_halves(spec(2, true), instant_, never);
  EXPECT_TRUE(halves.goal_met);
  EXPECT_EQ(halves.passes, 2);  // tiles without an edge
  EXPECT_GT(halves.most_passes, 2);
  EXPECT_LE(halves.most_passes, 512);
  const ReferenceHalves hurried = render_halves(spec(8, true), instant_, [] { return true; });
  EXPECT_FALSE(hurried.goal_met);
  EXPECT_EQ(hurried.most_passes, 2);
  const auto enough = [](double so_far_s, double pass_s) { return pass_s > 0 && so_far_s >= pass_s; };
  const ReferenceHalves coarse = render_halves(
      spec(8, true), instant_, [] { return true; }, enough);
  EXPECT_EQ(coarse.passes, 1);
  EXPECT_EQ(coarse.most_passes, 1);
  EXPECT_FALSE(coarse.goal_met);
  EXPECT_EQ(render_halves(spec(3, false), instant_, [] { return true; }).passes, 3);
}

// A frame of no rows cannot be rendered: where time ends the first passes, nothing tries to.
TEST_F(ReferencePictureTest, TheFrameOfTheSmallestErrorIsNotRenderedWhereTimeEndsThePasses) {
  ReferenceSpec hurried = spec(8, true);
  hurried.finest.polar_height = 0;
  EXPECT_EQ(render_halves(hurried, instant_, [] { return true; }).passes, 2);
  const auto enough = [](double, double) { return true; };
  EXPECT_EQ(render_halves(hurried, instant_, never, enough).passes, 1);
  EXPECT_ANY_THROW(render_halves(hurried, instant_, never));
}

TEST_F(ReferencePictureTest, ACachedReferenceIsTheFreshOneBitForBit) {
  const TemporaryFolder folder;
  ReferenceCache cache(folder.path());
  References fresh(instant_, context(cache, false)), cached(instant_, context(cache, false));
  const ReferencePicture one = fresh.get(spec(4, false));
  const ReferencePicture other = cached.get(spec(4, false));
  EXPECT_EQ(one.seconds, other.seconds);  // it was not made again
  EXPECT_EQ(one.picture[0].plane, other.picture[0].plane);
  for (std::size_t band = 0; band < kBands; ++band) {
    for (std::size_t metric = 0; metric < kMetrics; ++metric) {
      const double a = one.error.value[band][metric], b = other.error.value[band][metric];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << band << " " << metric;
    }
  }
  ASSERT_EQ(cached.made().size(), 1u);
  EXPECT_TRUE(cached.made()[0].picture.empty());
  EXPECT_EQ(cached.seconds(), one.seconds);
}

TEST_F(ReferencePictureTest, OneThatWasLeftTooRoughIsImprovedWhereThatIsAsked) {
  const TemporaryFolder folder;
  ReferenceCache cache(folder.path());
  const auto get = [&](bool out_of_time, bool improve) {
    References references(instant_, context(cache, out_of_time));
    return references.get(spec(8, true), improve);
  };
  EXPECT_EQ(get(true, false).passes, 2);
  EXPECT_EQ(get(false, false).passes, 2);  // what rows were measured against stays
  EXPECT_EQ(get(true, true).passes, 2);
  const ReferencePicture better = get(false, true);
  EXPECT_TRUE(better.goal_met);
  EXPECT_GE(better.passes, 8);
  const ReferencePicture again = get(true, true);
  EXPECT_EQ(again.seconds, better.seconds);
  EXPECT_EQ(again.picture[0].plane, better.picture[0].plane);
}

}  // namespace
}  // namespace herr
