// Relations of gaze hold on a small scene, and each sees a fault of its kind.
#include <gtest/gtest.h>

#include "server/output/srgb_table.h"
#include "server/study/relations/gaze/gaze_cases.h"
#include "server/study/relations/relation_groups.h"
#include "tests/server/study/relations/lit_room.h"

namespace herr {
namespace {

void draw_as_is(Renderer& renderer, const RelationCase& of, const FrameQuality& quality, RenderedFrame& out) {
  renderer.render_frame(of.sample, of.state, quality, out);
}

std::vector<std::string> broken_by(const DrawFrame& draw) {
  RelationLog log;
  measure_gaze_by(draw, test::lit_room(), log);
  EXPECT_EQ(log.results().size(), 20u);
  return test::broken(log);
}

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(GazeRelationsTest, HoldOnASmallScene) {
  EXPECT_EQ(broken_by(draw_as_is), std::vector<std::string>{});
}

TEST(GazeRelationsTest, AHoleOfOnePixelIsSeen) {
  const std::vector<std::string> names = broken_by(
      [](Renderer& renderer, const RelationCase& of, const FrameQuality& quality, RenderedFrame& out) {
        draw_as_is(renderer, of, quality, out);
        std::uint16_t* texel = out.viewports[0].row(5) + 4 * 7;
        texel[0] = texel[1] = texel[2] = 0;
      });
  for (const char* what :
       {"gaze at the middle of a viewport", "gaze at a corner of a viewport", "gaze 80 degrees off",
        "gaze behind the head", "gaze lost", "a viewport of 1 degree", "a viewport of 179 degrees"}) {
    EXPECT_TRUE(among(names, std::string("every pixel has data: ") + what)) << what;
  }
}

TEST(GazeRelationsTest, WeightsThatSumToLessThanOneAreSeen) {
  // By 1/1000: two steps of a half float below 1.
  const std::vector<std::string> names = broken_by(
      [](Renderer& renderer, const RelationCase& of, const FrameQuality& quality, RenderedFrame& out) {
        draw_as_is(renderer, of, quality, out);
        std::uint16_t* texel = out.viewports[0].row(6) + 4 * 3;
        texel[1] = half_from_float(0.999f * float_from_half(texel[1]));
      });
  EXPECT_TRUE(among(names, "every pixel has data: gaze behind the head"));
}

TEST(GazeRelationsTest, ColourWithoutItsCoverageIsSeen) {
  const std::vector<std::string> names = broken_by(
      [](Renderer& renderer, const RelationCase& of, const FrameQuality& quality, RenderedFrame& out) {
        draw_as_is(renderer, of, quality, out);
        if (!of.settings.camera) out.viewports[0].row(6)[4 * 3 + 3] ^= 0x3c00u;
      });
  EXPECT_TRUE(among(names, "white surfaces over nothing are their coverage"));
}

TEST(GazeRelationsTest, AFrameThatRemembersTheOneBeforeIsSeen) {
  const Renderer* before = nullptr;
  int frames = 0;
  const std::vector<std::string> names = broken_by(
      [&](Renderer& renderer, const RelationCase& of, const FrameQuality& quality, RenderedFrame& out) {
        frames = &renderer == before ? frames + 1 : 0;
        before = &renderer;
        draw_as_is(renderer, of, quality, out);
        if (frames > 3) out.viewports.back().row(2)[4] ^= 1u;
      });
  EXPECT_TRUE(among(names, "gaze that jumps each frame"));
}

TEST(GazeRelationsTest, ABufferThatStaysNarrowIsSeen) {
  const std::vector<std::string> names =
      broken_by([](Renderer& renderer, const RelationCase& of, FrameQuality quality, RenderedFrame& out) {
        quality.polar_width = 1;
        draw_as_is(renderer, of, quality, out);
      });
  EXPECT_TRUE(among(names, "error of a buffer finer than pixels"));
  EXPECT_TRUE(among(names, "the error falls with polar width"));
}

TEST(GazeRelationsTest, AnInvalidRayIsSeen) {
  const std::vector<std::string> names = broken_by(
      [](Renderer& renderer, const RelationCase& of, const FrameQuality& quality, RenderedFrame& out) {
        draw_as_is(renderer, of, quality, out);
        out.counters.invalid_rays += of.settings.camera ? 0 : 1;
      });
  EXPECT_EQ(names, std::vector<std::string>{"rays and values are finite for any gaze, width and viewport"});
}

TEST(GazeRelationsTest, WithoutPolarBuffersNoneIsAsked) {
  RelationCase subject = test::lit_room();
  subject.settings.foveation = Foveation::off;
  RelationLog log;
  measure_gaze(subject, log);
  ASSERT_EQ(log.results().size(), 1u);
  EXPECT_EQ(log.results()[0].not_applicable, "foveation is off: one ray per viewport pixel");
}

TEST(GazeCasesTest, ABufferIsFinerThanPixelsWhereTheDisplayIsFinest) {
  RelationCase subject = test::lit_room();
  subject.profile = single_viewport(90, 90);
  // 90 pixels over tangents -1 ... 1: 45 per unit, at the corner times 1 + 1 + 1 and pi / 180: 2.356 per
  // degree. The corner is atan(sqrt 2) = 54.74 degrees off. Along the radius 2.356 ln(55.74) 55.74 = 528.0,
  // and around 2.356 x 360 sin(54.74 degrees) = 692.6.
  const PolarSize size = finer_than_pixels(subject);
  EXPECT_GE(size.width, 528);
  EXPECT_LE(size.width, 530);
  EXPECT_GE(size.height, 693);
  EXPECT_LE(size.height, 694);
}

TEST(GazeCasesTest, AheadAWideViewportNeedsFewSamplesAround) {
  // 9 pixels over tangents -114.59 ... 114.59: 25.46 each; the corner lies at 162.06, 89.646 degrees off, and
  // 0.5 more is the reach. There (1 + 2 x 114.59^2) pi / 180 / 25.46 = 18.0 pixels per degree: along the
  // radius 18.0 x 91.146 ln(91.146) = 7404. Around, 162.06 / 25.46 per radian are 0.1111 per degree, and 18.0
  // sin(0.5 degrees) is 0.1571: 0.2682 x 360 = 96.5.
  const PolarSize size = finer_than_pixels_ahead(179, 9, 0.5);
  EXPECT_NEAR(size.width, 7404, 4);
  EXPECT_GE(size.height, 97);
  EXPECT_LE(size.height, 98);
}

}  // namespace
}  // namespace herr
