#include "server/output/png_encoder.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace herr {
namespace {

Srgb8Image random_pixels(int width, int height, int channels, unsigned seed) {
  std::mt19937 engine(seed);
  Srgb8Image image;
  image.width_px = width;
  image.height_px = height;
  image.channels = channels;
  image.values.resize(static_cast<std::size_t>(width * height * channels));
  for (auto& value : image.values) value = static_cast<std::uint8_t>(engine());
  return image;
}

std::vector<std::uint8_t> decoded(const std::vector<std::uint8_t>& file, Srgb8Image& size) {
  const TemporaryFolder folder;
  const std::string name = (folder.path() / "picture.png").string();
  std::ofstream(name, std::ios::binary)
      .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // the values of the file as they are
  const auto input = OIIO::ImageInput::open(name, &config);
  if (!input) return {};
  const OIIO::ImageSpec& spec = input->spec();
  size.width_px = spec.width;
  size.height_px = spec.height;
  size.channels = spec.nchannels;
  std::vector<std::uint8_t> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, values.data())) return {};
  return values;
}

TEST(PngEncoder, PixelsComeBackAsTheyWere) {
  for (const int channels : {3, 4}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {64, 33}, {401, 7}}) {
      const Srgb8Image image = random_pixels(width, height, channels, 7);
      std::vector<std::uint8_t> file;
      encode_png(image, file);
      Srgb8Image size;
      EXPECT_EQ(decoded(file, size), image.values) << width << "x" << height << "x" << channels;
      EXPECT_EQ(size.width_px, width);
      EXPECT_EQ(size.height_px, height);
      EXPECT_EQ(size.channels, channels);
    }
  }
}

TEST(PngEncoder, SamePixelsGiveSameBytesWhateverTheBufferHeldBefore) {
  const Srgb8Image image = random_pixels(50, 20, 3, 3);
  std::vector<std::uint8_t> first, second(999'999, 0xAB);
  encode_png(image, first);
  encode_png(image, second);
  EXPECT_EQ(first, second);
}

TEST(PngEncoder, AFileThatWasCutOffDoesNotDecode) {
  const Srgb8Image image = random_pixels(50, 20, 3, 3);
  std::vector<std::uint8_t> file;
  encode_png(image, file);
  file.resize(file.size() / 2);
  Srgb8Image size;
  EXPECT_TRUE(decoded(file, size).empty());
}

TEST(PngEncoder, HoldsNoTime) {
  std::vector<std::uint8_t> file;
  encode_png(random_pixels(5, 5, 3, 3), file);
  const std::string text(file.begin(), file.end());
  for (const char* mark : {"tIME", "date", "Date"}) EXPECT_EQ(text.find(mark), std::string::npos) << mark;
}

}  // namespace
}  // namespace herr
