// Metals, and dielectrics with strong highlights, as sources of indirect light: against the series of bounces
// in a closed sphere and against a path tracer in a box.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/renderer/probes/probe_scenes.h"

namespace herr {
namespace {

const DisplayProfile& view() {
  static const DisplayProfile profile = test::single_view(16, 16, 40, 40);
  return profile;
}

RenderSettings without_probes() {
  RenderSettings settings = test::planar_settings();
  settings.probes.on = false;
  return settings;
}

Material metal(const glm::vec3& colour, float metallic = 1) {
  Material material = test::matte(colour);
  material.metallic = metallic;
  return material;
}

// A dielectric of any F0: the colour factor of KHR_materials_specular multiplies 0.04.
Material shiny(float base, float f0) {
  Material material = test::matte(glm::vec3{base});
  material.specular_colour = glm::vec3{25 * f0};
  return material;
}

// As specular-glossiness says it: index 0 and the specular colour; the layer below gets what is left.
Material by_gloss(float base, float f0) {
  Material material = test::matte(glm::vec3{base});
  material.refractive_index = 0;
  material.specular_colour = glm::vec3{f0};
  return material;
}

// What probes add to the green of a view, mean over the pixels.
double indirect_green(const Scene& scene, double gained_per_bounce) {
  const FrameSample sample = test::sample_from({0, 0, 0});
  test::ProbeRun run(scene, view(), test::probe_settings(0), sample);
  run.run(static_cast<int>(6 / (1 - gained_per_bounce)));  // e^-6 is missing
  const RenderedFrame direct = test::render(scene, view(), without_probes(), sample);
  return test::mean_of(test::indirect_of_pixels(run.frame.viewports[0], direct.viewports[0], 1));
}

Scene closed_sphere(const Material& material) {
  Scene scene;
  test::add(scene, test::sphere({0, 0, 0}, 1), material);
  scene.lights = {test::light_at({0, 0, 0}, glm::vec3{1.0f})};
  scene.probes.counts = {8, 6, 8};
  return scene;
}

// Walls that send back rho of what they get: light from all sides is rho / (1 - rho) E0 / pi with
// E0 = I / R^2 = 1, and the wall that is looked at shows rho of it. Of a metal rho is its colour. Of a
// mixture it is that too, less than 0.04 of highlights apart; of a dielectric with F0 f over a base b it is
// f + (1 - f) b.
TEST(ProbeMetalTest, AClosedSphereGathersTheBouncesOfMetal) {
  for (const float rho : {0.2f, 0.5f, 0.8f}) {
    SCOPED_TRACE(testing::Message() << "albedo " << rho);
    const double expected = rho * rho / (1 - rho) / glm::pi<double>();
    EXPECT_NEAR(indirect_green(closed_sphere(metal(glm::vec3{rho})), rho), expected, 0.02 * expected);
    if (rho > 0.6f) continue;  // many bounces take long
    EXPECT_NEAR(indirect_green(closed_sphere(shiny(0, rho)), rho), expected, 0.02 * expected);
    EXPECT_NEAR(indirect_green(closed_sphere(by_gloss(0, rho)), rho), expected, 0.02 * expected);
    // Half of the mixture is a dielectric, whose highlights add 0.04 (1 - rho) to what is seen of it.
    const double seen = rho + 0.5 * 0.04 * (1 - rho);
    const double mixed = expected * seen / rho;
    EXPECT_NEAR(indirect_green(closed_sphere(metal(glm::vec3{rho}, 0.5f)), rho), mixed, 0.02 * mixed);
  }
  const double rho = 0.2 + 0.8 * 0.3, expected = rho * rho / (1 - rho) / glm::pi<double>();
  EXPECT_NEAR(indirect_green(closed_sphere(shiny(0.3f, 0.2f)), rho), expected, 0.02 * expected);
  EXPECT_NEAR(indirect_green(closed_sphere(by_gloss(0.3f, 0.2f)), rho), expected, 0.02 * expected);
}

// A room of six sides, its wall at -x of another colour; a lamp hangs in it.
constexpr glm::dvec3 kLower{-2, -1.25, -2.5}, kUpper{2, 1.25, 2.5}, kLamp{-0.2, -0.4, 0.3};
constexpr double kGrey = 0.2, kIntensity = 4;
const glm::vec3 kRed{0.8f, 0.05f, 0.05f};

Scene room_with(const Material& wall) {
  const glm::vec3 a(kLower), s(kUpper - kLower);
  const glm::vec3 x{s.x, 0, 0}, y{0, s.y, 0}, z{0, 0, s.z};
  Material grey = test::matte(glm::vec3{static_cast<float>(kGrey)});
  grey.specular = 0;
  Scene scene;
  test::add(scene, test::quad(a, y, z), wall);
  test::add(scene, test::quad(a + x, z, y), grey);
  test::add(scene, test::quad(a, z, x), grey);
  test::add(scene, test::quad(a + y, x, z), grey);
  test::add(scene, test::quad(a, x, y), grey);
  test::add(scene, test::quad(a + z, y, x), grey);
  scene.lights = {test::light_at(kLamp, glm::vec3{static_cast<float>(kIntensity)})};
  scene.probes.counts = {12, 18, 12};
  return scene;
}

// Traces paths from the floor that a camera above sees in a square of 2 * 40 degrees: the mean over its
// pixels of the light from all sides, without the lamp's own. The room is convex: nothing hides the lamp.
glm::dvec3 traced_light_on_floor(const glm::dvec3& eye) {
  std::mt19937 random(7);
  const auto unit = [&] { return std::uniform_real_distribution<>(0, 1)(random); };
  glm::dvec3 sum{0.0};
  constexpr int kPaths = 200'000, kBounces = 6;
  const double half = std::tan(glm::radians(40.0)), height = eye.y - kLower.y;
  for (int path = 0; path < kPaths; ++path) {
    glm::dvec3 at{eye.x + height * half * (2 * unit() - 1), kLower.y,
                  eye.z + height * half * (2 * unit() - 1)};
    glm::dvec3 normal{0, 1, 0}, share{1.0};
    for (int bounce = 0; bounce < kBounces; ++bounce) {
      // A direction with the density cos / pi: a point on the unit sphere about the normal's tip.
      const double z = 2 * unit() - 1, phi = glm::two_pi<double>() * unit(), r = std::sqrt(1 - z * z);
      const glm::dvec3 way = glm::normalize(normal + glm::dvec3{r * std::cos(phi), r * std::sin(phi), z});
      double nearest = 1e9;
      glm::dvec3 of_nearest{0.0};
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(way[axis]) < 1e-12) continue;
        const double t = ((way[axis] > 0 ? kUpper : kLower)[axis] - at[axis]) / way[axis];
        if (t >= nearest) continue;
        nearest = t;
        of_nearest = glm::dvec3{0.0};
        of_nearest[axis] = way[axis] > 0 ? -1 : 1;
      }
      at += nearest * way;
      normal = of_nearest;
      share *= normal.x > 0 ? glm::dvec3(kRed) : glm::dvec3{kGrey};
      const glm::dvec3 to_lamp = kLamp - at;
      const double d2 = glm::dot(to_lamp, to_lamp);
      sum += share * (kIntensity * glm::dot(normal, to_lamp) / (d2 * std::sqrt(d2)) / glm::pi<double>());
    }
  }
  return sum / double{kPaths};
}

