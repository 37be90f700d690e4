// The camera feed as a viewport shows it: undistorted, re-projected from the camera's pose at its exposure.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "renderer/feed/camera_feed.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

using Texel = std::array<std::uint16_t, 4>;

// Red grows with x and green with y, by 1/64 a pixel: exact halfs up to 2048 / 64.
Texel position_texel(int x, int y) {
  return {test::to_half(x / 64.0), test::to_half(y / 64.0), test::to_half(0.5), 0x3c00};
}

test::TestCamera pinhole() {
  return test::TestCamera::pinhole(320, 240, 40, position_texel);
}
test::TestCamera brown_conrady() {
  test::TestCamera camera = pinhole();
  camera.model.distortion = {-0.12, 0.03, 0.002, -0.0015, -0.004};
  camera.model.prepare();
  return camera;
}
test::TestCamera kb4() {
  test::TestCamera camera = pinhole();
  camera.model.kind = CameraModelKind::kb4;
  camera.model.fx = camera.model.fy = 110;  // 160 pixels at 83 degrees
  camera.model.distortion = {0.02, -0.008, 0.003, -0.0006};
  camera.model.prepare();
  return camera;
}

// A camera 5 cm right of the head, turned by 12 degrees and a little rolled, exposed while
// the head stood elsewhere.
Pose camera_pose() {
  return {{0.05, 0.02, -0.03}, glm::angleAxis(0.21, glm::normalize(glm::dvec3{0.2, 1, 0.1}))};
}

struct Shown {
  RenderedFrame frame;
  FeedView feed;
};

Shown show(const test::TestCamera& camera, const DisplayProfile& profile, Isa isa = Isa::best) {
  FrameSample sample = test::sample_from({0.2, 1.6, 0.1});
  camera.attach_to(sample);
  Shown shown;
  for (auto& eye : sample.cameras) eye->world_from_camera = sample.head.world_from_head * camera_pose();
  RenderSettings settings = test::small_settings();
  settings.feed_distance_m = 1.5;
  settings.isa = isa;
  shown.frame = test::render(Scene{}, profile, settings, sample);
  shown.feed = {camera.image.get(), &camera.model, inverse(camera_pose()), 1.5};
  return shown;
}

void expect_exact_projection(const test::TestCamera& camera, const DisplayProfile& profile,
                             Isa isa = Isa::best) {
  const Shown shown = show(camera, profile, isa);
  const Viewport& view = profile.viewports[0];
  int inside = 0, outside = 0, border = 0;
  double worst = 0;
  test::for_each_pixel(shown.frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const auto at = camera_pixel(view, shown.feed, x, y);
    const double w = camera.image->width_px - 1, h = camera.image->height_px - 1;
    // A coordinate may be off by 1/32 pixel where cells interpolate it, and that decides at the border.
    constexpr double kCells_px = 1.0 / 32, kFloat_px = 1e-3;
    const auto within = [&](double margin) {
      return at && at->x > margin - 0.5 && at->y > margin - 0.5 && at->x < w + 0.5 - margin &&
             at->y < h + 0.5 - margin;
    };
    ASSERT_EQ(pixel[3], 1.0);
    if (within(kCells_px + kFloat_px)) {
      ++inside;
      const double values[2] = {std::clamp(at->x, 0.0, w) / 64, std::clamp(at->y, 0.0, h) / 64};
      for (std::size_t c = 0; c < 2; ++c) {
        // Texels are exact; the blend is stored as a half, truncated by the slowest instruction set.
        const double bound = (kCells_px + kFloat_px) / 64 + 2 * test::half_rounding(values[c]);
        worst = std::max(worst, std::abs(pixel[c] - values[c]) / bound);
        ASSERT_NEAR(pixel[c], values[c], bound) << x << ", " << y << " shows " << at->x << ", " << at->y;
      }
      ASSERT_NEAR(pixel[2], 0.5, 0x1p-12);
    } else if (!within(-kCells_px - kFloat_px)) {
      ++outside;
      ASSERT_EQ(pixel[0], 0.0) << x << ", " << y;
      ASSERT_EQ(pixel[2], 0.0) << x << ", " << y;
    } else {
      ++border;
    }
  });
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
  EXPECT_LT(border, inside / 20);
  std::cout << inside << " pixels of the feed, worst " << worst << " of its bound\n";
}

TEST(CameraFeedTest, APinholeIsProjectedExactly) {
  expect_exact_projection(pinhole(), test::single_view(250, 246, 60, 60));
}

TEST(CameraFeedTest, BrownConradyIsProjectedExactly) {
  expect_exact_projection(brown_conrady(), test::single_view(250, 246, 60, 60));
}

TEST(CameraFeedTest, Kb4IsProjectedExactly) {
  expect_exact_projection(kb4(), test::single_view(250, 246, 82, 82));
}

TEST(CameraFeedTest, FineViewportsWhoseCellsAreInterpolatedAreExactToo) {
  // 16 pixels of this viewport are 5 of the camera's.
  expect_exact_projection(brown_conrady(), test::single_view(990, 990, 45, 45));
  expect_exact_projection(kb4(), test::single_view(990, 990, 82, 82));
}

TEST(CameraFeedTest, EveryInstructionSetProjectsAlike) {
  for (const Isa isa : test::offered_isas())
    expect_exact_projection(brown_conrady(), test::single_view(250, 246, 60, 60), isa);
}

// Cells of a coarse viewport span much of the image: those whose curvature is too great are
// projected pixel by pixel.
TEST(CameraFeedTest, CoarseViewportsAreExactToo) {
  expect_exact_projection(brown_conrady(), test::single_view(128, 128, 60, 60));
  expect_exact_projection(kb4(), test::single_view(128, 128, 80, 80));
}

