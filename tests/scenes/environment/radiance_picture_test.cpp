// Radiance pictures: what each line of a header and each way of coding pixels means.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenes/environment/environment_files.h"

namespace herr::test {
namespace {

// 128 * 2^(129 - 136) = 1: a mantissa of 128 with this exponent is 1.
constexpr int kOne = 129;

// One pixel is not wide enough: the same one twice.
ReadEnvironment read_colour(const std::string& lines, const std::string& pixel) {
  return read_hdr(hdr_header(lines, "-Y 1 +X 2") + pixel + pixel);
}

void expect_colour(const ReadEnvironment& read, double r, double g, double b) {
  ASSERT_EQ(read.error, "");
  EXPECT_FLOAT_EQ(read.value(0, 0, 0), static_cast<float>(r));
  EXPECT_FLOAT_EQ(read.value(0, 0, 1), static_cast<float>(g));
  EXPECT_FLOAT_EQ(read.value(0, 0, 2), static_cast<float>(b));
}

TEST(RadiancePicture, APixelIsItsMantissasTimesTwoToTheExponentMinus136) {
  expect_colour(read_colour(kRgbeFormat, rgbe(128, 64, 32, kOne)), 1, 0.5, 0.25);
  expect_colour(read_colour(kRgbeFormat, rgbe(255, 1, 0, 136)), 255, 1, 0);
  expect_colour(read_colour(kRgbeFormat, rgbe(9, 9, 9, 0)), 0, 0, 0);  // an exponent of 0 is black
}

TEST(RadiancePicture, AllEightOrientationsShowTheSamePicture) {
  // 3 x 2 pixels; that in column x and row y, from the top left, has the red mantissa 10 + 3 y + x. A sign
  // says which way a coordinate goes while the file is read, with x to the right and y upwards: -Y begins at
  // the top.
  struct Orientation {
    const char* resolution;
    int x, y;                    // of the first pixel
    int scanline_x, scanline_y;  // one scanline further
    int pixel_x, pixel_y;        // one pixel further
  };
  const Orientation orientations[] = {
      {"-Y 2 +X 3", 0, 0, 0, 1, 1, 0},   {"-Y 2 -X 3", 2, 0, 0, 1, -1, 0},  {"+Y 2 +X 3", 0, 1, 0, -1, 1, 0},
      {"+Y 2 -X 3", 2, 1, 0, -1, -1, 0}, {"+X 3 -Y 2", 0, 0, 1, 0, 0, 1},   {"+X 3 +Y 2", 0, 1, 1, 0, 0, -1},
      {"-X 3 -Y 2", 2, 0, -1, 0, 0, 1},  {"-X 3 +Y 2", 2, 1, -1, 0, 0, -1},
  };
  for (const Orientation& one : orientations) {
    SCOPED_TRACE(one.resolution);
    const int scanlines = one.scanline_x == 0 ? 2 : 3, length = 5 - scanlines;
    std::string pixels;
    for (int s = 0; s < scanlines; ++s) {
      for (int i = 0; i < length; ++i) {
        const int x = one.x + s * one.scanline_x + i * one.pixel_x;
        const int y = one.y + s * one.scanline_y + i * one.pixel_y;
        pixels += rgbe(10 + 3 * y + x, 0, 0, 136);
      }
    }
    const ReadEnvironment read = read_hdr(hdr_header(kRgbeFormat, one.resolution) + pixels);
    ASSERT_EQ(read.error, "");
    ASSERT_EQ(read.image.width_px, 3);
    ASSERT_EQ(read.image.height_px, 2);
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 3; ++x) EXPECT_EQ(read.value(x, y, 0), static_cast<float>(10 + 3 * y + x));
    }
  }
}

