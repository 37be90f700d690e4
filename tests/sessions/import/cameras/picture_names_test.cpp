// The order of pictures by name.
#include <gtest/gtest.h>

#include "sessions/import/cameras/camera_pictures.h"

namespace herr {
namespace {

TEST(PictureNames, SortAsPeopleCount) {
  EXPECT_TRUE(natural_less("2.jpg", "10.jpg"));
  EXPECT_FALSE(natural_less("10.jpg", "2.jpg"));
  EXPECT_TRUE(natural_less("a9b2", "a9b10"));
  EXPECT_TRUE(natural_less("img.jpg", "img1.jpg"));
  EXPECT_TRUE(natural_less("99999999999999999999998", "99999999999999999999999"));
  EXPECT_FALSE(natural_less("a", "a"));
  EXPECT_NE(natural_less("01", "1"), natural_less("1", "01")) << "equal numbers still have one order";
}

}  // namespace
}  // namespace herr
