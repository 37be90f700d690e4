#include "sessions/camera/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

CameraModel model_of(CameraModelKind kind, int width_px, int height_px, double f, double cx, double cy,
                     std::initializer_list<double> distortion) {
  CameraModel model;
  model.kind = kind;
  model.width_px = width_px;
  model.height_px = height_px;
  model.fx = model.fy = f;
  model.cx = cx;
  model.cy = cy;
  std::copy(distortion.begin(), distortion.end(), model.distortion.begin());
  model.prepare();
  return model;
}

// A webcam's barrel distortion with strong tangential terms.
CameraModel webcam() {
  return model_of(CameraModelKind::pinhole, 640, 480, 520, 325, 245, {-0.30, 0.12, 0.003, -0.002, -0.02});
}
// Camera-et-left of a Project Aria device, as DATA.md cites it.
CameraModel kb4_lens() {
  return model_of(CameraModelKind::kb4, 640, 480, 556.5, 319.5, 239.5, {0.0398, -0.0398, 0.1244, -0.2781});
}
// Camera-slam-left of the same device: 150 degrees wide.
CameraModel fisheye624_lens() {
  return model_of(CameraModelKind::fisheye624, 640, 480, 242.05, 319.8, 240.97,
                  {-0.02689, 0.10199, -0.07181, 0.01246, 0.00124, -0.000415, 0.00055, 0.000582, -0.00123,
                   -0.000387, -0.000596, 0.0000107});
}

// Pixel -> direction -> pixel over the image. unproject() stops within 1e-9 px of the pixel; the way through
// sin, cos and atan2 adds some 20 ulps (4e-15) times a focal length below 700 px and a slope of the lens
// below 10: 3e-11.
constexpr double kRoundTripPx = 2e-9;

int round_trip(const CameraModel& model) {
  int seen = 0;
  for (double y = 0; y < model.height_px; y += model.height_px / 48.0)
    for (double x = 0; x < model.width_px; x += model.width_px / 64.0) {
      const auto direction = model.unproject({x, y});
      if (!direction) continue;
      EXPECT_NEAR(glm::length(*direction), 1, 1e-15);
      const auto pixel = model.project(*direction * 7.0);  // the length must not matter
      if (!pixel) {
        // Only on the very border of what the lens sees may rounding decide otherwise.
        EXPECT_NEAR(std::acos(-direction->z), model.max_angle_rad, 1e-9);
        continue;
      }
      EXPECT_LT(glm::distance(*pixel, glm::dvec2(x, y)), kRoundTripPx) << x << ' ' << y;
      ++seen;
    }
  return seen;
}

TEST(CameraModel, ProjectsAndUnprojectsEveryPixelOfThreeLenses) {
  EXPECT_GE(round_trip(webcam()), 3000);
  EXPECT_GE(round_trip(kb4_lens()), 3000);
  EXPECT_GE(round_trip(fisheye624_lens()), 2900);
}

TEST(CameraModel, LooksAlongMinusZWithYUpAndPixelsDown) {
  const CameraModel model = model_of(CameraModelKind::pinhole, 100, 100, 50, 49.5, 49.5, {});
  EXPECT_EQ(*model.project({0, 0, -2}), glm::dvec2(49.5, 49.5));
  EXPECT_EQ(*model.project({1, 0, -2}), glm::dvec2(74.5, 49.5)) << "right in the world is right in the image";
  EXPECT_EQ(*model.project({0, 1, -2}), glm::dvec2(49.5, 24.5)) << "up in the world is a smaller row";
  EXPECT_FALSE(model.project({0, 0, 1})) << "behind";
  EXPECT_FALSE(model.project({0, 0, 0})) << "no direction";
  EXPECT_FALSE(model.project({NAN, 0, -1}));
  EXPECT_EQ(*model.unproject({49.5, 49.5}), glm::dvec3(0, 0, -1));
}

TEST(CameraModel, IdealFisheyeIsLinearInTheAngleAndSeesBehindItself) {
  const CameraModel model = model_of(CameraModelKind::kb4, 1000, 1000, 100, 500, 500, {});
  for (const double deg : {1.0, 45.0, 90.0, 120.0, 178.0}) {
    const double angle = glm::radians(deg);
    const auto pixel = model.project({std::sin(angle), 0, -std::cos(angle)});
    ASSERT_TRUE(pixel) << deg;
    EXPECT_NEAR(pixel->x, 500 + 100 * angle, 1e-12 * 500);
  }
}