TEST(RadiancePicture, RadianceIsThePixelDividedByAllExposures) {
  // "EXPOSURE values are cumulative": 2 / 4 = 0.5; 2 / (4 * 0.5) = 1. Blender writes blanks before the
  // number.
  const std::string two = rgbe(128, 128, 128, kOne + 1);
  const ReadEnvironment once = read_colour(kRgbeFormat + "EXPOSURE=4\n", two);
  expect_colour(once, 0.5, 0.5, 0.5);
  EXPECT_TRUE(once.remarks.empty());
  expect_colour(read_colour("EXPOSURE=4.0\n" + kRgbeFormat + "EXPOSURE= 5e-1\n", two), 1, 1, 1);
  expect_colour(read_colour(kRgbeFormat + "EXPOSURE=      1.0000000000000\n", two), 2, 2, 2);
  expect_colour(read_colour(kRgbeFormat + "EXPOSURE = 4\n", two), 0.5, 0.5, 0.5);
  // Of an earlier file, so says the tab.
  expect_colour(read_colour(kRgbeFormat + "pcomb a.hdr\n\tEXPOSURE=4\n", two), 2, 2, 2);
}

TEST(RadiancePicture, ColourCorrectionsDivideEachChannel) {
  // 1 / (2 * 2), 1 / (4 * 1), 1 / (0.5 * 1), each divided by the exposure of 2.
  expect_colour(read_colour(kRgbeFormat + "COLORCORR=2 4 0.5\nEXPOSURE=2\nCOLORCORR= 2 1 1\n",
                            rgbe(128, 128, 128, kOne)),
                0.125, 0.125, 1);
}

TEST(RadiancePicture, AFactorThatIsNoneIsRemarkedAndTakenAsOne) {
  for (const char* line : {"EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=nan", "EXPOSURE=", "EXPOSURE=1 2",
                           "COLORCORR=1 2", "COLORCORR=1 0 1", "COLORCORR=1 2 3 4"}) {
    const ReadEnvironment read = read_colour(kRgbeFormat + line + "\n", rgbe(128, 128, 128, kOne));
    expect_colour(read, 1, 1, 1);
    EXPECT_TRUE(any_contains(read.remarks, line)) << line;
  }
  std::string exposures;
  for (int i = 0; i < 40; ++i) exposures += "EXPOSURE=1e-10\n";
  EXPECT_TRUE(contains(read_colour(exposures, rgbe(1, 1, 1, 99)).error, "product is out of range"));
}

TEST(RadiancePicture, XyzBecomesRgbByTheFormatsOwnPrimaries) {
  // Rows of xyz_rgb.cal of Radiance, three decimals: R = 2.565 X - 1.167 Y - 0.398 Z and so on. A colour
  // inside the gamut, all of it 128-based: X = 1, Y = 0.75, Z = 0.5.
  const double x = 1, y = 0.75, z = 0.5;
  const double expected[3] = {2.565 * x - 1.167 * y - 0.398 * z, -1.022 * x + 1.978 * y + 0.044 * z,
                              0.075 * x - 0.252 * y + 1.177 * z};
  const std::string format = "FORMAT=32-bit_rle_xyze\n";
  const ReadEnvironment read = read_colour(format, rgbe(128, 96, 64, kOne));
  ASSERT_EQ(read.error, "");
  // Half a unit of the third decimal in each of three coefficients.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(read.value(0, 0, c), expected[c], 0.0015) << c;
  EXPECT_TRUE(read.remarks.empty());
  // Equal X, Y and Z are the format's white, of the same number: the rows of the inverse add up to 1.
  expect_colour(read_colour(format, rgbe(128, 128, 128, kOne)), 1, 1, 1);
  // Exposure divides before.
  expect_colour(read_colour(format + "EXPOSURE=2\n", rgbe(128, 128, 128, kOne)), 0.5, 0.5, 0.5);
  // Y alone is greener than any screen: red and blue would be -1.167 and -0.252.
  const ReadEnvironment green = read_colour(format, rgbe(0, 128, 0, kOne));
  EXPECT_NEAR(green.value(0, 0, 1), 1.978, 0.0005);
  EXPECT_EQ(green.value(0, 0, 0), 0);
  EXPECT_EQ(green.value(0, 0, 2), 0);
  EXPECT_TRUE(any_contains(green.remarks, "4 values are negative"));
}

