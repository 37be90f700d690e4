// The `quality` sample (paper, section 3.4): text at the gaze stays legible, and what lies around it does not
// crawl while the head turns slowly. What levels of textures do for both.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "renderer/frame/renderer_impl.h"
#include "renderer/settings_presets.h"
#include "scenes/load_scene.h"
#include "tests/missing_tool.h"
#include "tests/paths.h"
#include "tests/renderer/half_pixels.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr std::array<double, 5> kBandEdgesDeg{0, 5, 15, 30, 45};
using Bands = std::array<double, kBandEdgesDeg.size() - 1>;

std::filesystem::path samples() {
  return std::filesystem::path(test::source_dir()) / "scenes" / "samples";
}

// The eyes where a seated viewer's are, turned to the left by `yaw_deg`; the gaze rests in the head.
FrameSample seated(double yaw_deg) {
  FrameSample sample = test::sample_from({0, 1.2, 0});
  sample.head.world_from_head.orientation = glm::angleAxis(glm::radians(yaw_deg), glm::dvec3{0, 1, 0});
  return sample;
}

// Every texture read at its full size, as if it had no smaller levels.
void forget_levels(Renderer& renderer) {
  for (const InstanceRecord& record : renderer.internals().geometry->instances()) {
    if (record.base_colour_texture) const_cast<TextureRecord*>(record.base_colour_texture)->levels = 1;
  }
}

// Luminance of a picture, bilinear; x and y in pixels from the middle of the first.
class Luminance {
 public:
  explicit Luminance(const ViewportImage& image) : width_(image.width_px), values_(size_of(image)) {
    test::for_each_pixel(image, [&](int x, int y, const test::Pixel& p) {
      values_[index(x, y)] = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    });
  }
  double at(double x, double y) const {
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const double tx = x - x0, ty = y - y0;
    return (1 - ty) * ((1 - tx) * values_[index(x0, y0)] + tx * values_[index(x0 + 1, y0)]) +
           ty * ((1 - tx) * values_[index(x0, y0 + 1)] + tx * values_[index(x0 + 1, y0 + 1)]);
  }

