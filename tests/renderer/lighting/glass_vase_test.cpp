// A vase of thin clear glass: no light is lost in it, and what it shows is what a slow tracer shows that
// follows every branch of the light.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/renderer/lighting/clear_glass.h"
#include "tests/renderer/lighting/slow_glass.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// Profile of the vase, radius and height in metres: up the outer wall, over the rim, and down the inner wall,
// 3 mm of glass between them; a solid foot of 12 mm.
std::vector<glm::dvec2> vase_profile() {
  constexpr double kWall = 0.003, kHeight = 0.24, kFoot = 0.012;
  const auto radius = [](double y) { return 0.045 + 0.02 * std::sin(22 * y - 0.6) + 0.04 * y; };
  std::vector<glm::dvec2> points{{0, 0}};
  for (const double share : {0.5, 0.9}) points.push_back({share * radius(0), 0});
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    const double y = kHeight * i / kSteps;
    points.push_back({radius(y), y});
  }
  for (int i = 1; i < 8; ++i) {
    const double a = glm::pi<double>() * i / 8;  // half a circle over the wall
    points.push_back(
        {radius(kHeight) - kWall / 2 + kWall / 2 * std::cos(a), kHeight + kWall / 2 * std::sin(a)});
  }
  for (int i = kSteps; i >= 0; --i) {
    const double y = kFoot + (kHeight - kFoot) * i / kSteps;
    points.push_back({radius(y) - kWall, y});
  }
  points.push_back({0.5 * (radius(kFoot) - kWall), kFoot});
  points.push_back({0, kFoot});
  return points;
}

// Turned about the y axis; normals are smooth but where the profile has a corner.
TriangleMesh turned(const std::vector<glm::dvec2>& profile, int sectors) {
  TriangleMesh mesh;
  const auto normal_of = [&](std::size_t segment) {
    const glm::dvec2 along = glm::normalize(profile[segment + 1] - profile[segment]);
    return glm::dvec2{along.y, -along.x};
  };
  const std::size_t segments = profile.size() - 1;
  const auto normal_at = [&](std::size_t segment, bool end) {
    const glm::dvec2 own = normal_of(segment);
    const std::size_t other = end ? segment + 1 : segment - 1;
    if (other >= segments) return own;
    const glm::dvec2 mean = own + normal_of(other);
    return glm::dot(own, normal_of(other)) < 0.8 ? own : glm::normalize(mean);
  };
  for (std::size_t s = 0; s < segments; ++s) {
    for (int j = 0; j < sectors; ++j) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const int corner : {0, 1, 2, 3}) {
        const bool end = corner == 2 || corner == 3;
        const double turn = glm::two_pi<double>() * (j + (corner == 1 || corner == 2)) / sectors;
        const glm::dvec2 p = profile[end ? s + 1 : s], n = normal_at(s, end);
        const glm::dvec3 out{std::cos(turn), 0, -std::sin(turn)};
        mesh.positions.push_back(p.x * out + glm::dvec3{0, p.y, 0});
        mesh.normals.push_back(n.x * out + glm::dvec3{0, n.y, 0});
        mesh.uvs.push_back({0, 0});
      }
      // At the axis one of two triangles has no area.
      if (profile[s].x > 0) mesh.triangles.push_back({first, first + 1, first + 2});
      if (profile[s + 1].x > 0) mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return mesh;
}

// From 0.6 m. Above the rim and looking down, so that foot, walls, rim and the inside are seen; or level.
FrameSample view_of_vase(bool level) {
  FrameSample sample = test::sample_from({0, level ? 0.12 : 0.29, 0.6});
  sample.head.world_from_head.orientation = glm::angleAxis(level ? 0 : -0.27, glm::dvec3{1, 0, 0});
  return sample;
}

struct VaseScene {
  TriangleMesh mesh = turned(vase_profile(), 64);
  Scene scene;
  DisplayProfile profile;
  FrameSample view;

