#include "sessions/camera/camera_image.h"

#include <Imath/half.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "sessions/camera/half_from_samples.h"
#include "sessions/files/input_error.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::RecordedFolder;

double value_of(std::uint16_t bits) {
  Imath::half half;
  half.setBits(bits);
  return static_cast<float>(half);
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

template <typename Sample>
void write(const std::filesystem::path& file, OIIO::ImageSpec spec, const std::vector<Sample>& samples,
           OIIO::TypeDesc type) {
  const auto writer = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(writer && writer->open(file.string(), spec) && writer->write_image(type, samples.data()) &&
              writer->close());
}

// The half nearest to `value`, by trying all: slow and obvious.
std::uint16_t nearest_half(double value) {
  std::uint16_t best = 0;
  for (std::uint16_t bits = 0; bits <= 0x7bff; ++bits)
    if (std::abs(value_of(bits) - value) < std::abs(value_of(best) - value)) best = bits;
  return best;
}

TEST(SrgbTable, HoldsTheNearestHalfOfEveryCode) {
  for (std::size_t code = 0; code < 256; ++code) {
    const double encoded = static_cast<double>(code) / 255;
    const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    EXPECT_EQ(half_from_srgb8()[code], nearest_half(linear)) << code;
    EXPECT_EQ(half_from_srgb16()[code * 257], half_from_srgb8()[code]) << "65535 = 255 * 257";
  }
  EXPECT_EQ(value_of(half_from_srgb8()[0]), 0);
  EXPECT_EQ(value_of(half_from_srgb8()[255]), 1);
}

TEST(LinearSamples, AreMadeFiniteAndCounted) {
  std::int64_t sanitised = 0;
  EXPECT_EQ(value_of(half_from_linear(0.25f, sanitised)), 0.25);
  EXPECT_EQ(half_from_linear(-0.0f, sanitised), 0) << "no negative zero";
  EXPECT_EQ(value_of(half_from_linear(65504.0f, sanitised)), 65504);
  EXPECT_EQ(sanitised, 0);
  EXPECT_EQ(half_from_linear(std::numeric_limits<float>::quiet_NaN(), sanitised), 0);
  EXPECT_EQ(half_from_linear(-1.0f, sanitised), 0);
  EXPECT_EQ(half_from_linear(-std::numeric_limits<float>::infinity(), sanitised), 0);
  EXPECT_EQ(value_of(half_from_linear(std::numeric_limits<float>::infinity(), sanitised)), 65504);
  EXPECT_EQ(value_of(half_from_linear(1e6f, sanitised)), 65504);
  EXPECT_EQ(sanitised, 5);
}

TEST(CameraImage, IsReadFromEachFormatAtItsSize) {
  const RecordedFolder folder;
  for (const std::string name : {"a.png", "a.jpg", "a.jpeg", "a.exr", "A.PNG"}) {
    folder.write_image(name, 7, 5);
    const ImageSize size = read_image_size(folder / name);
    EXPECT_EQ(size.width_px, 7);
    EXPECT_EQ(size.height_px, 5);
    const CameraImage image = read_camera_image(folder / name);
    EXPECT_EQ(image.width_px, 7);
    EXPECT_EQ(image.height_px, 5);
    ASSERT_EQ(image.rgba_half.size(), 4u * 35);
    // Encoded 0.5 is code 128 (rounded), linear 0.2159; a JPEG may be a code off (2 * 0.2159 / 128 = 0.004).
    const bool exr = name == "a.exr";
    EXPECT_NEAR(value_of(image.rgba_half[4]), exr ? 0.5 : 0.2159, 0.005) << name;
    EXPECT_EQ(image.rgba_half[7], kHalfOne);
    EXPECT_EQ(image.sanitised_values, 0);
  }
}

TEST(CameraImage, KeepsEveryCodeOfAPngInItsPlace) {
  std::vector<std::uint8_t> samples(16 * 16 * 3);
  for (std::size_t i = 0; i < 256; ++i) {
    samples[3 * i] = static_cast<std::uint8_t>(i);
    samples[3 * i + 1] = static_cast<std::uint8_t>(255 - i);
    samples[3 * i + 2] = static_cast<std::uint8_t>(i ^ 0x55);
  }
  const RecordedFolder folder;
  write(folder / "a.png", {16, 16, 3, OIIO::TypeDesc::UINT8}, samples, OIIO::TypeDesc::UINT8);
  const CameraImage image = read_camera_image(folder / "a.png");
  for (std::size_t i = 0; i < 256; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(image.rgba_half[4 * i + c], half_from_srgb8()[samples[3 * i + c]]) << i;
}

TEST(CameraImage, ReadsGreyAlphaAnd16Bits) {
  const RecordedFolder folder;
  write<std::uint8_t>(folder / "grey.png", {1, 1, 1, OIIO::TypeDesc::UINT8}, {200}, OIIO::TypeDesc::UINT8);
  CameraImage image = read_camera_image(folder / "grey.png");
  const std::uint16_t code200 = half_from_srgb8()[200];
  EXPECT_EQ(image.rgba_half, (std::vector<std::uint16_t>{code200, code200, code200, kHalfOne}));

  OIIO::ImageSpec alpha(1, 1, 4, OIIO::TypeDesc::UINT8);
  alpha.attribute("oiio:UnassociatedAlpha", 1);
  write<std::uint8_t>(folder / "alpha.png", alpha, {200, 100, 50, 10}, OIIO::TypeDesc::UINT8);
  image = read_camera_image(folder / "alpha.png");
  const auto& table = half_from_srgb8();
  EXPECT_EQ(image.rgba_half, (std::vector<std::uint16_t>{table[200], table[100], table[50], kHalfOne}));

  write<std::uint16_t>(folder / "deep.png", {1, 1, 3, OIIO::TypeDesc::UINT16}, {0, 12345, 65535},
                       OIIO::TypeDesc::UINT16);
  image = read_camera_image(folder / "deep.png");
  EXPECT_EQ(image.rgba_half, (std::vector<std::uint16_t>{0, half_from_srgb16()[12345], kHalfOne, kHalfOne}));
}

TEST(CameraImage, IgnoresWhatAPngSaysBesidesItsPixelsAndPrintsNothing) {
  const RecordedFolder folder;
  OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "Linear");  // becomes a gAMA chunk
  spec.attribute("Description", "a text");
  write<std::uint8_t>(folder / "a.png", spec, {200, 100, 50}, OIIO::TypeDesc::UINT8);
  std::string bytes = bytes_of(folder / "a.png");
  ASSERT_NE(bytes.find("gAMA"), std::string::npos);
  testing::internal::CaptureStderr();
  const CameraImage image = read_camera_image(folder / "a.png");
  EXPECT_EQ(image.rgba_half[0], half_from_srgb8()[200]);
  // One bit of the pixels turned over: refused by checksum.
  bytes[bytes.find("IDAT") + 6] = static_cast<char>(bytes[bytes.find("IDAT") + 6] ^ 1);
  folder.write("bit.png", bytes);
  EXPECT_INPUT_ERROR(read_camera_image(folder / "bit.png"), "a checksum does not fit");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(CameraImage, SanitisesAnExrAndCounts) {
  const RecordedFolder folder;
  const float inf = std::numeric_limits<float>::infinity();
  OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", std::string("none"));
  write<float>(folder / "a.exr", spec, {NAN, -1, 0.5f, inf, 1e9f, 2}, OIIO::TypeDesc::FLOAT);
  const CameraImage image = read_camera_image(folder / "a.exr");
  EXPECT_EQ(image.sanitised_values, 4);
  const double expected[] = {0, 0, 0.5, 1, 65504, 65504, 2, 1};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(value_of(image.rgba_half[i]), expected[i]) << i;
}

void expect_refused(const std::filesystem::path& file, const std::string& part) {
  EXPECT_INPUT_ERROR(read_image_size(file), part);
  EXPECT_INPUT_ERROR(read_camera_image(file), part);
}

TEST(CameraImage, RefusesWhatItMustNotDecode) {
  const RecordedFolder folder;
  folder.write_image("a.png", 4, 4);
  folder.write_image("a.jpg", 4, 4);
  folder.write("renamed.jpg", bytes_of(folder / "a.png"));
  folder.write("renamed.png", bytes_of(folder / "a.jpg"));
  folder.write("text.png", "hello, this is no image");
  folder.write("empty.png", "");
  std::filesystem::create_directory(folder / "folder.png");
  ASSERT_EQ(::mkfifo((folder / "pipe.png").c_str(), 0600), 0);
  expect_refused(folder / "absent.png", "cannot be opened");
  expect_refused(folder / "renamed.jpg", "holds png data under another extension");
  expect_refused(folder / "renamed.png", "holds jpeg data under another extension");
  expect_refused(folder / "text.png", "is not a JPEG, PNG or OpenEXR image");
  expect_refused(folder / "empty.png", "is empty");
  expect_refused(folder / "folder.png", "is a folder");
  expect_refused(folder / "pipe.png", "is not a regular file");
}

TEST(CameraImage, RefusesAHeaderOfGiantSizeBeforeAllocating) {
  const RecordedFolder folder;
  folder.write_image("a.png", 4, 4);
  std::string bytes = bytes_of(folder / "a.png");
  // Width stands at byte 16 of a PNG; the checksum at byte 29 no longer fits.
  bytes.replace(16, 4, std::string("\x00\x00\xff\xff", 4));
  folder.write("big.png", bytes);
  expect_refused(folder / "big.png", "a checksum does not fit");
  OIIO::ImageSpec wide(16385, 1, 1, OIIO::TypeDesc::UINT8);
  write(folder / "wide.png", wide, std::vector<std::uint8_t>(16385), OIIO::TypeDesc::UINT8);
  expect_refused(folder / "wide.png", "has 16385 x 1 pixels");
}

TEST(CameraImage, RefusesUnusualExr) {
  const RecordedFolder folder;
  const std::vector<float> samples(64 * 64 * 5, 0.5f);
  OIIO::ImageSpec tiled(64, 64, 3, OIIO::TypeDesc::HALF);
  tiled.tile_width = tiled.tile_height = 32;
  write(folder / "tiled.exr", tiled, samples, OIIO::TypeDesc::FLOAT);
  expect_refused(folder / "tiled.exr", "is a tiled EXR");
  OIIO::ImageSpec piz(64, 64, 3, OIIO::TypeDesc::HALF);
  piz.attribute("compression", std::string("piz"));
  write(folder / "piz.exr", piz, samples, OIIO::TypeDesc::FLOAT);
  expect_refused(folder / "piz.exr", "is an EXR with compression piz");
  OIIO::ImageSpec offset(64, 64, 3, OIIO::TypeDesc::HALF);
  offset.x = 8;
  offset.attribute("compression", std::string("zip"));
  write(folder / "offset.exr", offset, samples, OIIO::TypeDesc::FLOAT);
  expect_refused(folder / "offset.exr", "data window is not its display window");
  OIIO::ImageSpec five(64, 64, 5, OIIO::TypeDesc::HALF);
  five.attribute("compression", std::string("zip"));
  write(folder / "five.exr", five, samples, OIIO::TypeDesc::FLOAT);
  expect_refused(folder / "five.exr", "has 5 channels");
}

TEST(CameraImage, RefusesTruncatedDataWhereverItEnds) {
  const RecordedFolder folder;
  for (const std::string name : {"a.png", "a.jpg", "a.exr"}) {
    // Noise, so that the pixels do not compress into the last few bytes.
    std::vector<float> samples(64 * 64 * 3);
    std::uint32_t state = 1;
    for (float& sample : samples)
      sample = static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.f;
    OIIO::ImageSpec spec(64, 64, 3, name == "a.exr" ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
    spec.attribute("compression", std::string(name == "a.jpg" ? "jpeg" : "zip"));
    write(folder / name, spec, samples, OIIO::TypeDesc::FLOAT);
    const std::string bytes = bytes_of(folder / name);
    ASSERT_EQ(test::error_of([&] { read_camera_image(folder / name); }), "no error") << name;
    for (const double part : {0.01, 0.1, 0.5, 0.9, 0.99, 0.999}) {
      const auto length = static_cast<std::size_t>(part * static_cast<double>(bytes.size()));
      folder.write("cut_" + name, bytes.substr(0, length));
      EXPECT_NE(test::error_of([&] { read_camera_image(folder / ("cut_" + name)); }), "no error")
          << name << ' ' << part;
    }
  }
}

TEST(CameraImage, ReadsFramesOfRealGlasses) {
  const std::filesystem::path folder = test::real_data() / "frames/aria_aea";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recordings beside the project";
  int frames = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".jpg") continue;
    const ImageSize size = read_image_size(entry.path());
    EXPECT_GE(size.width_px, 480);
    if (frames++ > 0) continue;
    EXPECT_EQ(read_camera_image(entry.path()).width_px, size.width_px);
  }
  EXPECT_GE(frames, 14);
}

}  // namespace
}  // namespace herr
