// Highlights of a sun and of a small lamp on a mirror ball: as bright as geometrical optics say, however few
// rays there are, and the same from frame to frame while gaze and head move.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kRadius_m = 0.12;
const glm::dvec3 kCentre{0.05, -0.03, -1.0};
const glm::dvec3 kEye{0.0};

Material mirror_metal() {
  Material material = test::matte(glm::vec3{1.0f});
  material.metallic = 1;
  material.roughness = 0;
  return material;
}

AreaLight sun() {
  AreaLight light;
  light.kind = LightKind::sun;
  light.direction = glm::normalize(glm::dvec3{-0.5, -0.6, -0.3});
  light.intensity_w_sr = glm::vec3{0.5f};
  return light;
}
// 5 cm across, two metres from the ball.
AreaLight lamp() {
  return test::light_at(kCentre + 2.0 * glm::normalize(glm::dvec3{0.4, 0.7, 0.6}), glm::vec3{2.0f},
                        glm::vec3{0.05f});
}

enum class Ball { analytic, mesh };

Scene ball_under(const AreaLight& light, Ball ball) {
  Scene scene;
  const glm::dmat4x3 place{glm::dvec3{kRadius_m, 0, 0}, glm::dvec3{0, kRadius_m, 0},
                           glm::dvec3{0, 0, kRadius_m}, kCentre};
  if (ball == Ball::mesh) {
    test::add(scene, test::sphere(glm::vec3{0.0f}, 1.0f, 48, 96), mirror_metal(), false, place);
  } else {
    test::add(scene, {}, mirror_metal(), false, place);
    scene.instances[0].kind = ShapeKind::sphere;
  }
  scene.lights = {light};
  return scene;
}

// Where a ray from the eye that is mirrored by the ball meets the light's centre, found by bisection: the
// normal lies in the plane of eye, centre and light, and halves the angle between the two ways.
glm::dvec3 mirroring_normal(const AreaLight& light) {
  const bool is_sun = light.kind == LightKind::sun;
  const glm::dvec3 a = glm::normalize(kEye - kCentre);
  const glm::dvec3 l = is_sun ? -light.direction : glm::normalize(light.centre - kCentre);
  const glm::dvec3 b = glm::normalize(l - glm::dot(l, a) * a);
  double low = 0, high = std::acos(glm::dot(a, l));
  for (int i = 0; i < 80; ++i) {
    const double mid = 0.5 * (low + high);
    const glm::dvec3 n = std::cos(mid) * a + std::sin(mid) * b;
    const glm::dvec3 p = kCentre + kRadius_m * n;
    const glm::dvec3 to_light = is_sun ? l : glm::normalize(light.centre - p);
    (glm::dot(n, glm::normalize(kEye - p)) > glm::dot(n, to_light) ? low : high) = mid;
  }
  return std::cos(low) * a + std::sin(low) * b;
}

// Irradiance at the eye of what a perfect mirror ball reflects, that is the sum of radiance x solid angle of
// the highlight. A pencil of wavefront radius q (infinite for a sun) that is reflected at the angle i has the
// focal distances 1/t = 1/q + 2 / (R cos i) along and 1/s = 1/q + 2 cos i / R across the plane of incidence
// (Coddington's equations), and thins by t s / ((d + t) (d + s)) on the way d to the eye.
double highlight_at_the_eye(const AreaLight& light) {
  const glm::dvec3 n = mirroring_normal(light), p = kCentre + kRadius_m * n;
  const double d = glm::length(kEye - p), cosine = glm::dot(n, glm::normalize(kEye - p));
  const bool is_sun = light.kind == LightKind::sun;
  const double q = is_sun ? 0 : glm::length(light.centre - p);
  const double per_q = is_sun ? 0 : 1 / q;
  const double arrives = double{light.intensity_w_sr.x} * (is_sun ? 1 : 1 / (q * q));
  const double t = 1 / (per_q + 2 / (kRadius_m * cosine)), s = 1 / (per_q + 2 * cosine / kRadius_m);
  return arrives * t * s / ((d + t) * (d + s));
}