TEST(CameraModel, BrownConradyMatchesTheFormulaWrittenOut) {
  const CameraModel model = webcam();
  const double x = 0.3, y = 0.2, s = x * x + y * y;
  const double radial = 1 - 0.30 * s + 0.12 * s * s - 0.02 * s * s * s;
  // OpenCV's documentation: x'' = x' radial + 2 p1 x' y' + p2 (r2 + 2 x'2), and so on.
  const double u = x * radial + 2 * 0.003 * x * y - 0.002 * (s + 2 * x * x);
  const double v = y * radial + 0.003 * (s + 2 * y * y) - 2 * 0.002 * x * y;
  const auto pixel = model.project({x, -y, -1});
  EXPECT_NEAR(pixel->x, 520 * u + 325, 1e-12 * 520);
  EXPECT_NEAR(pixel->y, 520 * v + 245, 1e-12 * 520);
}

TEST(CameraModel, EndsWhereItsPolynomialTurnsBack) {
  // r (1 - r^2 / 3) rises until r = 1, that is 45 degrees.
  const CameraModel model = model_of(CameraModelKind::pinhole, 100, 100, 50, 50, 50, {-1.0 / 3});
  EXPECT_NEAR(model.max_angle_rad, glm::radians(45.0), 1e-9);
  EXPECT_TRUE(model.project({0.99, 0, -1}));
  EXPECT_FALSE(model.project({1.01, 0, -1}));
  // The image ends at 2/3 of a focal length: pixels beyond see nothing, and must say so.
  EXPECT_TRUE(model.unproject({50 + 50 * 0.66, 50}));
  EXPECT_FALSE(model.unproject({50 + 50 * 0.67, 50}));
}

TEST(CameraModel, ContainsWholePixelsUpToTheirBorders) {
  const CameraModel model = model_of(CameraModelKind::pinhole, 100, 50, 50, 50, 25, {});
  EXPECT_TRUE(model.contains({-0.5, -0.5}));
  EXPECT_TRUE(model.contains({99.5, 49.5}));
  EXPECT_FALSE(model.contains({99.6, 10}));
}

// Parameters of a real device: f (or fx fy), cx, cy, then the distortion.
CameraModel real_lens(const std::string& name, const std::vector<double>& params, int width_px,
                      int height_px) {
  CameraModel model;
  const bool fisheye624 = name == "FisheyeRadTanThinPrism";
  model.kind = fisheye624 ? CameraModelKind::fisheye624 : CameraModelKind::kb4;
  std::size_t at = 0;
  model.fx = params.at(at++);
  model.fy = fisheye624 ? model.fx : params.at(at++);
  model.cx = params.at(at++);
  model.cy = params.at(at++);
  model.width_px = width_px;
  model.height_px = height_px;
  for (std::size_t i = 0; at < params.size(); ++i, ++at) model.distortion.at(i) = params[at];
  model.prepare();
  return model;
}

TEST(CameraModel, RoundTripsWithTheCalibrationOfRealGlasses) {
  const std::filesystem::path file = test::real_data() / "frames/aria_aea/calib.json";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no recordings beside the project";
  std::ifstream stream(file);
  const nlohmann::json calibration = nlohmann::json::parse(stream);
  int lenses = 0;
  for (const nlohmann::json& camera : calibration["CameraCalibrations"]) {
    const std::string label = camera["Label"], name = camera["Projection"]["Name"];
    const auto params = camera["Projection"]["Params"].get<std::vector<double>>();
    const int width_px = static_cast<int>(2 * params.at(name == "FisheyeRadTanThinPrism" ? 1 : 2));
    const int height_px = static_cast<int>(2 * params.at(name == "FisheyeRadTanThinPrism" ? 2 : 3));
    SCOPED_TRACE(label);
    EXPECT_GE(round_trip(real_lens(name, params, width_px, height_px)), 2000);
    ++lenses;
  }
  EXPECT_EQ(lenses, 5);
}

}  // namespace
}  // namespace herr