TEST(CameraFeedTest, AViewAwayFromTheCameraIsBlack) {
  const test::TestCamera camera = pinhole();
  FrameSample sample = test::sample_from({0, 0, 0});
  camera.attach_to(sample);
  for (auto& eye : sample.cameras) {
    eye->world_from_camera.orientation = glm::angleAxis(glm::pi<double>(), glm::dvec3{0, 1, 0});
  }
  const RenderedFrame frame = test::render(Scene{}, test::small_profile(), test::small_settings(), sample);
  for (const ViewportImage& image : frame.viewports) {
    test::for_each_pixel(image, [](int, int, const test::Pixel& pixel) {
      ASSERT_EQ(pixel, (test::Pixel{0, 0, 0, 1}));
    });
  }
}

TEST(CameraFeedTest, TheFeedIsShownAsItWasTakenWhateverTheExposure) {
  // Scene values are shown times 2^ev: a feed of 0.25 has the radiance 0.25 / 2^ev, exact for whole stops.
  const test::TestCamera camera = test::TestCamera::pinhole(320, 240, 40, [](int, int) {
    return Texel{test::to_half(0.25), test::to_half(0.5), 0, 0x3c00};
  });
  FrameSample sample = test::sample_from({0, 1.6, 0});
  camera.attach_to(sample);
  for (const int ev : {-10, -1, 0, 3, 8}) {
    RenderSettings settings = test::small_settings();
    settings.exposure_ev = ev;
    const DisplayProfile profile = test::single_view(33, 33, 20, 20);
    const RenderedFrame frame = test::render(Scene{}, profile, settings, sample);
    EXPECT_EQ(frame.viewports[0].exposure, std::exp2(ev));
    const ViewportImage& image = frame.viewports[0];
    const std::uint16_t* texel = image.row(image.height_px / 2) + 4 * (image.width_px / 2);
    EXPECT_EQ(texel[0], test::to_half(0.25 * std::exp2(-ev))) << ev;
    EXPECT_EQ(texel[1], test::to_half(0.5 * std::exp2(-ev))) << ev;
    EXPECT_EQ(texel[2], 0) << ev;
  }
}

TEST(CameraFeedTest, ImagesOfOneAndOfTwoPixelsWork) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 2}, {1, 3}, {5, 1}}) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    test::TestCamera camera = test::TestCamera::pinhole(width, height, 60, [](int, int) {
      return Texel{0x3555, 0x3800, 0x3c00, 0x3c00};
    });
    camera.model.fx = 0.2 * width;  // a view wider than the viewport's on both axes
    camera.model.fy = 0.2 * height;
    FrameSample sample = test::sample_from({0, 0, 0});
    camera.attach_to(sample);
    const RenderedFrame frame = test::render(Scene{}, test::small_profile(), test::small_settings(), sample);
    // Constant: whatever is fetched, it is this texel, bit for bit.
    for (const ViewportImage& image : frame.viewports) {
      for (int y = 0; y < image.height_px; ++y) {
        for (int x = 0; x < image.width_px; ++x) ASSERT_EQ(image.row(y)[4 * x], 0x3555) << x << ", " << y;
      }
    }
  }
}

TEST(CameraFeedTest, ImagesThatAreLargeEnoughAreNotCopied) {
  CameraImage storage, large;
  large.width_px = large.height_px = 2;
  large.rgba_half.assign(16, 0x3c00);
  EXPECT_EQ(at_least_2x2(large, storage), &large);
  CameraImage column;
  column.width_px = 1;
  column.height_px = 3;
  column.rgba_half = {1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
  const CameraImage* wide = at_least_2x2(column, storage);
  EXPECT_EQ(wide, &storage);
  EXPECT_EQ(wide->width_px, 2);
  EXPECT_EQ(wide->height_px, 3);
  EXPECT_EQ(wide->rgba_half, (std::vector<std::uint16_t>{1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2,
                                                         2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3}));
}

TEST(CameraFeedTest, TheFeedMovesWithTheHeadsTurnSinceItsExposure) {
  // The head turned left by 5 degrees after the exposure: what was straight ahead is
  // now 5 degrees to the right.
  test::TestCamera camera = test::TestCamera::pinhole(1001, 101, 45, [](int x, int) {
    return x == 500 ? Texel{0x3c00, 0x3c00, 0x3c00, 0x3c00} : Texel{0, 0, 0, 0x3c00};
  });
  FrameSample sample = test::sample_from({0, 0, 0});
  camera.attach_to(sample);
  constexpr double kTurn_deg = 5;
  sample.head.world_from_head.orientation =
      glm::angleAxis(kTurn_deg / kDegreesPerRadian, glm::dvec3{0, 1, 0});
  const DisplayProfile profile = test::single_view(901, 11, 45, 2);
  const RenderedFrame frame = test::render(Scene{}, profile, test::small_settings(), sample);
  double sum = 0, weight = 0;
  for (int x = 0; x < 901; ++x) {
    const double value = test::pixel_at(frame.viewports[0], x, 5)[0];
    sum += value * x;
    weight += value;
  }
  // tan(5 deg) of a half width of 1: column 450 + 450.5 * 0.087489 = 489.41; the line is 1.8 pixels wide, its
  // centroid moves by far less than half a pixel.
  ASSERT_GT(weight, 0.0);
  EXPECT_NEAR(sum / weight, 450 + 450.5 * std::tan(kTurn_deg / kDegreesPerRadian), 0.5);
}

}  // namespace
}  // namespace herr
