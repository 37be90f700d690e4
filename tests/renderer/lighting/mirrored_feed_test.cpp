// The camera feed in a mirror and in a glass ball: where the mirror law and Snell's law put it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <optional>

#include "tests/renderer/lighting/clear_glass.h"
#include "tests/renderer/lighting/feed_chart.h"
#include "tests/renderer/rendered_frames.h"

namespace herr {
namespace {

const glm::dvec3 kBall{-0.3, 0.05, -1};
constexpr double kBallRadius_m = 0.2, kGlass = 1.5;
// Below the eye like a table's top: it shows what is above the horizon.
const glm::dvec3 kPlate{-0.7, -0.35, -0.5}, kPlateAcross{1.4, 0, 0}, kPlateAway{0, 0, -0.95};

Material perfect_plate() {
  Material m = test::matte(glm::vec3{1.0f});
  m.metallic = 1;
  m.roughness = 0;
  m.mirror = 1;
  return m;
}

// Clear glass whose mirrored light is not followed: what leaves the ball came straight through it.
Material glass_without_mirror() {
  Material m = test::clear_glass();
  m.mirror = 0;
  m.refractive_index = static_cast<float>(kGlass);
  return m;
}

enum class Shows { nothing, ball, plate };

// A clear glass ball over a mirror plate, or one of the two.
Scene scene_of(const FrameSample& sample, bool ball, bool plate) {
  Scene scene;
  const glm::dmat4x3 place = test::world_from_eye(sample);
  if (ball) test::add_ball(scene, kBall, kBallRadius_m, glass_without_mirror(), place);
  if (plate) test::add(scene, test::quad(kPlate, kPlateAcross, kPlateAway), perfect_plate(), false, place);
  return scene;
}

// Where a ray meets the plate: within it by a share of its sides, or beyond it by that where `inside` < 0.
bool meets_plate(const test::TracedRay& ray, double inside) {
  const auto off = test::off_plane(ray, kPlate, {0, 1, 0});
  if (!off) return false;
  const glm::dvec3 at = off->origin - kPlate;
  const double across = at.x / kPlateAcross.x, away = at.z / kPlateAway.z;
  return across > inside && across < 1 - inside && away > inside && away < 1 - inside;
}

struct Seen {
  Shows what = Shows::nothing;
  test::TracedRay ray;
};

// What the eye sees in a direction by one way of light, where that is beyond doubt: not near an outline, and
// not one thing in the other.
Seen seen_along(const glm::dvec3& direction) {
  constexpr double kWithin = 0.95, kAround = 1.05, kInside = 0.02;
  const test::TracedRay eye{{0, 0, 0}, direction, 1};
  if (test::through_ball(eye, kBall, kWithin * kBallRadius_m, kGlass)) {
    const test::TracedRay ray = *test::through_ball(eye, kBall, kBallRadius_m, kGlass);
    return {meets_plate(ray, -kInside) ? Shows::nothing : Shows::ball, ray};
  }
  if (test::through_ball(eye, kBall, kAround * kBallRadius_m, kGlass) || !meets_plate(eye, kInside))
    return {};
  const test::TracedRay ray = *test::off_plane(eye, kPlate, {0, 1, 0});
  return {test::through_ball(ray, kBall, kAround * kBallRadius_m, kGlass) ? Shows::nothing : Shows::plate,
          ray};
}

// Red grows with x and green with y, by 1/64 a pixel.
test::ChartTexel by_place(int x, int y) {
  return {test::to_half(x / 64.0), test::to_half(y / 64.0), test::to_half(0.5), 0x3c00};
}

// Rays start 2^-16 of 1.2 m, 2e-5 m, off their surface. Beside the middle of the ball by b, light turns
// by 2 (asin(b / R) - asin(b / n R)), which grows with b by 23 radians a metre at 0.95 R; the camera has
// 160 pixels a radian at most: 2e-5 * 23 * 160 = 0.07 pixels.
constexpr double kRays_px = 0.07;

class MirroredFeedTest : public testing::TestWithParam<CameraModelKind> {};

TEST_P(MirroredFeedTest, MirrorsAndGlassShowTheFeedWhereTheirLawsPutIt) {
  const test::ChartCamera camera = test::chart_camera(GetParam(), by_place);
  const FrameSample sample = test::sample_with(camera);
  const DisplayProfile profile = test::single_view(180, 120, 33, 23);
  RenderSettings settings = test::planar_settings();
  settings.feed_distance_m = camera.distance_m;
  const RenderedFrame frame = test::render(scene_of(sample, true, true), profile, settings, sample);
  int balls = 0, plates = 0;
  double worst_px = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const Seen seen = seen_along(test::direction_of_pixel(profile.viewports[0], x, y));
    if (seen.what == Shows::nothing) return;
    const glm::dvec3 from_eye = test::where_feed_is_met(seen.ray, camera.distance_m);
    if (!camera.sees(from_eye, 1)) return;
    (seen.what == Shows::ball ? balls : plates) += 1;
    const glm::dvec3 expected = seen.ray.weight * camera.colour(from_eye);
    for (int c = 0; c < 2; ++c) {
      const double off = std::abs(pixel[static_cast<std::size_t>(c)] - expected[c]);
      worst_px = std::max(worst_px, 64 * (off - test::half_rounding(expected[c])));
      ASSERT_LE(off, kRays_px / 64 + test::half_rounding(expected[c]) + 1e-5) << x << ", " << y;
    }
  });
  EXPECT_GT(balls, 800);
  EXPECT_GT(plates, 600);
  std::cout << balls << " pixels of the ball, " << plates << " of the plate; off by " << worst_px
            << " camera pixels at most\n";
}

