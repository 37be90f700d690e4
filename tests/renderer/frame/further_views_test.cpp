// Pictures beside the headset's viewports in whole frames: they change nothing else.
#include "renderer/further_view.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/renderer/busy_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

DisplayProfile blending_profile() {
  DisplayProfile profile = test::small_profile();
  for (const std::size_t i : {1u, 3u}) {
    profile.viewports[i].focus = true;
    profile.viewports[i].edge_blend_deg = 2;
  }
  return profile;
}

RenderSettings with_view(RenderSettings settings, Blend density = Blend::context) {
  settings.blended_view = density;
  return settings;
}

TEST(FurtherViews, AreNotThereUnlessAskedFor) {
  const DisplayProfile profile = blending_profile();
  EXPECT_TRUE(further_views(profile, test::small_settings()).empty());
  const RenderedFrame frame =
      test::render(test::busy_scene(), profile, test::small_settings(), test::sample_from({0, 0, 0}));
  EXPECT_TRUE(frame.further.empty());
  EXPECT_EQ(frame.times.views_ms, 0);
  EXPECT_EQ(frame.pictures().size(), 4u);
}

TEST(FurtherViews, StandBehindTheViewportsInTheOneList) {
  const DisplayProfile profile = blending_profile();
  const RenderSettings settings = with_view(test::small_settings());
  const std::vector<PictureOutline> list = pictures_of_frame(profile, settings);
  const RenderedFrame frame =
      test::render(test::busy_scene(), profile, settings, test::sample_from({0, 0, 0}));
  const std::vector<const ViewportImage*> pictures = frame.pictures();
  ASSERT_EQ(list.size(), 6u);
  ASSERT_EQ(pictures.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(pictures[i]->width_px, list[i].width_px);
    EXPECT_EQ(pictures[i]->height_px, list[i].height_px);
  }
  EXPECT_EQ(list[1].kind, PictureKind::focus);
  EXPECT_EQ(list[4].name, "blended-left");
  EXPECT_EQ(list[5].name, "blended-right");
  EXPECT_EQ(list[5].eye, Eye::right);
  EXPECT_EQ(frame.further[1].name, "blended-right");
}

TEST(FurtherViews, ChangeNoViewportAndAreNotOfTheFrameTime) {
  const DisplayProfile profile = blending_profile();
  const Scene scene = test::busy_scene();
  const FrameSample sample = test::sample_from({0, 0, 0});
  const RenderedFrame without = test::render(scene, profile, test::small_settings(), sample);
  const RenderedFrame with = test::render(scene, profile, with_view(test::small_settings()), sample);
  test::expect_same_bits(with, without);
  test::expect_times_add_up(with);
  EXPECT_GT(with.times.views_ms, 0);
  EXPECT_EQ(with.times.outside_ms, 0);  // no camera stands outside
}

TEST(FurtherViews, AreTheSameBitsWithAnyNumberOfThreads) {
  const DisplayProfile profile = blending_profile();
  const Scene scene = test::busy_scene();
  const FrameSample sample = test::sample_from({0, 0, 0});
  RenderSettings settings = with_view(test::small_settings(), Blend::focus);
  const RenderedFrame one = test::render(scene, profile, settings, sample);
  settings.threads = 3;
  const RenderedFrame three = test::render(scene, profile, settings, sample);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(test::same_bits(one.further[i].image, three.further[i].image));
  }
}

TEST(FurtherViews, OfTheNextFrameLieWhereThoseOfTheLastOneLay) {
  const DisplayProfile profile = blending_profile();
  const Scene scene = test::busy_scene();
  Renderer renderer(scene, profile, with_view(test::small_settings()), false);
  RenderedFrame frame;
  test::render_with(renderer, scene, test::sample_from({0, 0, 0}), frame);
  const std::uint16_t* storage = frame.further[0].image.row(0);
  const char* name = frame.further[0].name.data();
  test::render_with(renderer, scene, test::sample_from({0, 0, 0.1}), frame);
  EXPECT_EQ(frame.further[0].image.row(0), storage);
  EXPECT_EQ(frame.further[0].name.data(), name);
}

// Context pixels that the focus covers are black then; a blend that reached them would show it.
void expect_covered_pixels_unseen(const Viewport& focus, const RenderSettings& asked) {
  DisplayProfile profile = test::single_view(192, 192, 45, 45);
  profile.viewports.push_back(focus);
  profile.viewports.back().focus = true;
  const Scene scene = test::busy_scene();
  const FrameSample sample = test::sample_from({0, 0, 0});
  RenderSettings settings = asked;
  const RenderedFrame all = test::render(scene, profile, settings, sample);
  settings.covered_pixels = false;
  const RenderedFrame fewer = test::render(scene, profile, settings, sample);
  EXPECT_LT(fewer.counters.rays[RayKind::primary], all.counters.rays[RayKind::primary]);
  EXPECT_TRUE(test::same_bits(all.further[0].image, fewer.further[0].image));
}

TEST(FurtherViews, CoveredPixelsThatAreLeftOutAreSeenNowhere) {
  for (const double blend_deg : {0.0, 1.0}) {
    for (const Blend density : {Blend::context, Blend::focus}) {
      for (const double scale : {1.0, 0.75}) {
        SCOPED_TRACE(testing::Message() << blend_deg << " degrees, scale " << scale);
        Viewport focus = test::viewport_deg(Eye::left, 200, 200, -30, 30, -30, 30);
        focus.edge_blend_deg = blend_deg;
        RenderSettings settings = with_view(test::planar_settings(), density);
        settings.filter = ResampleFilter::bicubic;
        settings.scale = scale;
        expect_covered_pixels_unseen(focus, settings);
      }
    }
  }
}

// 144 rays for 192 pixels over tangents of +-1: a tile begins at ray 64, and the focus two rays before it. A
// pixel of the view just outside, at up to 62 rays, is interpolated up to context pixel 83, at 62.625, and
// bicubic reads two rays beyond that one: 64 too.
TEST(FurtherViews, CoveredPixelsAreTracedAsFarAsTheViewReads) {
  Viewport focus = test::viewport_deg(Eye::left, 600, 600, -45, 45, -45, 45);
  focus.tan_left = -1 + 62 * 2.0 / 144 - 1e-9;
  RenderSettings settings = with_view(test::planar_settings(), Blend::focus);
  settings.filter = ResampleFilter::bicubic;
  settings.scale = 0.75;
  expect_covered_pixels_unseen(focus, settings);
}

TEST(FurtherViews, AreNotMadeOfAFrameThatIsGivenUp) {
  const DisplayProfile profile = blending_profile();
  const Scene scene = test::busy_scene();
  Renderer renderer(scene, profile, with_view(test::small_settings()), false);
  RenderedFrame frame;
  SceneState state;
  scene_state_at(scene, 0.0, state);
  const std::atomic<bool> abandon{true};
  EXPECT_FALSE(renderer.render_frame(test::sample_from({0, 0, 0}), state, frame, &abandon));
  EXPECT_TRUE(frame.further.empty());
}

}  // namespace
}  // namespace herr
