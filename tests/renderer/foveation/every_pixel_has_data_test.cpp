// Buffers are poisoned with NaN before a frame: a pixel that used a sample which nobody traced would show it.
#include <gtest/gtest.h>

#include "renderer/frame/renderer_impl.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

using test::gaze_deg;
using test::viewport_deg;

Scene lit_sphere() {
  Scene scene;
  test::add(scene, test::sphere({0, 0, -3}, 1), test::matte(glm::vec3{0.5f}));
  test::add(scene, test::floor_quad(20, -1.5f), test::matte(glm::vec3{0.3f}));
  scene.lights.push_back(test::light_at({1, 3, 0}, glm::vec3{20.0f}));
  scene.ambient = scene.environment = glm::vec3{0.2f};
  return scene;
}

void poison(Renderer& renderer) {
  for (RadianceBuffer& buffer : renderer.internals().buffers) {
    std::fill_n(buffer.texels(), 4 * buffer.texel_count(), std::uint16_t{0x7e00});
  }
}

void expect_data_everywhere(const DisplayProfile& profile, const RenderSettings& settings,
                            const std::vector<glm::dvec3>& gazes) {
  const Scene scene = lit_sphere();
  for (const Isa isa : test::offered_isas()) {
    RenderSettings with_isa = settings;
    with_isa.isa = isa;
    Renderer renderer(scene, profile, with_isa, false);
    RenderedFrame frame;
    for (const glm::dvec3& gaze : gazes) {
      SCOPED_TRACE(testing::Message()
                   << name_of(isa) << ", gaze " << gaze.x << " " << gaze.y << " " << gaze.z);
      poison(renderer);
      test::render_with(renderer, scene, test::sample_from({0, 0, 0}, gaze), frame);
      test::expect_finite(frame);
      EXPECT_GT(frame.counters.rays[RayKind::primary], 0);
      EXPECT_EQ(frame.counters.invalid_rays, 0);
    }
  }
}

std::vector<glm::dvec3> hard_gazes() {
  return {{0, 0, -1},        {1, 1, -1},       {-1, 1, -1},       {1, -1, -1},
          {-1, -1, -1},      {0, 0, 1},        gaze_deg(80, 0),   gaze_deg(0, 80),
          gaze_deg(-80, 10), gaze_deg(135, 0), gaze_deg(180, 30), gaze_deg(3, 1)};
}

TEST(EveryPixelHasDataTest, ForGazesAtTheCentreTheCornersAt80DegreesAndBehind) {
  expect_data_everywhere(test::small_profile(), test::small_settings(), hard_gazes());
}

TEST(EveryPixelHasDataTest, WithViewportsFinerThanTheBuffer) {
  expect_data_everywhere(test::small_profile(333, 517, 211), test::small_settings(),
                         {{0, 0, -1}, {1, 1, -1}, gaze_deg(80, 0)});
}

TEST(EveryPixelHasDataTest, WithABufferFinerThanTheViewports) {
  RenderSettings settings = test::small_settings();
  settings.polar_width = 259;
  settings.polar_height = 258;
  expect_data_everywhere(test::small_profile(16, 20, 12), settings,
                         {{0, 0, -1}, {1, -1, -1}, gaze_deg(80, 0), {0, 0, 1}});
}

TEST(EveryPixelHasDataTest, AtTheSmallestBuffersThereAre) {
  for (const auto& [width, height] : {std::pair{1, 2}, {1, 768}, {788, 2}, {2, 4}, {3, 6}, {33, 34}}) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    RenderSettings settings = test::small_settings();
    settings.polar_width = width;
    settings.polar_height = height;
    expect_data_everywhere(test::small_profile(), settings,
                           {{0, 0, -1}, {1, 1, -1}, gaze_deg(80, 0), {0, 0, 1}});
  }
}

TEST(EveryPixelHasDataTest, InAViewOf179Degrees) {
  expect_data_everywhere(test::single_view(128, 96, 89.5, 89.5), test::small_settings(), hard_gazes());
}

TEST(EveryPixelHasDataTest, ForEveryFilter) {
  RenderSettings settings = test::small_settings();
  for (const ResampleFilter filter : {ResampleFilter::nearest, ResampleFilter::bicubic}) {
    settings.filter = filter;
    expect_data_everywhere(test::small_profile(), settings, hard_gazes());
    expect_data_everywhere(test::single_view(40, 40, 3, 3), settings, hard_gazes());
    for (const auto& [width, height] : {std::pair{1, 2}, {2, 4}, {5, 6}}) {
      RenderSettings few = settings;
      few.polar_width = width, few.polar_height = height;
      expect_data_everywhere(test::small_profile(), few, hard_gazes());
    }
  }
}

