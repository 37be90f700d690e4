// Light through transparent surfaces against Snell's law in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// Clear glass: everything that is not reflected passes, and nothing is reflected by the
// settings of these tests.
Material glass(float refractive_index) {
  Material m = test::matte(glm::vec3{1.0f});
  m.roughness = 0;
  m.transmission = 1;
  m.refractive_index = refractive_index;
  return m;
}

RenderSettings settings() {
  RenderSettings s = test::planar_settings();
  s.reflections = false;
  return s;
}

// Fresnel's reflectance for unpolarised light that meets glass of `index` from air at an angle of `cosine`:
// the mean of sin^2(a - b) / sin^2(a + b) and tan^2(a - b) / tan^2(a + b), head on ((n - 1) / (n + 1))^2.
double fresnel(double index, double cosine) {
  const double a = std::acos(cosine), b = std::asin(std::sin(a) / index);
  if (a < 1e-6) return std::pow((index - 1) / (index + 1), 2);
  const double s = std::sin(a - b) / std::sin(a + b), p = std::tan(a - b) / std::tan(a + b);
  return 0.5 * (s * s + p * p);
}

// Where a ray from the origin along `d` meets the plane z = -5 behind a slab of thickness t that is turned
// about the y axis: beyond the slab it runs parallel to itself, shifted along the slab's normal plane by t
// (tan(a) - tan(b)) against the direction of its tangent, with sin(b) = sin(a) / n.
glm::dvec3 behind_slab(const glm::dvec3& d, const glm::dvec3& slab_normal, double thickness, double index) {
  const double cos_a = -glm::dot(d, slab_normal), sin_a = std::sqrt(1 - cos_a * cos_a);
  const double sin_b = sin_a / index, tan_b = sin_b / std::sqrt(1 - sin_b * sin_b);
  const glm::dvec3 along = sin_a > 0 ? (d + cos_a * slab_normal) / sin_a : glm::dvec3{0.0};
  // Inside the slab the ray advances t tan(b) along the slab where it would have advanced t tan(a).
  const glm::dvec3 shift = along * (thickness * (tan_b - sin_a / cos_a));
  const glm::dvec3 start = shift;  // the ray behind the slab, traced back, passes here
  return start + d * ((-5 - start.z) / d.z);
}

TEST(RefractionTest, ASlabShiftsWhatLiesBehindItAsSnellSays) {
  // A slab of 0.4 m and n = 1.5, turned by 35 degrees, between the eye and a glowing half plane
  // z = -5, x > 0.3. Each pixel is bright or dark by where its ray ends; only rays within 1e-4 m
  // of the edge may go either way.
  constexpr double kThickness = 0.4, kIndex = 1.5;
  const double turn = 35 / kDegreesPerRadian;
  Scene scene;
  const glm::dmat4x3 place(glm::rotate(glm::translate(glm::dmat4{1.0}, {0, 0, -2}), turn, {0, 1, 0}));
  test::add(scene, test::box({-3, -3, -0.2f}, {3, 3, 0.2f}), glass(kIndex), false, place);
  test::add(scene, test::quad({0.3f, -9, -5}, {9, 0, 0}, {0, 18, 0}), test::glowing({1, 1, 1}));
  constexpr int kSide = 1201;
  const DisplayProfile profile = test::single_view(kSide, 3, 8, 0.02);
  const RenderedFrame frame = test::render(scene, profile, settings(), test::sample_from({0, 0, 0}));
  const glm::dvec3 normal{std::sin(turn), 0, std::cos(turn)};
  int bright = 0, dark = 0, near_edge = 0;
  double narrowest = 1;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    const double off_edge = behind_slab(d, normal, kThickness, kIndex).x - 0.3;
    narrowest = std::min(narrowest, std::abs(off_edge));
    if (std::abs(off_edge) < 1e-4) {
      ++near_edge;
      return;
    }
    // Two interfaces, each passing 1 - F at 35 degrees less the pixel's angle: never below 0.9 here.
    const double cosine = -glm::dot(d, normal);
    const double inside = std::sqrt(1 - (1 - cosine * cosine) / (kIndex * kIndex));
    const double passes = std::pow(1 - fresnel(kIndex, cosine), 2);
    ASSERT_GT(inside, 0.8);
    if (off_edge > 0) {
      ++bright;
      ASSERT_NEAR(pixel[0], passes, 1e-4 + test::half_rounding(passes)) << x << " off " << off_edge;
    } else {
      ++dark;
      ASSERT_EQ(pixel[0], 0.0) << x << " off " << off_edge;
    }
  });
  std::cout << bright << " bright, " << dark << " dark, the nearest " << narrowest << " m from the edge\n";
  EXPECT_GT(bright, 700);
  EXPECT_GT(dark, 1000);
  // A pixel is 5 * 2 tan(8 deg) / 1201 = 1.2 mm wide at the edge: at most one column of
  // three lies within 0.1 mm.
  EXPECT_LE(near_edge, 3);
  EXPECT_LT(narrowest, 1.2e-3);
}

