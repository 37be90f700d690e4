// Short-ray ambient occlusion against the closed form of a floor beside a wall.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kRadius_m = 0.5;
constexpr double kAmbient = 1.0;

// A floor and, in the plane x = 0 on its left, a wall far taller than the radius; seen from
// above at x in [0, 0.7] m.
Scene floor_beside_wall() {
  Scene scene;
  test::add(scene, test::floor_quad(20), test::matte(glm::vec3{0.5f}));
  test::add(scene, test::quad({0, 0, 20}, {0, 0, -40}, {0, 5, 0}), test::matte(glm::vec3{0.5f}));
  scene.ambient = glm::vec3{static_cast<float>(kAmbient)};
  return scene;
}

// What each hit's own rays find, or the mean over its neighbours.
RenderSettings settings_with(int rays, bool smoothing = false) {
  RenderSettings settings = test::planar_settings();
  settings.occlusion_rays = rays;
  settings.occlusion_radius_m = kRadius_m;
  settings.occlusion_smoothing = smoothing;
  return settings;
}

// The share of a cosine-weighted hemisphere of radius R that a wall at distance a leaves open. Seen from the
// floor the wall's points within R are those directions whose component towards it is at least c = a / R;
// projected to the unit disc of the floor (cosine weighting is area there) that is the segment beyond c, of
// area acos c - c sqrt(1 - c^2).
double open_share(double distance_m) {
  const double c = distance_m / kRadius_m;
  if (c >= 1) return 1;
  return 1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / glm::pi<double>();
}

TEST(AmbientOcclusionTest, AFloorBesideAWallIsDarkenedByTheSegmentOfTheDisc) {
  const Scene scene = floor_beside_wall();
  const double eye_height_m = 1.5;
  // 128 columns over 0.7 m beside the wall, 48 rows along it. All halves of blocks turn their directions
  // alike: down a column they have 6 * 64 places (every third one of 18 * 64) between them. A frame's turn is
  // its own, so the mean of a column over 16 seeds takes 16 * 384 independent rays: its deviation is below
  // sqrt(0.25 / 6144) = 0.0064 were a frame's not spread evenly over radii and angles, which makes it less
  // than half of that.
  constexpr std::uint32_t kSeeds = 16;
  const DisplayProfile profile = [&] {
    DisplayProfile p;
    p.name = "beside the wall";
    const double right_deg = std::atan2(0.7, eye_height_m) * kDegreesPerRadian;
    p.viewports = {test::viewport_deg(Eye::left, 128, 48, 0.01, right_deg, -8, 8)};
    return p;
  }();
  const double unoccluded = (0.5 + 0.04) * kAmbient;  // diffuse and F0
  std::vector<double> sums(128);
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    RenderSettings settings = settings_with(64);
    settings.seed = seed;
    const RenderedFrame frame =
        test::render(scene, profile, settings, test::looking_down({0.001, eye_height_m, 0}));
    test::for_each_pixel(frame.viewports[0], [&](int x, int, const test::Pixel& pixel) {
      sums[static_cast<std::size_t>(x)] += pixel[0];
    });
    EXPECT_EQ(frame.counters.rays[RayKind::occlusion], 64 * 128 * 48);
  }
  double worst = 0;
  int columns = 0;
  for (int x = 2; x < 128; ++x) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, 24);
    const double distance = 0.001 + eye_height_m * d.x / -d.z;
    const double measured = sums[static_cast<std::size_t>(x)] / (48 * kSeeds) / unoccluded;
    worst = std::max(worst, std::abs(measured - open_share(distance)));
    ASSERT_NEAR(measured, open_share(distance), 0.01) << "at " << distance << " m";
    ++columns;
  }
  std::cout << "worst error of " << columns << " columns: " << worst << "\n";
}