  VaseScene(int side, bool level)
      : profile(test::single_view(side, side, 14, 14)), view(view_of_vase(level)) {
    test::add(scene, mesh, test::clear_glass());
  }
  RenderedFrame render() const { return test::render(scene, profile, test::planar_settings(), view); }
  // Calls visit(pixel, origin, direction) for pixels that see the vase.
  template <typename Tracer, typename Visit>
  int each_pixel(const RenderedFrame& frame, const Tracer& tracer, const Visit& visit) const {
    const Pose head = view.head.world_from_head;
    int seen = 0;
    test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
      const glm::dvec3 d = head.orientation * test::direction_of_pixel(profile.viewports[0], x, y);
      if (!tracer.meets(head.position, d)) return;
      ++seen;
      visit(pixel, head.position, d);
    });
    return seen;
  }
};

TEST(GlassVaseTest, InAUniformSurroundingItCannotBeSeen) {
  // Clear glass loses no light: where all directions bring 1, every path brings 1.
  VaseScene vase(128, false);
  vase.scene.environment = glm::vec3{1.0f};
  const RenderedFrame frame = vase.render();
  test::expect_finite(frame);
  const auto outside = [](const glm::dvec3&) { return glm::dvec3{1.0}; };
  const test::SlowGlass tracer(vase.mesh, test::kGlassIndex, outside);
  int off = 0;
  double least = 9, most = 0;
  const int seen = vase.each_pixel(frame, tracer, [&](const test::Pixel& pixel, const auto&, const auto&) {
    off += std::abs(pixel[0] - 1) > 0.03;
    least = std::min(least, pixel[0]), most = std::max(most, pixel[0]);
  });
  std::cout << seen << " pixels, " << least << " ... " << most << ", "
            << frame.counters.rays[RayKind::refraction] << " rays, " << frame.counters.cut_paths << " cut\n";
  EXPECT_GT(seen, 3000);
  EXPECT_LE(off, seen / 100);
  EXPECT_GE(least, 0.8);
}

TEST(GlassVaseTest, BetweenTwoColoursItShowsWhatASlowTracerShows) {
  // Upper half one colour, lower half another; the picture's rows blend over 1/64 of the height.
  const glm::dvec3 upper{1.0, 0.6, 0.3}, lower{0.1, 0.3, 0.9};
  const auto outside = [&](const glm::dvec3& d) {
    const double row = std::acos(std::clamp(d.y, -1.0, 1.0)) / glm::pi<double>() * 64 - 0.5;
    return glm::mix(upper, lower, std::clamp(row - 31, 0.0, 1.0));
  };
  for (const bool level : {false, true}) {
    VaseScene vase(64, level);
    EnvironmentImage& image = vase.scene.environment_map;
    image = {4, 64, 0, {}};
    for (int i = 0; i < 4 * 64; ++i) {
      const glm::vec3 c(i < 2 * 64 ? upper : lower);
      image.rgba.insert(image.rgba.end(), {c.x, c.y, c.z, 1});
    }
    const test::SlowGlass tracer(vase.mesh, test::kGlassIndex, outside);
    const RenderedFrame frame = vase.render();
    double error2 = 0, power = 0, dropped = 0;
    const int seen = vase.each_pixel(
        frame, tracer, [&](const test::Pixel& pixel, const glm::dvec3& o, const glm::dvec3& d) {
          const glm::dvec3 expected = tracer.radiance(o, d, dropped);
          const glm::dvec3 difference = glm::dvec3{pixel[0], pixel[1], pixel[2]} - expected;
          error2 += glm::dot(difference, difference), power += glm::dot(expected, expected);
        });
    std::cout << seen << " pixels, off by " << 100 * std::sqrt(error2 / power)
              << " % RMS, the slow tracer dropped " << 100 * dropped / seen << " %, "
              << frame.counters.rays[RayKind::refraction] << " rays, " << frame.counters.cut_paths
              << " cut\n";
    EXPECT_GT(seen, 800);
    EXPECT_LT(dropped / seen, 0.01);
    EXPECT_LT(std::sqrt(error2 / power), 0.05) << (level ? "level" : "from above");
  }
}

}  // namespace
}  // namespace herr