// A prism of 45 degrees, its hypotenuse behind: a ray along -Z enters head on, meets the hypotenuse at 45
// degrees. Above n = sqrt(2) it is reflected totally and leaves sideways (+x), below it goes on.
TriangleMesh prism() {
  // Corners (-1, z = 0), (1, z = 0), (-1, z = -2) by y in [-1, 1]; faces counter-clockwise from outside.
  TriangleMesh mesh;
  const auto face = [&](std::initializer_list<glm::vec3> corners) {
    const std::vector<glm::vec3> c(corners);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 n = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    for (const glm::vec3& corner : c)
      mesh.positions.push_back(corner), mesh.normals.push_back(n), mesh.uvs.push_back({0, 0});
    for (std::uint32_t i = 2; i < c.size(); ++i) mesh.triangles.push_back({first, first + i - 1, first + i});
  };
  face({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});      // towards the eye
  face({{1, -1, 0}, {-1, -1, -2}, {-1, 1, -2}, {1, 1, 0}});    // hypotenuse
  face({{-1, -1, -2}, {-1, -1, 0}, {-1, 1, 0}, {-1, 1, -2}});  // left, towards -x
  face({{-1, 1, 0}, {1, 1, 0}, {-1, 1, -2}});                  // top
  face({{-1, -1, 0}, {-1, -1, -2}, {1, -1, 0}});               // bottom
  return mesh;
}

double seen_through_prism(float index) {
  Scene scene;
  test::add(scene, prism(), glass(index));
  // Total reflection sends the ray towards -x, where a wall glows with 2; what passes
  // the hypotenuse sees 0.5.
  test::add(scene, test::quad({-4, -9, 0}, {0, 0, -2}, {0, 18, 0}), test::glowing({2, 2, 2}));
  scene.environment = glm::vec3{0.5f};
  const RenderedFrame frame =
      test::render(scene, test::single_view(3, 3, 0.5, 0.5), settings(), test::sample_from({0, 0, 3}));
  return test::pixel_at(frame.viewports[0], 1, 1)[0];
}

TEST(RefractionTest, LightIsReflectedTotallyAboveTheCriticalIndex) {
  // In head on, reflected totally, out head on: (1 - F0)^2 of the wall's 2.
  for (const float index : {1.42f, 1.5f, 2.4f}) {
    const double passes = 1 - fresnel(index, 1);
    EXPECT_NEAR(seen_through_prism(index), 2 * passes * passes, 2e-4 + test::half_rounding(2)) << index;
  }
  // Near the critical index Fresnel's curve is steep (d cos / d index = 9 at 1.41), so 1e-4 needs exact
  // normals. Below: in head on, out at 45 degrees inside, sin b = n sin 45; the way back reflects as much.
  for (const float index : {1.1f, 1.3f, 1.41f}) {
    const double outside = std::sqrt(1 - 0.5 * index * index);
    const double passes = (1 - fresnel(index, 1)) * (1 - fresnel(index, outside));
    EXPECT_NEAR(seen_through_prism(index), 0.5 * passes, 1e-4 + test::half_rounding(0.5)) << index;
  }
}

TEST(RefractionTest, GlassOfIndexOneIsNotThere) {
  // n = 1: no bend, no reflection. Only the offset of the ray's start moves it, by 2^-16 of metres.
  const auto view = [](bool with_glass) {
    Scene scene;
    if (with_glass) test::add(scene, test::sphere({0, 0, -3}, 1), glass(1.0f));
    test::add(scene, test::quad({-1.75f, -9, -7}, {2, 0, 0}, {0, 18, 0}), test::glowing({1, 0.5f, 0.25f}));
    scene.environment = glm::vec3{0.125f};
    return test::render(scene, test::single_view(64, 64, 20, 20), settings(), test::sample_from({0, 0, 0}));
  };
  const RenderedFrame with = view(true), without = view(false);
  int different = 0;
  test::for_each_pixel(with.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    different += std::abs(pixel[0] - test::pixel_at(without.viewports[0], x, y)[0]) > 2e-3;
  });
  EXPECT_EQ(different, 0);
}

