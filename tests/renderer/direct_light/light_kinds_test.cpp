// Spots, suns, lights with an end, and pictures of the environment, against their formulae.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/direct_light/scalar_light.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kEyeHeight_m = 2.0;

struct FloorView {
  Scene scene;
  DisplayProfile profile = test::single_view(64, 64, 45, 45);

  explicit FloorView(const AreaLight& light) {
    test::add(scene, test::floor_quad(50), test::matte(glm::vec3{0.5f}));
    scene.lights = {light};
  }
  // Calls check(point on the floor, radiance, to the viewer) for each pixel.
  template <typename Check>
  RenderedFrame each(const Check& check) const {
    const RenderedFrame frame =
        test::render(scene, profile, test::planar_settings(), test::looking_down({0, kEyeHeight_m, 0}));
    test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
      const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
      const glm::dvec3 world{d.x, d.z, -d.y};
      check(glm::dvec3{0, kEyeHeight_m, 0} + (kEyeHeight_m / -world.y) * world, pixel[0], -world);
    });
    return frame;
  }
};

double slack(double value) {
  return 2e-4 * value + test::half_rounding(value) + 1e-6;
}

TEST(LightKindsTest, ASpotFadesFromItsInnerToItsOuterConeSquared) {
  AreaLight spot = test::light_at({0.3, 1.5, 0}, glm::vec3{3.0f});
  spot.kind = LightKind::spot;
  spot.direction = glm::normalize(glm::dvec3{0.2, -1, 0.1});
  spot.inner_cone_rad = 10 / kDegreesPerRadian;
  spot.outer_cone_rad = 30 / kDegreesPerRadian;
  const FloorView view(spot);
  const Material& floor = view.scene.materials[0];
  int bright = 0, fading = 0, dark = 0;
  view.each([&](const glm::dvec3& at, double radiance, const glm::dvec3& to_viewer) {
    const double cosine = glm::dot(glm::normalize(at - spot.centre), spot.direction);
    const double inner = std::cos(spot.inner_cone_rad), outer = std::cos(spot.outer_cone_rad);
    const double cone = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    const double expected =
        cone * cone *
        test::radiance_from(floor, {at, {0, 1, 0}, to_viewer}, spot.centre, glm::dvec3{3.0}, 1e-6).x;
    (cone == 1 ? bright : cone == 0 ? dark : fading) += 1;
    // Near the outer cone the square's slope amplifies rounding of the cosine: 2 cone * 6e-8 / 0.12.
    ASSERT_NEAR(radiance, expected, slack(expected)) << at.x << ", " << at.z;
  });
  EXPECT_GT(bright, 20);
  EXPECT_GT(fading, 200);
  EXPECT_GT(dark, 1000);
}

TEST(LightKindsTest, ASunIsEquallyBrightEverywhereAndItsShadowsAreParallel) {
  AreaLight sun = test::light_at({0, 0, 0}, glm::vec3{2.0f});
  sun.kind = LightKind::sun;
  sun.direction = glm::normalize(glm::dvec3{1, -2, 0});
  FloorView view(sun);
  // A plate 1 m above the floor, x in [-0.5, 0.5]: its shadow is moved by +0.5 m in x.
  test::add(view.scene, test::quad({-0.5f, 1, 40}, {1, 0, 0}, {0, 0, -80}), test::matte(glm::vec3{0.0f}));
  const Material& floor = view.scene.materials[0];
  int lit = 0;
  view.each([&](const glm::dvec3& at, double radiance, const glm::dvec3& to_viewer) {
    if (std::abs(at.x) < 1.001)
      return;  // the plate covers |x| < 1 of the floor, seen from 2 m; its shadow lies there
    const glm::dvec3 to_sun = -sun.direction;
    const double expected = test::brdf(floor, {at, {0, 1, 0}, to_viewer}, to_sun).x * 2 * to_sun.y;
    ++lit;
    ASSERT_NEAR(radiance, expected, slack(expected)) << at.x << ", " << at.z;
  });
  EXPECT_GT(lit, 1000);

  // The shadow itself, seen from a place beside it.
  const RenderedFrame beside = test::render(view.scene, test::single_view(3, 3, 0.1, 0.1),
                                            test::planar_settings(), test::looking_down({0.9, 0.5, 0}));
  EXPECT_EQ(test::pixel_at(beside.viewports[0], 1, 1)[0], 0.0);
  const RenderedFrame outside = test::render(view.scene, test::single_view(3, 3, 0.1, 0.1),
                                             test::planar_settings(), test::looking_down({1.1, 0.5, 0}));
  EXPECT_GT(test::pixel_at(outside.viewports[0], 1, 1)[0], 0.1);
}