 private:
  static std::size_t size_of(const ViewportImage& image) {
    return static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_;
  std::vector<double> values_;
};

// The luminance of places of the world over the frames of a slow turn: root mean square of its deviation from
// the place's own mean, by the place's eccentricity in the middle frame. A picture that is sharp and right
// has none: what is left is crawling (and a little of the bilinear reading).
Bands crawling(bool levels) {
  constexpr int kFrames = 24, kSide = 640;
  constexpr double kStepDeg = 0.1;  // 6 degrees a second at 60 Hz
  const Scene scene = load_scene(samples() / "quality.scene.json");
  RenderSettings settings = direct_light_settings();
  settings.threads = 2;
  Renderer renderer(scene, test::single_view(kSide, kSide, 45, 45), settings, false);
  if (!levels) forget_levels(renderer);
  std::vector<Luminance> frames;
  RenderedFrame frame;
  for (int i = 0; i < kFrames; ++i) {
    test::render_with(renderer, scene, seated(kStepDeg * i), frame);
    frames.emplace_back(frame.viewports[0]);
  }
  Bands sums{}, counts{};
  const double middle_deg = 0.5 * kStepDeg * (kFrames - 1);
  for (int y = 1; y < kSide - 1; y += 2) {
    for (int x = 1; x < kSide - 1; x += 2) {
      const glm::dvec3 place = glm::normalize(
          glm::dvec3{(x + 0.5) / kSide * 2 - 1, 1 - (y + 0.5) / kSide * 2, -1});  // in the middle frame
      const double eccentricity_deg = std::acos(-place.z) * kDegreesPerRadian;
      double sum = 0, squares = 0;
      bool seen = true;
      for (int i = 0; i < kFrames && seen; ++i) {
        const double turn = glm::radians(middle_deg - kStepDeg * i);
        const glm::dvec3 in_frame = glm::angleAxis(turn, glm::dvec3{0, 1, 0}) * place;
        const double column = (1 - in_frame.x / in_frame.z) * 0.5 * kSide - 0.5,
                     row = (1 + in_frame.y / in_frame.z) * 0.5 * kSide - 0.5;
        seen = column >= 0 && column < kSide - 1 && row >= 0 && row < kSide - 1;
        if (!seen) break;
        const double value = frames[static_cast<std::size_t>(i)].at(column, row);
        sum += value;
        squares += value * value;
      }
      if (!seen) continue;
      for (std::size_t band = 0; band < sums.size(); ++band) {
        if (eccentricity_deg < kBandEdgesDeg[band] || eccentricity_deg >= kBandEdgesDeg[band + 1]) continue;
        sums[band] += std::max(squares / kFrames - sum / kFrames * (sum / kFrames), 0.0);
        ++counts[band];
      }
    }
  }
  for (std::size_t band = 0; band < sums.size(); ++band) sums[band] = std::sqrt(sums[band] / counts[band]);
  return sums;
}

TEST(SampleQualityTest, ThePeripheryCrawlsLessWithLevelsOfTextures) {
  if (!std::filesystem::exists(samples() / "generated/quality_boards.glb")) {
    HERR_MISSING_TOOL("scenes/samples/generated is missing; an ordinary build makes it");
  }
  const Bands with = crawling(true), without = crawling(false);
  for (std::size_t band = 0; band < with.size(); ++band) {
    std::printf("%2.0f ... %2.0f degrees: deviation over time %.4f with levels, %.4f without\n",
                kBandEdgesDeg[band], kBandEdgesDeg[band + 1], with[band], without[band]);
  }
  // Fine print is smaller than a pixel of this picture even at the gaze (7 a degree), and from 15 degrees on
  // a sample spans 4 texels and more: what is read without levels is one of them by chance. Measured: 0.23,
  // 0.26, 0.36 and 0.17 of the deviation without.
  for (std::size_t band = 0; band < with.size(); ++band) EXPECT_LE(with[band], 0.5 * without[band]);
}

TEST(SampleQualityTest, LettersAtTheGazeAreThoseOfOneRayForEachPixel) {
  if (!std::filesystem::exists(samples() / "generated/quality_boards.glb")) {
    HERR_MISSING_TOOL("scenes/samples/generated is missing; an ordinary build makes it");
  }
  // 60 pixels a degree, the display's focus area; the gaze on the middle of the letter chart.
  constexpr int kSide = 600;
  const Scene scene = load_scene(samples() / "quality.scene.json");
  const DisplayProfile view = test::single_view(kSide, kSide, 5, 5);
  RenderSettings settings = direct_light_settings();
  settings.threads = 2;
  RenderSettings full = settings;
  full.foveation = Foveation::off;
  const RenderedFrame foveated = test::render(scene, view, settings, seated(0));
  const RenderedFrame reference = test::render(scene, view, full, seated(0));
  const Luminance a(foveated.viewports[0]), b(reference.viewports[0]);
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (int y = 0; y < kSide - 1; ++y) {
    for (int x = 0; x < kSide - 1; ++x) {
      if (std::hypot(x - 299.5, y - 299.5) > 120) continue;  // 2 degrees
      const double p = a.at(x, y), q = b.at(x, y);
      ++n, sa += p, sb += q, saa += p * p, sbb += q * q, sab += p * q;
    }
  }
  const double correlation = (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
  const double contrast = std::sqrt((saa - sa * sa / n) / (sbb - sb * sb / n));
  std::printf("within 2 degrees of the gaze: correlation %.4f, contrast %.3f of the reference\n", correlation,
              contrast);
  // Letters of half the contrast, or shifted by a stroke, would be no letters: 0.95 of both are.
  EXPECT_GE(correlation, 0.95);
  EXPECT_GE(contrast, 0.95);
}

}  // namespace
}  // namespace herr