// What 128 x 128 pixels show of the floor, 0.7 m wide, as shares of what is open. x = 4 .. 79: up to 0.44 m
// from the wall.
class MeanOverNeighboursTest : public testing::Test {
 protected:
  MeanOverNeighboursTest() {
    profile_.name = "beside the wall";
    const double right_deg = std::atan2(0.7, kEyeHeight_m) * kDegreesPerRadian;
    profile_.viewports = {test::viewport_deg(Eye::left, 128, 128, 0.01, right_deg, -8, 8)};
  }

  // [x][y]
  std::vector<std::vector<double>> shares(std::uint32_t seed, bool smoothing) const {
    RenderSettings settings = settings_with(1, smoothing);
    settings.seed = seed;
    const RenderedFrame frame =
        test::render(scene_, profile_, settings, test::looking_down({0.001, kEyeHeight_m, 0}));
    const double unoccluded = (0.5 + 0.04) * kAmbient;  // diffuse and F0
    std::vector<std::vector<double>> shares(80, std::vector<double>(128));
    for (int x = 4; x < 80; ++x) {
      for (int y = 0; y < 128; ++y) {
        shares[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)] =
            test::pixel_at(frame.viewports[0], x, y)[0] / unoccluded;
      }
    }
    return shares;
  }

  double open_at(int x) const {
    const glm::dvec3 d = test::direction_of_pixel(profile_.viewports[0], x, 64);
    return open_share(0.001 + kEyeHeight_m * d.x / -d.z);
  }

  static constexpr double kEyeHeight_m = 1.5;
  static constexpr std::uint32_t kSeeds = 8;

 private:
  const Scene scene_ = floor_beside_wall();
  DisplayProfile profile_;
};

// A ray finds the wall or not: its deviation is sqrt(p (1 - p)). The eighteen strata of a group hold rays of
// their own, spread over radii and angles, so that the mean's deviation is less than by 18 independent rays.
// One frame turns them all alike: the RMS is that over frames of several seeds. The group's middle lies up to
// 4 + 3 pixels off a pixel at the border of a tile; p has the slope 2 sqrt(1 - c^2) / (pi R) < 1.28 per
// metre.
TEST_F(MeanOverNeighboursTest, HasTheNoiseOfEighteenTimesTheRays) {
  const auto error_with = [&](bool smoothing) {
    double squared = 0, expected = 0;
    int count = 0;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
      const auto seen = shares(seed, smoothing);
      for (int x = 4; x < 80; ++x) {
        const double open = open_at(x);
        for (const double share : seen[static_cast<std::size_t>(x)]) {
          squared += (share - open) * (share - open);
          expected += open * (1 - open);
          ++count;
        }
      }
    }
    return std::pair{std::sqrt(squared / count), std::sqrt(expected / count)};
  };
  const auto [single, deviation] = error_with(false);
  const auto [mean, same] = error_with(true);
  EXPECT_NEAR(single, deviation, 0.1 * deviation);
  const double largest_shift = 7 * (0.7 / 128) * 1.28;
  EXPECT_LT(mean, deviation / std::sqrt(18.0) + largest_shift);
  EXPECT_LT(mean, 0.4 * single);
  std::cout << "RMS error of one ray " << single << ", of the mean " << mean << "\n";
}

// Along the wall each group, wherever it stands, has the same angles and the same strata of radii: only rays
// whose stratum of squared radii, 1 / 18 wide, holds the (c / cos angle)^2 from which on they find the wall
// can differ. Of angles turned at random that is the share acos(c) / pi of one ray, at most a half: the mean
// of 18 has the variance 1/2 * 1/4 / 18^2 at most, the deviation 0.02 (18 rays of any angles: up to 0.118).
TEST_F(MeanOverNeighboursTest, IsTheSameWhereverTheNeighboursStand) {
  double squared = 0;
  int count = 0;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const auto seen = shares(seed, true);
    for (int x = 4; x < 80; ++x) {
      const std::vector<double>& along = seen[static_cast<std::size_t>(x)];
      double mean = 0;
      for (const double share : along) mean += share / static_cast<double>(along.size());
      for (const double share : along) squared += (share - mean) * (share - mean);
      count += static_cast<int>(along.size());
    }
  }
  const double deviation = std::sqrt(squared / count);
  EXPECT_LT(deviation, std::sqrt(0.5 * 0.25) / 18);
  std::cout << "deviation along the wall " << deviation << "\n";
}