TEST(RadiancePicture, WithoutAFormatLineItIsRgbeAndRemarked) {
  const ReadEnvironment read = read_colour("GAMMA=1.0\n", rgbe(128, 64, 32, kOne));
  expect_colour(read, 1, 0.5, 0.25);
  ASSERT_EQ(read.remarks.size(), 1u);
  EXPECT_TRUE(any_contains(read.remarks, "no FORMAT line"));
}

TEST(RadiancePicture, UnusualHeadersAreReadToo) {
  const std::string one = rgbe(128, 128, 128, kOne);
  // Another program's name, comments, line ends of Windows, blanks, lines without meaning for colours.
  const ReadEnvironment read = read_hdr(
      "#?RGBE\r\n# Made with 100% pure HDR Shop\r\nFORMAT= 32-bit_rle_rgbe \r\nVIEW= -vta -vh 360\r\n"
      "SOFTWARE=a=b\r\nPRIMARIES=.64 .33 .29 .6 .15 .06 .3333 .3333\r\nPIXASPECT=1\r\n\r\n-Y  1   +X +2\r\n" +
      one + one);
  expect_colour(read, 1, 1, 1);
  EXPECT_TRUE(read.remarks.empty());
  EXPECT_TRUE(
      read_colour(kRgbeFormat + "GAMMA=1\nPRIMARIES=0 0 0 0 0 0 0 0\n", one).remarks.empty());  // Photoshop
  EXPECT_TRUE(any_contains(read_colour(kRgbeFormat + "GAMMA=2.2\n", one).remarks, "GAMMA=2.2"));
  EXPECT_TRUE(any_contains(
      read_colour(kRgbeFormat + "PRIMARIES=.7347 .2653 0 1 .0001 -.077 .32168 .33767\n", one).remarks,
      "PRIMARIES"));
}

TEST(RadiancePicture, RunsByComponentAreUndone) {
  // Eight pixels: red a run of 8 times 128; green 3 and 5 literal bytes; blue a literal and a run of 7; the
  // exponent a run of 8.
  std::string line = rgbe(2, 2, 0, 8);
  const auto add = [&](std::initializer_list<int> bytes) {
    for (const int byte : bytes) line += static_cast<char>(byte);
  };
  add({128 + 8, 128, 3, 1, 2, 3, 5, 4, 5, 6, 7, 8, 1, 200, 128 + 7, 100, 128 + 8, 136});
  const ReadEnvironment read = read_hdr(hdr_header(kRgbeFormat, "-Y 1 +X 8") + line);
  ASSERT_EQ(read.error, "");
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ(read.value(x, 0, 0), 128);
    EXPECT_EQ(read.value(x, 0, 1), static_cast<float>(x + 1));
    EXPECT_EQ(read.value(x, 0, 2), x == 0 ? 200 : 100);
  }
}

TEST(RadiancePicture, OlderRunsOfWholePixelsAreUndone) {
  // 1, 1, 1, n repeats the pixel before n times; a second such pixel in a row counts 256 times as much:
  // 1 + 4 + 256 + 1 = 262 pixels.
  const std::string line = rgbe(50, 0, 0, 136) + rgbe(1, 1, 1, 4) + rgbe(1, 1, 1, 1) + rgbe(60, 0, 0, 136);
  const ReadEnvironment read = read_hdr(hdr_header(kRgbeFormat, "-Y 1 +X 262") + line);
  ASSERT_EQ(read.error, "");
  for (int x = 0; x < 261; ++x) ASSERT_EQ(read.value(x, 0, 0), 50) << x;
  EXPECT_EQ(read.value(261, 0, 0), 60);
}

