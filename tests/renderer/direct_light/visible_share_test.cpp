// What is seen of a lamp past screens and bars, in the mean of many frames, against a quadrature in double:
// of all samples and of adaptive ones, on a matte floor and on a real one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "tests/renderer/penumbra_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

using test::kEdgeHeight_m;
using test::kEyeHeight_m;

// Bands at the height of the edge that block the light, without end across `axis` (0: x, 2: z).
struct Bands {
  std::string name;
  int axis = 0;
  std::vector<std::array<double, 2>> blocked;
};
const std::vector<Bands>& all_bands() {
  static const std::vector<Bands> bands = [] {
    std::vector<Bands> out{{"screen on -x", 0, {{-50, 0}}}, {"screen on +x", 0, {{0, 50}}},
                           {"screen on -z", 2, {{-50, 0}}}, {"screen on +z", 2, {{0, 50}}},
                           {"bars along z", 0, {}},         {"bars along x", 2, {}}};
    for (std::size_t i = 4; i < 6; ++i)  // 3 cm wide, 30 cm apart
      for (int k = -8; k <= 8; ++k) out[i].blocked.push_back({0.3 * k - 0.015, 0.3 * k + 0.015});
    return out;
  }();
  return bands;
}

Scene scene_of(const Bands& bands, const glm::vec3& lamp_size, bool real_floor) {
  Scene scene;
  test::add(scene, test::floor_quad(50), test::matte(glm::vec3{0.8f}), real_floor);
  for (const auto& [from, to] : bands.blocked) {
    const auto a = static_cast<float>(from), width = static_cast<float>(to - from);
    const auto height = static_cast<float>(kEdgeHeight_m);
    test::add(scene,
              bands.axis == 0 ? test::quad({a, height, 50}, {width, 0, 0}, {0, 0, -100})
                              : test::quad({-50, height, a + width}, {100, 0, 0}, {0, 0, -width}),
              test::matte(glm::vec3{0.8f}));
  }
  scene.lights = {test::light_at({0, test::kLightHeight_m, 0}, glm::vec3{10.0f}, lamp_size)};
  return scene;
}

// Irradiance of the floor's point, by the midpoint rule; along the bands' axis cells are cut where bands cut
// them, so that visibility is exact.
double irradiance(const AreaLight& light, const glm::dvec3& point, const Bands& bands, bool past_bands) {
  constexpr int kAlong = 24, kAcross = 12;
  const int along = bands.axis, across = 2 - along;
  const glm::dvec3 size(light.size), lower = light.centre - 0.5 * size;
  const int heights = size.y > 0 ? kAcross : 1;
  double sum = 0;
  for (int j = 0; j < heights; ++j) {
    const double y = lower.y + size.y * (j + 0.5) / heights, grows = y / kEdgeHeight_m;
    for (int k = 0; k < kAcross; ++k) {
      const double there = lower[across] + size[across] * (k + 0.5) / kAcross;
      const auto add = [&](double from, double to) {
        if (to <= from) return;
        glm::dvec3 place{0, y, 0};
        place[along] = 0.5 * (from + to), place[across] = there;
        const glm::dvec3 way = place - point;
        const double d2 = glm::dot(way, way);
        sum += (to - from) / size[along] * way.y / (d2 * std::sqrt(d2));
      };
      for (int i = 0; i < kAlong; ++i) {
        double from = lower[along] + size[along] * i / kAlong;
        const double to = lower[along] + size[along] * (i + 1) / kAlong, at = point[along];
        for (const auto& [first, last] : bands.blocked) {
          if (!past_bands) break;
          const double begin = at + (first - at) * grows, end = at + (last - at) * grows;
          if (end <= from || begin >= to) continue;
          add(from, std::min(begin, to));
          from = std::max(from, std::min(end, to));
        }
        add(from, to);
      }
    }
  }
  return sum / (heights * kAcross);
}

// 0.6 m to both sides along the bands' axis.
DisplayProfile view_of(const Bands& bands) {
  DisplayProfile profile = test::penumbra_view(96, 24);
  if (bands.axis == 2) {
    const double half_deg = std::atan2(0.6, kEyeHeight_m) * kDegreesPerRadian;
    profile.viewports = {test::viewport_deg(Eye::left, 24, 96, -5, 5, -half_deg, half_deg)};
  }
  return profile;
}

std::vector<double> exact_shares(const Scene& scene, const Bands& bands, const Viewport& viewport) {
  std::vector<double> shares;
  for (int y = 0; y < viewport.height_px; ++y) {
    for (int x = 0; x < viewport.width_px; ++x) {
      const glm::dvec3 d = test::direction_of_pixel(viewport, x, y);
      const glm::dvec3 point{kEyeHeight_m * d.x / -d.z, 0, -kEyeHeight_m * d.y / -d.z};
      shares.push_back(irradiance(scene.lights[0], point, bands, true) /
                       irradiance(scene.lights[0], point, bands, false));
    }
  }
  return shares;
}

