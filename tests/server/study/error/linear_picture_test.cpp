// Stored viewports as light.
#include "server/study/error/linear_picture.h"

#include <gtest/gtest.h>

#include <limits>

namespace herr {
namespace {

TEST(LinearPictureTest, ReadsTheColoursOfEveryRowAndNotWhatFollowsThem) {
  ViewportImage image;
  image.width_px = 2;
  image.height_px = 2;
  image.row_stride = 3;
  // Halves: 0x3C00 is 1, 0x3800 1/2, 0x3400 1/4, 0x4000 2, 0xB800 -1/2, 0x0001 2^-24, 0x7C00 infinity.
  image.rgba_half = {0x3C00, 0x3800, 0x3400, 0x3C00, 0x4000, 0xB800, 0x0001, 0x3C00,
                     0x5555, 0x5555, 0x5555, 0x5555, 0x3400, 0x3400, 0x3400, 0x3800,
                     0x7C00, 0x0000, 0x3800, 0x3C00, 0x5555, 0x5555, 0x5555, 0x5555};
  LinearPicture picture;
  picture.plane[0] = {7, 7, 7, 7, 7, 7, 7};
  read_viewport(image, picture);
  EXPECT_EQ(picture.width_px, 2);
  EXPECT_EQ(picture.height_px, 2);
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(picture.plane[0], (std::vector<float>{1, 2, 0.25f, inf}));
  EXPECT_EQ(picture.plane[1], (std::vector<float>{0.5f, -0.5f, 0.25f, 0}));
  EXPECT_EQ(picture.plane[2], (std::vector<float>{0.25f, 0x1p-24f, 0.25f, 0.5f}));
}

TEST(LinearPictureTest, ADisplayShowsNothingBelowBlackOrAboveWhite) {
  const float inf = std::numeric_limits<float>::infinity();
  LinearPicture picture{3, 1, {}};
  picture.plane = {std::vector<float>{-1, 0.25f, 1.5f}, std::vector<float>{inf, -inf, 1},
                   std::vector<float>{std::numeric_limits<float>::quiet_NaN(), 0, 0x1p-24f}};
  limit_to_white(picture);
  EXPECT_EQ(picture.plane[0], (std::vector<float>{0, 0.25f, 1}));
  EXPECT_EQ(picture.plane[1], (std::vector<float>{1, 0, 1}));
  EXPECT_EQ(picture.plane[2], (std::vector<float>{0, 0, 0x1p-24f}));
}

}  // namespace
}  // namespace herr