TEST(RadiancePicture, EachFaultIsNamed) {
  const std::string pixels = rgbe(9, 9, 9, 128) + rgbe(9, 9, 9, 128);
  const std::string eight = hdr_header(kRgbeFormat, "-Y 1 +X 8");
  const struct {
    std::string bytes, expected;
  } faults[] = {
      {"#?RADIANCE\n", "no end of its header"},
      {"#?RADIANCE\n" + std::string(5000, 'x') + "\n\n-Y 1 +X 2\n" + pixels, "no end of its header"},
      {hdr_header("FORMAT=32-bit_rle_abcd\n", "-Y 1 +X 2") + pixels, "\"32-bit_rle_abcd\""},
      {hdr_header(kRgbeFormat + "FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 2") + pixels, "two FORMAT lines"},
      {hdr_header(kRgbeFormat, "-Y 1 +Y 2") + pixels, "\"-Y 1 +Y 2\""},
      {hdr_header(kRgbeFormat, "-Y 1 +X") + pixels, "resolution"},
      {hdr_header(kRgbeFormat, "-Y -1 +X 2") + pixels, "resolution"},
      {hdr_header(kRgbeFormat, "-Y 1 +X 99999999999") + pixels, "resolution"},
      {hdr_header(kRgbeFormat, "-Y 1 +X 2 3") + pixels, "resolution"},
      {hdr_header(kRgbeFormat, "-X 40000 +Y 80000"), "40000 x 80000 pixels"},
      {hdr_header(kRgbeFormat, "-Y 2 +X 2") + pixels, "scanline 1 ends early"},
      {eight + rgbe(2, 2, 0, 9), "has 9 pixels"},
      {eight + rgbe(2, 2, 0, 8) + rgbe(128 + 9, 1, 0, 0), "run that does not fit"},
      {eight + rgbe(2, 2, 0, 8) + rgbe(0, 1, 0, 0), "run that does not fit"},
      {eight + rgbe(1, 1, 1, 8), "run of nothing"},
      {eight + rgbe(5, 5, 5, 8) + rgbe(1, 1, 1, 8), "run that does not fit"},
  };
  for (const auto& fault : faults) {
    const std::string error = read_hdr(fault.bytes).error;
    EXPECT_TRUE(contains(error, fault.expected)) << fault.expected << ": \"" << error << "\"";
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
}

TEST(RadiancePicture, ByteFlipsAreReadOrRefused) {
  std::string whole = hdr_header(kRgbeFormat + "EXPOSURE=2\nCOLORCORR=1 1 1\n", "-Y 2 +X 8");
  for (int row = 0; row < 2; ++row) {
    whole += rgbe(2, 2, 0, 8);
    for (int c = 0; c < 4; ++c) whole += std::string{static_cast<char>(128 + 8), static_cast<char>(130 + c)};
  }
  ASSERT_EQ(read_hdr(whole).error, "");
  int refused = 0;
  for (std::size_t at = 2; at < whole.size(); ++at) {
    for (const char value : {'\0', '\x01', '\x7f', '\xff', '\n'}) {
      std::string bytes = whole;
      bytes[at] = value;
      refused += read_hdr_bytes(bytes).error.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(EnvironmentImage, OtherShapesThanTwoToOneAreRemarked) {
  const TemporaryFolder folder;
  const auto remarks = [&](const std::string& resolution, int pixels) {
    std::string bytes = hdr_header(kRgbeFormat, resolution);
    for (int i = 0; i < pixels; ++i) bytes += rgbe(9, 9, 9, 128);
    std::vector<std::string> texts;
    read_environment_image(folder.write("sky.hdr", bytes), texts);
    return texts;
  };
  EXPECT_TRUE(remarks("-Y 3 +X 6", 18).empty());
  EXPECT_TRUE(any_contains(remarks("-Y 6 +X 6", 36), "twice as wide as high"));
}

TEST(EnvironmentImage, AnotherFormatIsRefusedWithTheFormatsThatAreRead) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(read_environment(folder.write("a.tif", "II*\0")).error, "Radiance, EXR, PNG or JPEG"));
  EXPECT_TRUE(contains(read_environment(folder.write("a.hdr", "")).error, "is empty"));
}

}  // namespace
}  // namespace herr::test
