// Surfaces that absorb nothing, where light of radiance 1 comes from everywhere, show 1 at every angle; and
// what a body absorbs follows Beer and Lambert.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/numerics/exact_answer.h"
#include "tests/renderer/half_pixels.h"
#include "tests/renderer/lighting/clear_glass.h"
#include "tests/renderer/probes/probe_scenes.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {
namespace {

constexpr double kRoughness[] = {0.0, 0.1, 0.2, 0.35, 0.6, 1.0};

// A reflection factor that fades as surfaces grow rougher.
float mirror_share(double roughness) {
  return static_cast<float>(std::max(0.35 - roughness, 0.0) / 0.35);
}

double farthest_from_one(const ViewportImage& image) {
  double worst = 0;
  for_each_pixel(image, [&](int, int, const Pixel& pixel) {
    for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(pixel[c] - 1));
  });
  return worst;
}

// The ball covers some of the picture, what surrounds it the rest: nothing of it can be seen.
double ball_in_furnace(const Material& material) {
  Scene scene;
  add(scene, sphere({0, 0, -3}, 1, 48, 96), material);
  scene.environment = scene.ambient = glm::vec3{1.0f};
  return farthest_from_one(
      render(scene, single_view(32, 32, 20, 20), planar_settings(), sample_from({0, 0, 0})).viewports[0]);
}

// By probes: light from all sides that a matte dielectric scatters, highlights and all.
double matte_furnace() {
  Scene scene;
  add(scene, sphere({0, 0, -3}, 1), matte(glm::vec3{1.0f}));
  scene.environment = glm::vec3{1.0f};
  ProbeRun run(scene, single_view(32, 32, 20, 20), probe_settings(0), sample_from({0.2, 0.3, 0}));
  run.run(4);
  return farthest_from_one(run.frame.viewports[0]);
}

double metal_furnace() {
  double worst = 0;
  Material grey = matte(glm::vec3{0.75f});
  grey.metallic = 1;
  if (ball_in_furnace(grey) < 0.2) return std::numeric_limits<double>::infinity();  // no ball is seen at all
  for (const double roughness : kRoughness) {
    Material metal = matte(glm::vec3{1.0f});
    metal.metallic = 1;
    metal.roughness = static_cast<float>(roughness);
    metal.mirror = mirror_share(roughness);
    worst = std::max(worst, ball_in_furnace(metal));
  }
  return worst;
}

double glass_furnace() {
  double worst = 0;
  for (const float index : {1.0f, kGlassIndex, 10.0f}) {
    for (const double roughness : kRoughness) {
      Material glass = clear_glass();
      glass.refractive_index = index;
      glass.roughness = static_cast<float>(roughness);
      glass.mirror = mirror_share(roughness);
      worst = std::max(worst, ball_in_furnace(glass));
    }
  }
  return worst;
}

// KHR_materials_volume: after `distance` the colour is left, after t of it colour^(t / distance). Index 1:
// nothing is reflected.
double tinted_slab() {
  Scene scene;
  Material tinted = clear_glass();
  tinted.refractive_index = 1;
  tinted.attenuation = {{0.5f, 0.8f, 0.9f}, 0.25f};
  add(scene, box({-9, -9, -2.75f}, {9, 9, -2}), tinted);
  scene.environment = glm::vec3{1.0f};
  RenderSettings settings = planar_settings();
  settings.reflections = false;
  const RenderedFrame frame =
      render(scene, single_view(3, 3, 0.001, 0.001), settings, sample_from({0, 0, 0}));
  const Pixel pixel = pixel_at(frame.viewports[0], 1, 1);
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    const double exact = std::pow(double{tinted.attenuation.colour[c]}, 3);
    worst = std::max(worst, std::abs(pixel[static_cast<std::size_t>(c)] / exact - 1));
  }
  return worst;
}

constexpr const char* kStep =
    "one step of half floats below 1; what float loses at every interface, 2^-24, adds up to far less";
constexpr ExactAnswer kFurnaceAnswers[] = {
    {"MatteFurnace", "a white matte ball in a surrounding of radiance 1, by probes", matte_furnace, 0x1p-11,
     "radiance", "one step of half floats below 1; probes keep light to 2^-14"},
    {"MetalFurnace", "white metal balls of roughness 0 ... 1 in a surrounding of radiance 1", metal_furnace,
     0x1p-11, "radiance", kStep},
    {"GlassFurnace", "clear balls of index 1, 1.5 and 10, roughness 0 ... 1, in a surrounding of radiance 1",
     glass_furnace, 0x1p-11, "radiance", kStep},
    {"TintedSlab", "light through a body thrice as deep as its attenuation distance", tinted_slab,
     0x1p-11 + 0x1p-18, "relative", "half a step of half floats, 2^-11 at most, and 64 roundings to float"},
};

}  // namespace

std::span<const ExactAnswer> furnace_answers() {
  return kFurnaceAnswers;
}

}  // namespace herr::test