TEST(RefractionTest, ATintIsMultipliedAtEachInterface) {
  Scene scene;
  Material tinted = glass(1.0f);
  tinted.base_colour = {0.5f, 0.8f, 1.0f};
  test::add(scene, test::box({-2, -2, -3}, {2, 2, -2}), tinted);
  scene.environment = glm::vec3{1.0f};
  const RenderedFrame frame =
      test::render(scene, test::single_view(3, 3, 1, 1), settings(), test::sample_from({0, 0, 0}));
  const test::Pixel pixel = test::pixel_at(frame.viewports[0], 1, 1);
  EXPECT_NEAR(pixel[0], 0.25, 1e-3);
  EXPECT_NEAR(pixel[1], 0.64, 1e-3);
  EXPECT_NEAR(pixel[2], 1.0, 1e-3);
}

TEST(RefractionTest, APathEndsAfterTheMostInterfacesAndBringsTheLightFromOutside) {
  // Panes of 2 interfaces each, more than light is followed through: beyond the last ray the glass ahead is
  // as if it were not there, so that each ray has lost 1 - F at all interfaces that it passed.
  constexpr int kPanes = kMostInterfaces / 2 + 2;
  Scene scene;
  for (int i = 0; i < kPanes; ++i) {
    const float z = -2.0f - static_cast<float>(i);
    test::add(scene, test::box({-9, -9, z - 0.1f}, {9, 9, z}), glass(1.5f));
  }
  scene.environment = glm::vec3{1.0f};
  const RenderedFrame frame =
      test::render(scene, test::single_view(3, 3, 0.1, 0.1), settings(), test::sample_from({0, 0, 0}));
  test::expect_finite(frame);
  EXPECT_EQ(frame.counters.rays[RayKind::refraction], kMostInterfaces * 9);
  EXPECT_EQ(frame.counters.cut_paths, 9);
  // The last ray meets one interface more, passes it by its share, and brings 1.
  const double expected = std::pow(1 - fresnel(1.5, 1), kMostInterfaces + 1);
  EXPECT_NEAR(test::pixel_at(frame.viewports[0], 1, 1)[0], expected, 1e-4 + test::half_rounding(expected));
}

TEST(RefractionTest, SwitchedOffGlassIsDrawnOpaqueAndNoRayIsTraced) {
  Scene scene;
  test::add(scene, test::box({-9, -9, -3}, {9, 9, -2}), glass(1.5f));
  scene.ambient = glm::vec3{0.5f};
  RenderSettings off = settings();
  off.refraction = false;
  const RenderedFrame frame =
      test::render(scene, test::single_view(8, 8, 20, 20), off, test::sample_from({0, 0, 0}));
  EXPECT_EQ(frame.counters.rays[RayKind::refraction], 0);
  EXPECT_NEAR(test::pixel_at(frame.viewports[0], 4, 4)[0], 0.5 * 1.04, 1e-3);
}

TEST(RefractionTest, AMirrorAndItsGlassShareTheLight) {
  // A pane with reflection on, all of one environment: what one face reflects the other passes or reflects
  // again, and all of it leaves at last.
  Scene scene;
  Material pane = glass(1.5f);
  pane.mirror = 1;
  test::add(scene, test::box({-9, -9, -3}, {9, 9, -2}), pane);
  scene.environment = glm::vec3{1.0f};
  RenderSettings both = settings();
  both.reflections = true;
  for (const double half_deg : {0.1, 75.0}) {
    const RenderedFrame frame =
        test::render(scene, test::single_view(3, 3, half_deg, half_deg), both, test::sample_from({0, 0, 0}));
    for (const int at : {0, 1}) {
      EXPECT_NEAR(test::pixel_at(frame.viewports[0], at, at)[0], 1.0, 1e-3) << half_deg;
    }
  }
}

TEST(RefractionTest, AnIndexOfNothingReflectsAll) {
  // KHR_materials_ior: index 0 stands for a reflectance of 1 at every angle. No light passes, and no number
  // of the way through is needed.
  Scene scene;
  Material mirror = glass(0.0f);
  mirror.mirror = 1;
  test::add(scene, test::sphere({0, 0, -3}, 1), mirror);
  scene.environment = glm::vec3{0.75f};
  RenderSettings both = settings();
  both.reflections = true;
  const RenderedFrame frame =
      test::render(scene, test::single_view(32, 32, 20, 20), both, test::sample_from({0, 0, 0}));
  test::expect_finite(frame);
  EXPECT_EQ(frame.counters.rays[RayKind::refraction], 0);
  EXPECT_EQ(frame.counters.invalid_rays, 0);
  test::for_each_pixel(frame.viewports[0], [](int x, int y, const test::Pixel& pixel) {
    ASSERT_NEAR(pixel[0], 0.75, test::half_rounding(0.75)) << x << ", " << y;
  });
}

}  // namespace
}  // namespace herr