TEST(LightKindsTest, ALightEndsAtItsRange) {
  AreaLight light = test::light_at({0, 1, 0}, glm::vec3{3.0f});
  light.range_m = 1.5;
  const FloorView view(light);
  const Material& floor = view.scene.materials[0];
  int beyond = 0;
  view.each([&](const glm::dvec3& at, double radiance, const glm::dvec3& to_viewer) {
    const double d = glm::length(at - light.centre);
    const double window = std::max(0.0, 1 - std::pow(d / 1.5, 4));
    const double expected =
        window *
        test::radiance_from(floor, {at, {0, 1, 0}, to_viewer}, light.centre, glm::dvec3{3.0}, 1e-6).x;
    beyond += window == 0;
    ASSERT_NEAR(radiance, expected, slack(expected)) << d;
  });
  EXPECT_GT(beyond, 500);
}

TEST(LightKindsTest, APointLightTracesOneRayHoweverManySamplesAreAskedFor) {
  FloorView view(test::light_at({0, 1, 0}, glm::vec3{3.0f}));
  RenderSettings settings = test::planar_settings();
  settings.light_samples = 64;
  const RenderedFrame frame =
      test::render(view.scene, view.profile, settings, test::looking_down({0, kEyeHeight_m, 0}));
  EXPECT_EQ(frame.counters.rays[RayKind::shadow], 64 * 64);
}

// A picture of 8 x 4 pixels, each of its own colour.
EnvironmentImage small_environment() {
  EnvironmentImage image{8, 4, 0, std::vector<float>(4 * 8 * 4)};
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      float* texel = &image.rgba[static_cast<std::size_t>(4 * (8 * y + x))];
      texel[0] = static_cast<float>(x), texel[1] = static_cast<float>(y),
      texel[2] = static_cast<float>(x + 10 * y);
    }
  }
  return image;
}

// The same bilinear look-up in double: u = 1/2 at -Z, growing clockwise seen from above; v = 0 at the zenith.
// A rotation about +Y is counter-clockwise as seen from above: the picture that was turned shows at d what it
// showed unturned at d turned back.
glm::dvec3 environment_at(const EnvironmentImage& image, const glm::dvec3& world_d) {
  const glm::dquat turned_back = glm::angleAxis(glm::radians(-double{image.turn_deg}), glm::dvec3{0, 1, 0});
  const glm::dvec3 d = turned_back * world_d;
  double u = std::atan2(d.x, -d.z) / glm::two_pi<double>() + 0.5;
  u -= std::floor(u);
  const double v = std::acos(std::clamp(d.y, -1.0, 1.0)) / glm::pi<double>();
  const double x = u * image.width_px - 0.5,
               y = std::clamp(v * image.height_px - 0.5, 0.0, image.height_px - 1.0);
  const auto texel = [&](int column, int row) {
    column = (column % image.width_px + image.width_px) % image.width_px;
    row = std::clamp(row, 0, image.height_px - 1);
    const float* t = &image.rgba[static_cast<std::size_t>(4 * (row * image.width_px + column))];
    return glm::dvec3{t[0], t[1], t[2]};
  };
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double tx = x - x0, ty = y - y0;
  return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), tx),
                  glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), tx), ty);
}