// Four corners and a middle, each a disc of its own colour; closer together for a lens of more degrees a
// pixel.
constexpr double kDisc_px = 9;
const glm::dvec2 kDiscs[5] = {{-60, -50}, {60, -50}, {-60, 50}, {60, 50}, {0, 0}};
const int kDiscColours[5][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}};

test::ChartTexel disc_at(int x, int y, double spread) {
  for (int i = 0; i < 5; ++i) {
    if (glm::distance(glm::dvec2(x - 160, y - 120), spread * kDiscs[i]) > kDisc_px) continue;
    const auto half = [&](int c) -> std::uint16_t { return kDiscColours[i][c] != 0 ? 0x3c00 : 0; };
    return {half(0), half(1), half(2), 0x3c00};
  }
  return {0, 0, 0, 0x3c00};
}

// How much of disc i a colour is: discs blend with black alone.
double share_of_disc(const glm::dvec3& rgb, int i) {
  double least = 1e9, most_other = 0;
  for (int c = 0; c < 3; ++c) {
    if (kDiscColours[i][c] != 0) least = std::min(least, rgb[c]);
    if (kDiscColours[i][c] == 0) most_other = std::max(most_other, rgb[c]);
  }
  return std::max(0.0, least - most_other);
}

struct Centroid {
  glm::dvec3 sum{0.0};
  double weight = 0;
  void add(const glm::dvec3& direction, double share) {
    sum += share * direction;
    weight += share;
  }
};

// How far the images of discs in one of the two lie from where they belong, in polar samples there.
struct DiscErrors {
  int compared = 0;
  double worst_samples = 0;
};