TEST(EveryPixelHasDataTest, WithoutFoveationAtAnyScale) {
  RenderSettings settings = test::planar_settings();
  for (const ResampleFilter filter :
       {ResampleFilter::nearest, ResampleFilter::bilinear, ResampleFilter::bicubic}) {
    settings.filter = filter;
    for (const double scale : {0.05, 0.3, 0.77, 1.0}) {
      settings.scale = scale;
      DisplayProfile profile = test::single_view(37, 22, 40, 30);
      profile.viewports.push_back(viewport_deg(Eye::right, 1, 1, -30, 5, -10, 40));
      expect_data_everywhere(profile, settings, {{0, 0, -1}});
    }
  }
}

TEST(EveryPixelHasDataTest, InNarrowLopsidedAndSeparateViewports) {
  DisplayProfile profile;
  profile.viewports = {
      viewport_deg(Eye::left, 40, 40, 10, 12, -3, -2), viewport_deg(Eye::left, 40, 40, -60, -40, 20, 50),
      viewport_deg(Eye::right, 1, 1, -30, 5, -10, 40), viewport_deg(Eye::right, 17, 3, 30, 31, 0, 1)};
  expect_data_everywhere(profile, test::small_settings(), hard_gazes());
}

TEST(EveryPixelHasDataTest, ThePaddingRepeatsTheSamplesAcrossThePoleTheSeamAndTheEdge) {
  Scene scene = lit_sphere();
  // Neighbours differ everywhere: a wall of small glowing squares, and in front of it one of smaller ones, of
  // 0.095 degrees, for the innermost samples at 0.05 and 0.16 degrees. Corners of both lie straight ahead.
  const auto add_wall = [&](float side, float z) {
    for (int i = 0; i < 400; ++i) {
      const glm::vec3 corner{side * static_cast<float>(i % 20 - 10), side * static_cast<float>(i / 20 - 10),
                             z};
      test::add(scene, test::quad(corner, {side, 0, 0}, {0, side, 0}),
                test::glowing(glm::vec3{0.01f * static_cast<float>(i * 37 % 101)}));
    }
  };
  add_wall(0.07f, -1);
  add_wall(0.0015f, -0.9f);
  RenderSettings settings = test::small_settings();
  settings.polar_width = 37;
  constexpr int kHeight = 48;
  for (const Isa isa : test::offered_isas()) {
    settings.isa = isa;
    Renderer renderer(scene, test::single_view(64, 64, 45, 45), settings, false);
    poison(renderer);
    RenderedFrame frame;
    test::render_with(renderer, scene, test::sample_from({0, 0, 0}), frame);
    const RadianceBuffer& buffer = renderer.internals().buffers[0];
    const auto texel = [&](int column, int row) {
      const std::uint16_t* t = buffer.texels() + 4 * texel_index(buffer.row_stride(), column, row);
      return std::vector<std::uint16_t>(t, t + 4);
    };
    int unlike = 0;
    for (int row = 0; row < kHeight; ++row) {
      const int across = (row + kHeight / 2) % kHeight;
      EXPECT_EQ(texel(-1, row), texel(0, across)) << "across the pole, row " << row;
      EXPECT_EQ(texel(-2, row), texel(1, across)) << "further across the pole, row " << row;
      EXPECT_EQ(texel(37, row), texel(36, row)) << "beyond the edge, row " << row;
      EXPECT_EQ(texel(38, row), texel(36, row)) << "further beyond the edge, row " << row;
      unlike += texel(-1, row) != texel(0, row) && texel(1, row) != texel(0, row);
    }
    for (int column = -2; column <= 38; ++column) {
      EXPECT_EQ(texel(column, kHeight), texel(column, 0)) << "beyond the seam, column " << column;
      EXPECT_EQ(texel(column, kHeight + 1), texel(column, 1)) << "further beyond it, column " << column;
      EXPECT_EQ(texel(column, -1), texel(column, kHeight - 1)) << "before the seam, column " << column;
    }
    EXPECT_GT(unlike, 0) << "the pole must lie on an edge, or nothing was tested";
  }
}

TEST(EveryPixelHasDataTest, RaysThatNoViewportSeesAreNotTraced) {
  const Scene scene = lit_sphere();
  const DisplayProfile profile = test::single_view(64, 64, 20, 20);
  const RenderedFrame ahead =
      test::render(scene, profile, test::small_settings(), test::sample_from({0, 0, 0}));
  const RenderedFrame corner =
      test::render(scene, profile, test::small_settings(), test::sample_from({0, 0, 0}, {1, 1, -1}));
  // Straight ahead most of the circle that holds the square is in the square: area 4 / (2 pi) = 0.64, and the
  // inner rings, which hold most samples, are all inside.
  EXPECT_GT(ahead.counters.rays[RayKind::primary], 64 * 48 * 6 / 10);
  EXPECT_LT(ahead.counters.rays[RayKind::primary], 64 * 48);
  // From the corner direction (54.7 degrees off) the square subtends well under a
  // right angle of the full turn.
  EXPECT_LT(corner.counters.rays[RayKind::primary], 64 * 48 / 4);
  EXPECT_EQ(ahead.counters.rays[RayKind::primary], ahead.counters.polar_samples);
}

}  // namespace
}  // namespace herr
