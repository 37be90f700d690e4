// What rays near by differ by is what edges and repeats in plain sight say.
#include "server/study/relations/gaze/near_rays.h"

#include <gtest/gtest.h>

#include "server/study/relations/gaze/gaze_cases.h"
#include "tests/server/study/relations/lit_room.h"

namespace herr {
namespace {

constexpr int kPixels = 16;

// A viewport of 90 degrees, one ray per pixel, over nothing: 16 pixels to a width of 4 m two metres away.
RelationCase empty_view() {
  RelationCase subject;
  subject.sample = test::sample_from({0, 0, 0});
  subject.profile = single_viewport(90, kPixels);
  subject.settings = test::small_settings();
  subject.settings.foveation = Foveation::off;
  subject.settings.scale = 1;
  return subject;
}

// White from `left` to `right`, from pixel to pixel.
void add_white(RelationCase& subject, double left, double right) {
  constexpr double kPixel_m = 4.0 / kPixels;
  Material white = test::matte(glm::vec3{1.0f});
  white.unlit = true;
  const auto x = static_cast<float>((left - kPixels / 2) * kPixel_m);
  const auto width = static_cast<float>((right - left) * kPixel_m);
  test::add(subject.scene, test::quad({x, -9, -2}, {width, 0, 0}, {0, 18, 0}), white);
}

double near_of(RelationCase subject) {
  const Pose eye = subject.sample.head_from_eye[0];
  subject.sample.head.world_from_head.position -= eye.position;  // the left eye stands at the origin
  scene_state_at(subject.scene, 0, subject.state);
  return mean_square_of_near_rays(hard_light(subject), picture_of(hard_light(subject)));
}

TEST(NearRaysTest, AnEdgeBetweenPixelsIsCrossedByOneRayInEightOnEachSide) {
  RelationCase subject = empty_view();
  add_white(subject, 8, 40);
  // Beyond half a pixel lie 1/8 of the weights, of the two columns along the edge; as much is missing beyond
  // the outermost ones: 2/8 of 16 - 2/8.
  EXPECT_NEAR(near_of(subject), 1.0 / 63, 1e-6);
}

TEST(NearRaysTest, StripesThatRepeatWithThePixelsAreSeen) {
  // White over the first quarter of each pixel: every middle is black, and so is every neighbour's.
  RelationCase subject = empty_view();
  for (int pixel = -2; pixel < kPixels + 2; ++pixel) add_white(subject, pixel, pixel + 0.25);
  // Weights at a distance of 1/4 to 1/2 are those of 3/4 to 1/2, 5/32, and of the next stripe, 1/2 to 3/4
  // away, 3/32: all others are black. The outermost column lacks one stripe, which changes it by 1 %.
  EXPECT_NEAR(near_of(subject), 8.0 / 32, 0.02);
}

TEST(NearRaysTest, WhereAllIsAlikeNothingDiffers) {
  RelationCase subject = empty_view();
  add_white(subject, -40, 40);
  EXPECT_EQ(near_of(subject), 0);
}

}  // namespace
}  // namespace herr