// Sum of radiance x solid angle over a viewport: all that there is is the highlight.
double energy(const DisplayProfile& profile, const RenderedFrame& frame) {
  const Viewport& v = profile.viewports[0];
  const double step_x = (v.tan_right - v.tan_left) / v.width_px;
  const double step_y = (v.tan_up - v.tan_down) / v.height_px;
  double sum = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const double cosine = -test::direction_of_pixel(v, x, y).z;
    sum += pixel[0] * step_x * step_y * cosine * cosine * cosine;
  });
  return sum;
}

// Frame i of 90 a second: the head turns by 5 and the gaze by 2 degrees a second.
FrameSample at_frame(int i) {
  const double turn = 5.0 / 90 * i / kDegreesPerRadian, look = (2.0 / 90 * i - 1) / kDegreesPerRadian;
  FrameSample sample = test::sample_from(kEye, {std::sin(look), 0.3 * std::sin(look), -std::cos(look)});
  sample.t_ns += i * 11'111'111;
  sample.head.world_from_head.orientation = glm::angleAxis(turn, glm::normalize(glm::dvec3{0.1, 1, 0}));
  return sample;
}

void expect_steady(const AreaLight& light, Ball ball, const RenderSettings& settings) {
  const Scene scene = ball_under(light, ball);
  const DisplayProfile profile = test::single_view(300, 300, 20, 20);
  const double expected = highlight_at_the_eye(light);
  Renderer renderer(scene, profile, settings, false);
  RenderedFrame frame;
  std::vector<double> energies;
  for (int i = 0; i < 60; ++i) {
    test::render_with(renderer, scene, at_frame(i), frame);
    energies.push_back(energy(profile, frame));
    EXPECT_NEAR(energies.back(), expected, 0.03 * expected) << "frame " << i;
  }
  const auto [least, most] = std::minmax_element(energies.begin(), energies.end());
  EXPECT_LT(*most - *least, 0.05 * expected);
}

// 320 x 312 polar samples and 300 x 300 pixels: the ball is 100 pixels across.
RenderSettings foveated() {
  RenderSettings settings = test::small_settings();
  settings.polar_width = 320;
  settings.polar_height = 312;
  settings.light_samples = 4;
  return settings;
}
RenderSettings uniform() {
  RenderSettings settings = foveated();
  settings.foveation = Foveation::off;
  return settings;
}

TEST(MirrorBallTest, TheClosedFormIsWhatManyRaysShow) {
  // A sixtieth of a degree apart: highlights of the roughness that the material has, or nearly.
  const DisplayProfile profile = test::single_view(1200, 1200, 10, 10);
  for (const AreaLight& light : {sun(), lamp()}) {
    const Scene scene = ball_under(light, Ball::analytic);
    const double expected = highlight_at_the_eye(light);
    EXPECT_NEAR(energy(profile, test::render(scene, profile, uniform(), at_frame(0))), expected,
                0.01 * expected);
  }
}

TEST(MirrorBallTest, TheHighlightOfASunIsSteadyInTheFoveatedPicture) {
  expect_steady(sun(), Ball::analytic, foveated());
  expect_steady(sun(), Ball::mesh, foveated());
}
TEST(MirrorBallTest, TheHighlightOfASunIsSteadyInTheUniformPicture) {
  expect_steady(sun(), Ball::analytic, uniform());
  expect_steady(sun(), Ball::mesh, uniform());
}
TEST(MirrorBallTest, TheHighlightOfASmallLampIsSteadyInTheFoveatedPicture) {
  expect_steady(lamp(), Ball::analytic, foveated());
  expect_steady(lamp(), Ball::mesh, foveated());
}
TEST(MirrorBallTest, TheHighlightOfASmallLampIsSteadyInTheUniformPicture) {
  expect_steady(lamp(), Ball::analytic, uniform());
  expect_steady(lamp(), Ball::mesh, uniform());
}

}  // namespace
}  // namespace herr