// Beside the wall light is reddish: a red metal colours it as a red matte wall does, and so does red glass,
// at which rays of probes end.
TEST(ProbeMetalTest, ARedMetalWallColoursTheFloorBesideIt) {
  const glm::dvec3 eye{-0.7, -0.3, 0};
  const glm::dvec3 expected = traced_light_on_floor(eye);
  Material matte_red = test::matte(kRed);
  matte_red.specular = 0;
  Material red_glass = matte_red;
  red_glass.transmission = 1;
  for (const Material& wall : {matte_red, metal(kRed), red_glass}) {
    SCOPED_TRACE(testing::Message() << "metallic " << wall.metallic << ", glass " << wall.transmission);
    const Scene scene = room_with(wall);
    const FrameSample sample = test::looking_down(eye);
    test::ProbeRun run(scene, view(), test::probe_settings(0.1), sample);
    run.run(60);
    const RenderedFrame direct = test::render(scene, view(), without_probes(), sample);
    glm::dvec3 sum{0.0};
    const auto add = [&](const ViewportImage& image, double sign) {
      test::for_each_pixel(image, [&](int, int, const test::Pixel& pixel) {
        sum += sign * glm::dvec3{pixel[0], pixel[1], pixel[2]};
      });
    };
    add(run.frame.viewports[0], 1), add(direct.viewports[0], -1);
    const glm::dvec3 light = sum / (16.0 * 16.0 * kGrey);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(light[channel], expected[channel], 0.02 * expected[channel]) << channel;
    }
  }
}

}  // namespace
}  // namespace herr