// A sheet a metre above the floor, 0.6 m beside the wall: nothing stands within 0.5 m of it, so that it is
// open all over. From (1.35, 2.5) its edge at 0.6 m is seen before the floor at 1.35 - 0.75 * 2.5 / 1.5 = 0.1
// m, which the wall darkens.
TEST(AmbientOcclusionTest, TheMeanOverNeighboursEndsAtTheEdgeOfASurface) {
  Scene scene = floor_beside_wall();
  test::add(scene, test::quad({0.6f, 1, 0.3f}, {0.2f, 0, 0}, {0, 0, -0.6f}), test::matte(glm::vec3{0.25f}));
  DisplayProfile profile;
  profile.name = "at the edge";
  profile.viewports = {test::viewport_deg(Eye::left, 128, 96, -29, -22, -3, 3)};
  const FrameSample sample = test::looking_down({1.35, 2.5, 0});
  const RenderedFrame bare = test::render(scene, profile, settings_with(0), sample);
  const RenderedFrame mean = test::render(scene, profile, settings_with(1, true), sample);
  const double sheet = 0.27, floor = 0.52;  // diffuse and F0 of light 1, rounded down
  int on_sheet = 0, darkened = 0;
  test::for_each_pixel(bare.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const double seen = test::pixel_at(mean.viewports[0], x, y)[0];
    if (pixel[0] < floor && pixel[0] > sheet) {
      ++on_sheet;
      ASSERT_EQ(seen, pixel[0]) << x << ' ' << y;
    }
    darkened += pixel[0] > floor && seen < 0.9 * pixel[0] ? 1 : 0;
  });
  EXPECT_GT(on_sheet, 1000);
  EXPECT_GT(darkened, 1000);
}

TEST(AmbientOcclusionTest, AnOpenFloorStaysAsItIsBitForBit) {
  Scene scene;
  test::add(scene, test::floor_quad(20), test::matte(glm::vec3{0.5f}));
  scene.ambient = glm::vec3{0.7f};
  const DisplayProfile profile = test::small_profile();
  for (const bool smoothing : {false, true}) {
    test::expect_same_bits(
        test::render(scene, profile, settings_with(4, smoothing), test::looking_down({0, 2, 0})),
        test::render(scene, profile, settings_with(0), test::looking_down({0, 2, 0})));
  }
}

// Rays of an upright wall must not depend on how its normal, (1, 0, 0), rounds. Turned by 1e-7 either way,
// the wall and all that its rays meet move by 5e-7 m at most: only rays that pass an edge as closely can
// change. Were the wall's frame another one, every second ray would be.
TEST(AmbientOcclusionTest, RoundingOfAnUprightWallsNormalDoesNotChooseItsRays) {
  Scene scene = floor_beside_wall();
  scene.ambient = glm::vec3{1.0f};
  const FrameSample sample = test::sample_from({1, 0.2, 0}, test::gaze_deg(0, 0));
  const DisplayProfile profile = test::single_view(64, 64, 60, 30);
  const auto turned_by = [&](double angle_rad) {
    Scene turned = scene;
    glm::dmat4x3& m = turned.instances[1].world_from_object;
    m[0] = {std::cos(angle_rad), 0, -std::sin(angle_rad)};
    m[2] = {std::sin(angle_rad), 0, std::cos(angle_rad)};
    FrameSample to_the_left = sample;
    to_the_left.head.world_from_head.orientation =
        glm::angleAxis(glm::half_pi<double>(), glm::dvec3(0, 1, 0));
    return test::render(turned, profile, settings_with(1), to_the_left);
  };
  const RenderedFrame one = turned_by(1e-7), other = turned_by(-1e-7);
  int differ = 0, dark = 0;
  test::for_each_pixel(one.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    differ += std::abs(pixel[0] - test::pixel_at(other.viewports[0], x, y)[0]) > 0.01f ? 1 : 0;
    dark += pixel[0] < 0.1f ? 1 : 0;
  });
  EXPECT_GT(dark, 100) << "some rays meet the other surface";
  EXPECT_LE(differ, 4);
}