void expect_environment(const Scene& scene, const glm::dquat& head) {
  const DisplayProfile profile = test::single_view(96, 96, 60, 60);
  FrameSample sample = test::sample_from({0, 0, 0});
  sample.head.world_from_head.orientation = head;
  const RenderedFrame frame = test::render(scene, profile, test::planar_settings(), sample);
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 expected =
        environment_at(scene.environment_map, head * test::direction_of_pixel(profile.viewports[0], x, y));
    // Angles in float: 1e-6 of a turn, times 8 columns and a step of at most 31 between texels.
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(pixel[static_cast<std::size_t>(c)], expected[c],
                  5e-4 + test::half_rounding(expected[c]) * 2)
          << x << ", " << y;
    }
  });
}

TEST(EnvironmentTest, EveryDirectionShowsItsPixelAlsoAcrossTheSeamAndAtThePoles) {
  Scene scene;  // nothing but its outside
  scene.environment_map = small_environment();
  const double quarter = glm::half_pi<double>();
  for (const float turn_deg : {0.0f, 77.0f, -300.0f}) {
    scene.environment_map.turn_deg = turn_deg;
    expect_environment(scene, {1, 0, 0, 0});
    expect_environment(scene, glm::angleAxis(2 * quarter, glm::dvec3{0, 1, 0}));  // backwards: the seam
    expect_environment(scene, glm::angleAxis(quarter, glm::dvec3{1, 0, 0}));      // zenith
    expect_environment(scene, glm::angleAxis(-quarter, glm::dvec3{1, 0, 0}));     // nadir
  }
}

TEST(EnvironmentTest, TurnedByNinetyDegreesTheMiddleLiesTowardsMinusX) {
  // Seen from above with +X to the right and -Z up the page, a quarter turn counter-clockwise takes the
  // middle of the picture, unturned towards -Z, to -X; what lay towards +X comes to -Z. The look-up is not
  // used here: of 16 x 8 pixels the eight middle columns are blue, and a narrow view along an axis sees one
  // colour.
  Scene scene;
  scene.environment_map = {16, 8, 90, std::vector<float>(4 * 16 * 8)};
  for (std::size_t i = 0; i < 16 * 8; ++i)
    scene.environment_map.rgba[4 * i + (i % 16 / 4 == 1 || i % 16 / 4 == 2 ? 2 : 0)] = 1;
  struct View {
    double yaw_deg;  // counter-clockwise from -Z
    bool blue;
  };
  // Columns 4 ... 11 of 16 are blue: a half turn of them, 90 degrees to both sides of the middle at -X. Not
  // at their edges, which are -Z and +Z.
  for (const View& view :
       {View{90, true}, View{45, true}, View{135, true}, View{-90, false}, View{-45, false}}) {
    const DisplayProfile profile = test::single_view(8, 8, 5, 5);
    FrameSample sample = test::sample_from({0, 0, 0});
    sample.head.world_from_head.orientation = glm::angleAxis(glm::radians(view.yaw_deg), glm::dvec3{0, 1, 0});
    const RenderedFrame frame = test::render(scene, profile, test::planar_settings(), sample);
    test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
      ASSERT_NEAR(pixel[2], view.blue ? 1 : 0, 1e-3) << view.yaw_deg;
      ASSERT_NEAR(pixel[0], view.blue ? 0 : 1, 1e-3) << view.yaw_deg;
    });
  }
}

TEST(EnvironmentTest, AMirrorShowsIt) {
  Scene scene;
  Material mirror = test::matte(glm::vec3{1.0f});
  mirror.metallic = 1;
  mirror.roughness = 0;
  mirror.mirror = 1;
  test::add(scene, test::quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), mirror);
  scene.environment_map = small_environment();
  const DisplayProfile profile = test::single_view(32, 32, 30, 30);
  const RenderedFrame frame =
      test::render(scene, profile, test::planar_settings(), test::sample_from({0, 0, 0}));
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    d.z = -d.z;
    const glm::dvec3 expected = environment_at(scene.environment_map, d);
    ASSERT_NEAR(pixel[2], expected.z, 5e-4 + 2 * test::half_rounding(expected.z)) << x << ", " << y;
  });
}

}  // namespace
}  // namespace herr
