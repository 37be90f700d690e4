// Difference pictures, decoded again.
#include "server/study/report/difference_picture.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace herr {
namespace {

LinearPicture plain(int width, int height, float value) {
  LinearPicture picture;
  picture.width_px = width;
  picture.height_px = height;
  for (auto& plane : picture.plane) plane.assign(picture.pixels(), value);
  return picture;
}

struct DecodedPng {
  int width = 0, height = 0;
  std::vector<std::uint8_t> values;
  std::array<int, 3> at(int x, int y) const {
    const auto i = static_cast<std::size_t>(3 * (y * width + x));
    return {values[i], values[i + 1], values[i + 2]};
  }
};

DecodedPng decoded_png(const StudyPicture& picture) {
  const TemporaryFolder folder;
  const std::string name = (folder.path() / "picture.png").string();
  std::ofstream(name, std::ios::binary)
      .write(reinterpret_cast<const char*>(picture.png.data()),
             static_cast<std::streamsize>(picture.png.size()));
  DecodedPng out;
  const auto input = OIIO::ImageInput::open(name);
  if (!input || input->spec().nchannels != 3) return out;
  out.width = input->spec().width;
  out.height = input->spec().height;
  out.values.resize(static_cast<std::size_t>(3 * out.width * out.height));
  input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, out.values.data());
  return out;
}

using Rgb = std::array<int, 3>;

TEST(DifferencePicture, ShowsTestReferenceAndDifferenceSideBySide) {
  LinearPicture test = plain(5, 2, 0.5f);
  const LinearPicture reference = plain(5, 2, 0.25f);
  test.plane[1][0] = 0.75f;  // the brightest difference counts: 0.5
  const StudyPicture picture = difference_picture("t", test, reference, 1, 100);
  const DecodedPng png = decoded_png(picture);
  ASSERT_EQ(png.width, 3 * 5 + 2 * 4);  // gaps of 4
  ASSERT_EQ(png.height, 2);
  EXPECT_EQ(picture.width_px, png.width);
  EXPECT_EQ(picture.height_px, png.height);
  // sRGB of 0.5, 0.25 and 0.75: 187.5, 137.0 and 224.6 of 255 (IEC 61966-2-1).
  EXPECT_EQ(png.at(1, 1), (Rgb{188, 188, 188}));
  EXPECT_EQ(png.at(0, 0), (Rgb{188, 225, 188}));
  EXPECT_EQ(png.at(9, 0), (Rgb{137, 137, 137}));
  EXPECT_EQ(png.at(6, 0), (Rgb{255, 255, 255}));  // the gap
  // The ramp: 3 x 0.5 = 1.5 is full red and half green; 3 x 0.25 = 0.75 of red: 191.25.
  EXPECT_EQ(png.at(18, 0), (Rgb{255, 128, 0}));
  EXPECT_EQ(png.at(19, 0), (Rgb{191, 0, 0}));
}

TEST(DifferencePicture, AveragesLightInBoxes) {
  LinearPicture test = plain(7, 4, 0);
  test.plane[0][0] = 1;  // one of 4 pixels of the first box: 0.25
  test.plane[0][6] = 1;  // one of 2: the last box is cut by the edge
  const DecodedPng png = decoded_png(difference_picture("t", test, plain(7, 4, 0), 4, 4));
  ASSERT_EQ(png.width, 3 * 4 + 2 * 4);
  ASSERT_EQ(png.height, 2);
  EXPECT_EQ(png.at(0, 0), (Rgb{137, 0, 0}));
  EXPECT_EQ(png.at(3, 0), (Rgb{188, 0, 0}));
  EXPECT_EQ(png.at(16, 0), (Rgb{255, 255, 255}));  // 0.25 times a gain of 4
  EXPECT_EQ(png.at(17, 0), (Rgb{0, 0, 0}));
}

TEST(DifferencePicture, WhatIsNoNumberShowsAsTheLargestDifference) {
  LinearPicture test = plain(1, 1, 0);
  test.plane[2][0] = std::numeric_limits<float>::quiet_NaN();
  const DecodedPng png = decoded_png(difference_picture("t", test, plain(1, 1, 0), 1, 1));
  ASSERT_EQ(png.width, 11);
  EXPECT_EQ(png.at(0, 0), (Rgb{0, 0, 0}));
  EXPECT_EQ(png.at(10, 0), (Rgb{255, 255, 255}));
}

TEST(DifferencePicture, TheSamePicturesGiveTheSameBytes) {
  const LinearPicture test = plain(30, 20, 0.3f), reference = plain(30, 20, 0.31f);
  EXPECT_EQ(difference_picture("t", test, reference, 16, 10).png,
            difference_picture("t", test, reference, 16, 10).png);
}

TEST(DifferencePicture, RefusesPicturesOfTwoSizes) {
  EXPECT_THROW(difference_picture("t", plain(2, 2, 0), plain(2, 1, 0), 1, 10), std::invalid_argument);
  EXPECT_THROW(difference_picture("t", plain(0, 0, 0), plain(0, 0, 0), 1, 10), std::invalid_argument);
  EXPECT_THROW(difference_picture("t", plain(2, 2, 0), plain(2, 2, 0), 0, 10), std::invalid_argument);
  EXPECT_THROW(difference_picture("t", plain(2, 2, 0), plain(2, 2, 0), 1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace herr