struct TenthError {
  double mean = 0, standard_error = 0;
  bool measured = false;  // some pixels see so much
};
// Of each tenth of what is seen, the error of its mean over the pixels and frames. A real floor keeps of an
// even feed what is seen of the lamp; a matte one is held against the picture without bands.
std::array<TenthError, 10> errors_by_tenth(const Bands& bands, const glm::vec3& lamp_size, int first_samples,
                                           bool real_floor, int frames, int samples) {
  constexpr double kFeed = 0.5;
  const Scene scene = scene_of(bands, lamp_size, real_floor);
  Scene open = scene;
  open.instances.resize(1);
  const DisplayProfile profile = view_of(bands);
  const std::vector<double> exact = exact_shares(scene, bands, profile.viewports[0]);
  RenderSettings settings = test::planar_settings();
  settings.light_samples = samples;
  settings.adaptive_min_samples = first_samples;
  FrameSample sample = test::penumbra_sample();
  const test::TestCamera camera = test::TestCamera::pinhole(8, 8, 100, [](int, int) {
    const std::uint16_t half = test::to_half(kFeed);
    return std::array<std::uint16_t, 4>{half, half, half, 0x3c00};
  });
  if (real_floor) camera.attach_to(sample);
  const auto render = [&](const Scene& shown) {
    RenderedFrame frame;
    Renderer renderer(shown, profile, settings, real_floor);
    test::render_with(renderer, shown, sample, frame);
    return frame;
  };
  const RenderedFrame unshadowed = render(open);
  std::array<std::vector<double>, 10> of_frames;  // the mean error of each frame
  for (int frame = 0; frame < frames; ++frame) {
    settings.seed = static_cast<std::uint32_t>(frame);
    const RenderedFrame picture = render(scene);
    const std::vector<double> seen = test::shares_of(picture.viewports[0], unshadowed.viewports[0]);
    std::array<double, 10> sum{}, count{};
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (exact[i] <= 0.001 || exact[i] >= 0.999) continue;
      const auto tenth = static_cast<std::size_t>(exact[i] * 10);
      sum.at(tenth) += seen[i] - exact[i];
      count.at(tenth) += 1;
    }
    for (std::size_t t = 0; t < 10; ++t)
      if (count.at(t) >= 24) of_frames.at(t).push_back(sum.at(t) / count.at(t));
  }
  std::array<TenthError, 10> out;
  for (std::size_t t = 0; t < 10; ++t) {
    const std::vector<double>& errors = of_frames.at(t);
    if (errors.empty()) continue;
    double mean = 0, square = 0;
    for (const double error : errors) mean += error / frames;
    for (const double error : errors) square += (error - mean) * (error - mean);
    out.at(t) = {mean, std::sqrt(square / (frames - 1) / frames), true};
  }
  return out;
}

const glm::vec3 kFlatLamp{0.5f, 0, 0.5f}, kBoxLamp{0.5f, 0.4f, 0.5f};

// Each tenth within 0.003, and known within 0.0005.
void expect_right_mean(const Bands& bands, const glm::vec3& lamp, int first_samples, bool real_floor,
                       int frames, int samples = 64) {
  const std::array<TenthError, 10> errors =
      errors_by_tenth(bands, lamp, first_samples, real_floor, frames, samples);
  double worst = 0, doubt = 0;
  int measured = 0;
  for (std::size_t t = 0; t < 10; ++t) {
    measured += errors.at(t).measured ? 1 : 0;
    worst = std::max(worst, std::abs(errors.at(t).mean));
    doubt = std::max(doubt, errors.at(t).standard_error);
    EXPECT_LE(std::abs(errors.at(t).mean), 0.003) << bands.name << ", " << lamp.y << " m, tenth " << t;
  }
  // Screens hide all from nothing to the whole; bars a tenth or two.
  EXPECT_GE(measured, bands.blocked.size() == 1 ? 10 : 1) << bands.name;
  EXPECT_LE(doubt, 0.0005) << bands.name << ", " << lamp.y << " m";
  std::cout << bands.name << ", lamp " << lamp.y << " m high: " << worst << " +- " << doubt << "\n";
}

TEST(VisibleShareTest, OfAllSamplesIsRightInTheMean) {
  for (const Bands& bands : all_bands()) {
    expect_right_mean(bands, kFlatLamp, 0, false, 64);
    expect_right_mean(bands, kBoxLamp, 0, false, 64);
  }
}

TEST(VisibleShareTest, OfAdaptiveSamplesIsRightInTheMean) {
  for (const Bands& bands : all_bands()) expect_right_mean(bands, kFlatLamp, 4, false, 640);
  for (std::size_t i : {0u, 1u, 4u}) expect_right_mean(all_bands().at(i), kBoxLamp, 4, false, 400);
}

// 30: not sixteen times a number of rounds.
TEST(VisibleShareTest, OfAnyNumberOfAdaptiveSamplesIsRightInTheMean) {
  for (const int samples : {12, 30, 100})
    expect_right_mean(all_bands().at(0), kFlatLamp, 4, false, 1000, samples);
}

TEST(VisibleShareTest, OfAdaptiveSamplesOnARealFloorIsRightInTheMean) {
  for (std::size_t i : {0u, 3u, 4u}) expect_right_mean(all_bands().at(i), kFlatLamp, 4, true, 640);
}

}  // namespace
}  // namespace herr