DiscErrors disc_errors(const test::ChartCamera& camera, Shows in) {
  const FrameSample sample = test::sample_with(camera);
  constexpr int kSide = 600, kColumns = 512, kRows = 512;
  const DisplayProfile profile = test::single_view(kSide, kSide, 33, 33);
  RenderSettings settings = test::small_settings();
  settings.polar_width = kColumns;
  settings.polar_height = kRows;
  settings.feed_distance_m = camera.distance_m;
  const RenderedFrame frame =
      test::render(scene_of(sample, in == Shows::ball, in == Shows::plate), profile, settings, sample);
  const PolarMap map = PolarMap::up_to(frame.theta_max_deg[0]);
  Centroid expected[5], shown[5];
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 direction = test::direction_of_pixel(profile.viewports[0], x, y);
    const test::TracedRay eye{{0, 0, 0}, direction, 1};
    // To the outline: an image is cut off where the thing ends, not before.
    const auto ray = in == Shows::ball ? test::through_ball(eye, kBall, kBallRadius_m, kGlass)
                                       : test::off_plane(eye, kPlate, {0, 1, 0});
    if (!ray || (in == Shows::plate && !meets_plate(eye, 0))) return;
    const glm::dvec3 from_eye = test::where_feed_is_met(*ray, camera.distance_m);
    const glm::dvec3 rgb = camera.sees(from_eye, 0) ? camera.colour(from_eye) : glm::dvec3{0.0};
    for (int i = 0; i < 5; ++i) {
      expected[i].add(direction, ray->weight * share_of_disc(rgb, i));
      shown[i].add(direction, share_of_disc({pixel[0], pixel[1], pixel[2]}, i));
    }
  });
  DiscErrors errors;
  for (int i = 0; i < 5; ++i) {
    if (expected[i].weight < 20) continue;  // pixels: not seen there
    EXPECT_NEAR(shown[i].weight / expected[i].weight, 1, 0.1) << "disc " << i;
    const glm::dvec3 there = glm::normalize(expected[i].sum), here = glm::normalize(shown[i].sum);
    const double theta = eccentricity_deg(there, {0, 0, -1});
    const double sample_deg = std::min(1 / map.radial_density(theta, kColumns),
                                       360.0 * std::sin(theta / kDegreesPerRadian) / kRows);
    const double off = eccentricity_deg(there, here) / sample_deg;
    EXPECT_LT(off, 1.0) << "disc " << i << ", samples of " << sample_deg << " degrees";
    errors.worst_samples = std::max(errors.worst_samples, off);
    ++errors.compared;
  }
  return errors;
}

TEST_P(MirroredFeedTest, TheChartsCornersAppearWithinOnePolarSampleOfWhereTheyBelong) {
  const double spread = GetParam() == CameraModelKind::pinhole ? 1 : 0.65;
  test::ChartCamera camera =
      test::chart_camera(GetParam(), [=](int x, int y) { return disc_at(x, y, spread); });
  camera.distance_m = 5;  // the ball shows what is far in its middle
  const DiscErrors ball = disc_errors(camera, Shows::ball), plate = disc_errors(camera, Shows::plate);
  EXPECT_EQ(ball.compared, 5);
  EXPECT_GE(plate.compared, 2) << "it shows what is above the horizon";
  std::cout << ball.compared << " discs in the ball, at most " << ball.worst_samples << " polar samples off; "
            << plate.compared << " in the plate, " << plate.worst_samples << "\n";
}

TEST_P(MirroredFeedTest, WhatStandsOnTheFeedOrBeyondItShowsWhatIsTwiceAsFar) {
  for (const double feed_m : {0.3, 1.0}) {
    test::ChartCamera camera = test::chart_camera(GetParam(), by_place);
    camera.distance_m = feed_m;
    const FrameSample sample = test::sample_with(camera);
    const DisplayProfile profile = test::single_view(90, 60, 33, 23);
    RenderSettings settings = test::planar_settings();
    settings.feed_distance_m = feed_m;
    const RenderedFrame frame = test::render(scene_of(sample, true, true), profile, settings, sample);
    int compared = 0;
    test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
      const Seen seen = seen_along(test::direction_of_pixel(profile.viewports[0], x, y));
      const glm::dvec3 from_eye = test::where_feed_is_met(seen.ray, feed_m);
      if (seen.what == Shows::nothing || !camera.sees(from_eye, 1)) return;
      const glm::dvec3 expected = seen.ray.weight * camera.colour(from_eye);
      ASSERT_NEAR(pixel[0], expected.x, kRays_px / 64 + test::half_rounding(expected.x) + 1e-5)
          << x << ", " << y;
      ++compared;
    });
    EXPECT_GT(compared, 800);
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, MirroredFeedTest,
                         testing::Values(CameraModelKind::pinhole, CameraModelKind::kb4),
                         [](const auto& lens) {
                           return lens.param == CameraModelKind::pinhole ? "Pinhole" : "Fisheye";
                         });

}  // namespace
}  // namespace herr
