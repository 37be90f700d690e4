// Surfaces that absorb nothing, where light of radiance 1 comes from everywhere: whatever they reflect, pass
// and scatter, each of their points must show 1, at every angle, or light was lost or made.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/renderer/probes/probe_scenes.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kRoughness[] = {0.0, 0.1, 0.2, 0.35, 1.0};

// A reflection factor that fades as surfaces grow rougher.
float mirror_share(double roughness) {
  return static_cast<float>(std::max(0.35 - roughness, 0.0) / 0.35);
}

Material white_glass(double roughness) {
  Material m = test::matte(glm::vec3{1.0f});
  m.transmission = 1;
  m.refractive_index = 1.5f;
  m.roughness = static_cast<float>(roughness);
  m.mirror = mirror_share(roughness);
  return m;
}

Material white_metal(double roughness) {
  Material m = test::matte(glm::vec3{1.0f});
  m.metallic = 1;
  m.roughness = static_cast<float>(roughness);
  m.mirror = mirror_share(roughness);
  return m;
}

// Reflects by its roughness.
Material white_ball(double roughness, float metallic) {
  Material m = test::matte(glm::vec3{1.0f});
  m.metallic = metallic;
  m.roughness = static_cast<float>(roughness);
  return m;
}

void expect_white(const ViewportImage& image, const std::string& what) {
  double least = 10, most = 0;
  test::for_each_pixel(image, [&](int, int, const test::Pixel& pixel) {
    if (pixel[3] < 0.5f) return;  // beside the ball
    least = std::min(least, double{pixel[1]});
    most = std::max(most, double{pixel[1]});
  });
  EXPECT_GT(least, 0.99) << what;
  EXPECT_LT(most, 1.01) << what;
}

// A ball before the eye shows every angle from head on to grazing.
void expect_white(const Material& material, const std::string& what) {
  Scene scene;
  test::add(scene, test::sphere({0, 0, -3}, 1, 48, 96), material);
  scene.environment = scene.ambient = glm::vec3{1.0f};
  const RenderedFrame frame = test::render(scene, test::single_view(24, 24, 20, 20), test::planar_settings(),
                                           test::sample_from({0, 0, 0}));
  expect_white(frame.viewports[0], what);
}

TEST(WhiteFurnaceTest, GlassKeepsItsLightHoweverRough) {
  for (const double roughness : kRoughness)
    expect_white(white_glass(roughness), "roughness " + std::to_string(roughness));
}

TEST(WhiteFurnaceTest, ACoatLosesNoLightOverMetalOrGlass) {
  for (const double roughness : kRoughness) {
    for (const float coat : {0.5f, 1.0f}) {
      for (Material m : {white_glass(roughness), white_metal(roughness)}) {
        m.clearcoat.strength = coat;
        expect_white(m, "coat " + std::to_string(coat) + ", roughness " + std::to_string(roughness) +
                            (m.metallic > 0 ? ", metal" : ", glass"));
      }
    }
  }
}

TEST(WhiteFurnaceTest, SheenLosesNoLightOverMetalOrGlass) {
  for (const double roughness : {0.0, 1.0}) {
    for (Material m : {white_glass(roughness), white_metal(roughness)}) {
      m.sheen = {glm::vec3{0.8f}, 0.5f, {}, {}};
      expect_white(m, "roughness " + std::to_string(roughness) + (m.metallic > 0 ? ", metal" : ", glass"));
    }
  }
}

// Roughness by roughness, metal and dielectric: by the mirror ray, the lobe, even light, and any mixture.
TEST(WhiteFurnaceTest, SurfacesKeepTheirLightWhateverTheirRoughness) {
  for (const bool picture : {false, true}) {
    for (const double roughness : {0.0, 0.05, 0.1, 0.2, 0.25, 0.3, 0.35, 0.6, 0.8, 1.0}) {
      for (const float metallic : {0.0f, 1.0f}) {
        Scene scene;
        test::add(scene, test::sphere({0, 0, -3}, 1, 48, 96), white_ball(roughness, metallic));
        scene.environment = glm::vec3{1.0f};
        scene.probes.counts = {4, 4, 4};
        if (picture) scene.environment_map = {64, 32, 0, std::vector<float>(4 * 64 * 32, 1.0f)};
        test::ProbeRun run(scene, test::single_view(24, 24, 20, 20), test::probe_settings(0),
                           test::sample_from({0.02, 0.03, 0}));
        run.run(4);
        expect_white(run.frame.viewports[0], "roughness " + std::to_string(roughness) + ", metal " +
                                                 std::to_string(metallic) + (picture ? ", picture" : ""));
      }
    }
  }
}

TEST(WhiteFurnaceTest, ACoatLosesNoLightInAMirror) {
  // The ball stands behind the eye; a mirror shows it.
  for (Material m : {white_glass(0), white_metal(0)}) {
    m.clearcoat.strength = 1;
    Scene scene;
    test::add(scene, test::sphere({0, 0, 3}, 1, 48, 96), m);
    test::add(scene, test::quad({-9, -9, -3}, {18, 0, 0}, {0, 18, 0}), white_metal(0));
    scene.environment = scene.ambient = glm::vec3{1.0f};
    const RenderedFrame frame = test::render(scene, test::single_view(24, 24, 12, 12),
                                             test::planar_settings(), test::sample_from({0, 0, 0}));
    test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
      EXPECT_NEAR(pixel[1], 1, 0.01) << x << ", " << y;
    });
  }
}

}  // namespace
}  // namespace herr