TEST(AmbientOcclusionTest, DirectLightIsNotOccluded) {
  Scene scene = floor_beside_wall();
  scene.lights = {test::light_at({0.5, 3, 0}, glm::vec3{2.0f})};
  const DisplayProfile profile = test::single_view(32, 32, 10, 10);
  const auto lit = [&](float ambient, int rays) {
    scene.ambient = glm::vec3{ambient};
    return test::render(scene, profile, settings_with(rays), test::looking_down({0.3, 1, 0}));
  };
  // A trace of ambient light so that the rays are traced at all: 1e-7 is nothing beside the
  // light in half precision.
  const RenderedFrame with = lit(1e-7f, 4), without = lit(1e-7f, 0);
  EXPECT_GT(with.counters.rays[RayKind::occlusion], 0);
  test::expect_same_bits(with, without);
}

TEST(AmbientOcclusionTest, WithoutIndirectLightNoRayIsTraced) {
  Scene scene = floor_beside_wall();
  scene.ambient = glm::vec3{0.0f};
  const RenderedFrame frame =
      test::render(scene, test::small_profile(), settings_with(4), test::looking_down({0.3, 1, 0}));
  EXPECT_EQ(frame.counters.rays[RayKind::occlusion], 0);
  EXPECT_EQ(frame.times[Stage::occlusion], 0.0);
}

TEST(AmbientOcclusionTest, AVirtualObjectDarkensTheFeedOnACatcherAndARealWallDoesNot) {
  // A catcher floor, half a metre of virtual box on it, and a real wall elsewhere. Next to the box the feed
  // is multiplied by less than 1; next to the real wall, which the feed shows already, by exactly 1.
  Scene scene;
  test::add(scene, test::floor_quad(20), test::matte(glm::vec3{0.5f}), true);
  test::add(scene, test::quad({-2, 0, 20}, {0, 0, -40}, {0, 5, 0}), test::matte(glm::vec3{0.5f}), true);
  test::add(scene, test::box({0, 0, -1}, {0.5f, 0.5f, 1}), test::matte(glm::vec3{0.5f}));
  scene.ambient = glm::vec3{1.0f};
  FrameSample sample = test::looking_down({-0.75, 3, 0});
  const auto camera = test::TestCamera::pinhole(64, 64, 60, [](int, int) {
    return std::array<std::uint16_t, 4>{0x3800, 0x3800, 0x3800, 0x3c00};  // 0.5
  });
  camera.attach_to(sample);
  const DisplayProfile profile = test::single_view(256, 16, 25, 2);
  const RenderedFrame frame = test::render(scene, profile, settings_with(16), sample);
  int beside_box = 0, beside_wall = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    const double floor_x = -0.75 + 3 * d.x / -d.z;
    if (floor_x > -0.1 && floor_x < -0.02) {
      ++beside_box;
      ASSERT_LT(pixel[0], 0.47)
          << floor_x;  // at 0.1 m of 0.5 m: 1 - 0.37 = 0.63 of the feed at most, noise aside
    }
    if (floor_x > -1.98 && floor_x < -1.0) {
      ++beside_wall;
      ASSERT_EQ(pixel[0], 0.5) << floor_x;
    }
  });
  EXPECT_GT(beside_box, 100);
  EXPECT_GT(beside_wall, 1000);
  EXPECT_GT(frame.counters.rays[RayKind::catcher_occlusion], 0);
}

}  // namespace
}  // namespace herr
