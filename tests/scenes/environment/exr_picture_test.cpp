// EXR pictures of environments: layers, further channels, windows, compressions, and what is refused how.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <random>

#include "tests/scenes/environment/environment_files.h"

namespace herr::test {
namespace {

OIIO::ImageSpec spec_of(int width, int height, std::vector<std::string> channels,
                        const std::string& compression = "zip", OIIO::TypeDesc type = OIIO::TypeDesc::HALF) {
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), type);
  spec.channelnames = std::move(channels);
  spec.attribute("compression", compression);
  return spec;
}

// By OpenImageIO, which is another implementation of the format than the one under test.
void write_exr(const std::filesystem::path& file, const OIIO::ImageSpec& spec,
               const std::vector<float>& values) {
  const auto writer = OIIO::ImageOutput::create(file.string());
  const bool tiled = spec.tile_width > 0;
  if (!writer || !writer->open(file.string(), spec) ||
      !(tiled ? writer->write_tiles(0, spec.width, 0, spec.height, 0, 1, OIIO::TypeDesc::FLOAT, values.data())
              : writer->write_image(OIIO::TypeDesc::FLOAT, values.data())) ||
      !writer->close()) {
    throw std::runtime_error("cannot write " + file.string() + ": " + OIIO::geterror());
  }
}

// A value for each pixel and channel that half holds exactly: 1024 + a whole number below 1024.
float sample(int x, int y, std::size_t channel) {
  return static_cast<float>(1024 + (37 * x + 101 * y + 331 * static_cast<int>(channel)) % 1024);
}
std::vector<float> samples(const OIIO::ImageSpec& spec) {
  std::vector<float> values;
  for (int y = 0; y < spec.height; ++y) {
    for (int x = 0; x < spec.width; ++x) {
      for (std::size_t c = 0; c < spec.channelnames.size(); ++c)
        values.push_back(sample(x + spec.x, y + spec.y, c));
    }
  }
  return values;
}

ReadEnvironment read_exr(const OIIO::ImageSpec& spec) {
  const TemporaryFolder folder;
  write_exr(folder.path() / "sky.exr", spec, samples(spec));
  return read_environment(folder.path() / "sky.exr");
}

// Red, green and blue are the channels of these numbers in the file that was written.
void expect_channels(const ReadEnvironment& read, std::size_t red, std::size_t green, std::size_t blue) {
  ASSERT_EQ(read.error, "");
  const std::size_t channels[3] = {red, green, blue};
  for (int y = 0; y < read.image.height_px; ++y) {
    for (int x = 0; x < read.image.width_px; ++x) {
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(read.value(x, y, c), sample(x, y, channels[c])) << x << ", " << y << ", " << c;
    }
  }
}

TEST(ExrPicture, EverySafeCompressionOfHalfAndFloatGivesTheSamePixels) {
  // 41 rows are two blocks of 16 and one of 9 in zip.
  for (const char* compression : {"none", "rle", "zips", "zip"}) {
    for (const OIIO::TypeDesc type : {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT}) {
      SCOPED_TRACE(compression);
      const ReadEnvironment read = read_exr(spec_of(83, 41, {"R", "G", "B"}, compression, type));
      expect_channels(read, 0, 1, 2);
      EXPECT_TRUE(read.remarks.empty());
    }
  }
}

TEST(ExrPicture, LinesStoredFromTheBottomUpAreThePictureAllTheSame) {
  for (const char* compression : {"none", "zips", "zip"}) {
    OIIO::ImageSpec spec = spec_of(24, 41, {"R", "G", "B"}, compression);
    spec.attribute("openexr:lineOrder", "decreasingY");
    expect_channels(read_exr(spec), 0, 1, 2);
  }
}

TEST(ExrPicture, RunsOfEqualPixelsAreUndone) {
  // Long runs for RLE: all pixels alike, and a single one that differs.
  for (const char* compression : {"rle", "zips", "zip"}) {
    const OIIO::ImageSpec spec = spec_of(600, 20, {"R", "G", "B"}, compression);
    std::vector<float> values(3 * 600 * 20, 0.5f);
    values[3 * (600 * 7 + 300) + 1] = 2;
    const TemporaryFolder folder;
    write_exr(folder.path() / "sky.exr", spec, values);
    const ReadEnvironment read = read_environment(folder.path() / "sky.exr");
    ASSERT_EQ(read.error, "");
    for (std::size_t i = 0; i < 600 * 20; ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_EQ(read.image.rgba[4 * i + c], values[3 * i + c]) << compression << " " << i;
    }
  }
}

TEST(ExrPicture, AlphaIsLeftOutAndFurtherChannelsAreRemarked) {
  const ReadEnvironment rgba = read_exr(spec_of(8, 4, {"R", "G", "B", "A"}));
  expect_channels(rgba, 0, 1, 2);
  EXPECT_TRUE(rgba.remarks.empty());
  const ReadEnvironment depth = read_exr(spec_of(8, 4, {"R", "G", "B", "A", "Z"}));
  expect_channels(depth, 0, 1, 2);
  ASSERT_EQ(depth.remarks.size(), 1u);
  EXPECT_EQ(depth.remarks[0], "shows the channels R, G, B; not used: Z");
}

TEST(ExrPicture, TheColoursOfALayerAreFound) {
  expect_channels(read_exr(spec_of(8, 4, {"Combined.R", "Combined.G", "Combined.B"})), 0, 1, 2);
  // Channels without a layer before all layers, Combined before others, else the first by name.
  expect_channels(read_exr(spec_of(8, 4, {"A.R", "A.G", "A.B", "R", "G", "B"})), 3, 4, 5);
  const ReadEnvironment blender = read_exr(
      spec_of(8, 4,
              {"ViewLayer.AO.R", "ViewLayer.AO.G", "ViewLayer.AO.B", "ViewLayer.Combined.R",
               "ViewLayer.Combined.G", "ViewLayer.Combined.B", "ViewLayer.Combined.A", "ViewLayer.Depth.Z"}));
  expect_channels(blender, 3, 4, 5);
  ASSERT_EQ(blender.remarks.size(), 1u);
  EXPECT_TRUE(contains(blender.remarks[0], "shows the channels ViewLayer.Combined.R"));
  EXPECT_TRUE(contains(blender.remarks[0], "ViewLayer.Depth.Z"));
  const ReadEnvironment two = read_exr(spec_of(8, 4, {"b.red", "b.green", "b.blue", "a.R", "a.G", "a.B"}));
  expect_channels(two, 3, 4, 5);
  EXPECT_EQ(two.remarks.size(), 1u);
  expect_channels(read_exr(spec_of(8, 4, {"only.red", "only.green", "only.blue"})), 0, 1, 2);
}

TEST(ExrPicture, GreyIsEqualInAllColours) {
  expect_channels(read_exr(spec_of(8, 4, {"Y"})), 0, 0, 0);
  expect_channels(read_exr(spec_of(8, 4, {"Y", "A"})), 0, 0, 0);
  // An axis of a vector is no brightness.
  const ReadEnvironment normals = read_exr(spec_of(8, 4, {"N.X", "N.Y", "N.Z"}));
  EXPECT_TRUE(contains(normals.error, "channels (N.X, N.Y, N.Z) are neither R, G, B nor Y")) << normals.error;
}

// The display window is the picture, wherever it begins; `full_` is OpenImageIO's name for it.
OIIO::ImageSpec windows(int x, int y, int width, int height, int full_x, int full_y, int full_width,
                        int full_height, const char* compression) {
  OIIO::ImageSpec spec = spec_of(width, height, {"R", "G", "B"}, compression);
  spec.x = x, spec.y = y;
  spec.full_x = full_x, spec.full_y = full_y, spec.full_width = full_width, spec.full_height = full_height;
  return spec;
}

TEST(ExrPicture, TheDisplayWindowIsThePictureWhateverTheDataWindow) {
  struct Case {
    int x, y, width, height;  // data
    bool whole;               // no part of the picture is without data
  };
  // The picture is 40 x 20 from (-5, 10) on. Data: a part inside, more than all of it, a part beyond a
  // corner.
  const Case cases[] = {
      {0, 13, 20, 7, false}, {-9, 3, 60, 40, true}, {20, 25, 30, 30, false}, {-5, 10, 40, 20, true}};
  for (const char* compression : {"none", "rle", "zips", "zip"}) {
    for (const Case& one : cases) {
      SCOPED_TRACE(one.x);
      const ReadEnvironment read =
          read_exr(windows(one.x, one.y, one.width, one.height, -5, 10, 40, 20, compression));
      ASSERT_EQ(read.error, "");
      ASSERT_EQ(read.image.width_px, 40);
      ASSERT_EQ(read.image.height_px, 20);
      EXPECT_EQ(read.remarks.empty(), one.whole);
      for (int y = 10; y < 30; ++y) {
        for (int x = -5; x < 35; ++x) {
          const bool data = x >= one.x && x < one.x + one.width && y >= one.y && y < one.y + one.height;
          for (int c = 0; c < 3; ++c) {
            ASSERT_EQ(read.value(x + 5, y - 10, c), data ? sample(x, y, static_cast<std::size_t>(c)) : 0)
                << x << ", " << y;
          }
        }
      }
    }
  }
  EXPECT_TRUE(
      contains(read_exr(windows(100, 0, 8, 8, 0, 0, 40, 20, "zip")).error, "outside its display window"));
}

TEST(ExrPicture, ValuesOutOfRangeAreCounted) {
  const float inf = std::numeric_limits<float>::infinity();
  const OIIO::ImageSpec spec = spec_of(2, 1, {"R", "G", "B"}, "none", OIIO::TypeDesc::FLOAT);
  const TemporaryFolder folder;
  write_exr(folder.path() / "sky.exr", spec, {NAN, -1, 0.1f, inf, 1e9f, 65504});
  const ReadEnvironment read = read_environment(folder.path() / "sky.exr");
  const float expected[2][3] = {{0, 0, 0.1f}, {65504, 65504, 65504}};
  for (int x = 0; x < 2; ++x) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(read.value(x, 0, c), expected[x][c]);
  }
  EXPECT_TRUE(any_contains(read.remarks, "4 values are negative, not finite or above 65504"));
}

TEST(ExrPicture, WhatIsNotDecodedIsRefusedWithTheCommandThatConvertsIt) {
  const std::string remedy = "oiiotool IN.exr --scanline --compression zip -o OUT.exr";
  for (const std::string compression : {"piz", "pxr24", "b44", "b44a", "dwaa", "dwab"}) {
    const std::string error = read_exr(spec_of(64, 32, {"R", "G", "B"}, compression)).error;
    EXPECT_TRUE(contains(error, "compression " + compression)) << error;
    EXPECT_TRUE(contains(error, remedy)) << error;
  }
  OIIO::ImageSpec tiled = spec_of(64, 32, {"R", "G", "B"});
  tiled.tile_width = tiled.tile_height = 16;
  const std::string error = read_exr(tiled).error;
  EXPECT_TRUE(contains(error, "is a tiled EXR") && contains(error, remedy)) << error;
  // Flags of the version field, byte 5: 8 is deep, 16 several parts.
  const TemporaryFolder folder;
  for (const auto& [flag, part] :
       {std::pair{'\x08', "--flatten --scanline"}, {'\x10', "--subimage 0 --scanline"}}) {
    folder.write("flag.exr", std::string("\x76\x2f\x31\x01\x02", 5) + flag + std::string(2, '\0'));
    EXPECT_TRUE(contains(read_environment(folder.path() / "flag.exr").error, part)) << part;
  }
  OIIO::ImageSpec whole = spec_of(8, 4, {"R", "G", "B"}, "zip", OIIO::TypeDesc::UINT32);
  EXPECT_TRUE(contains(read_exr(whole).error, "channel R holds integers"));
}

TEST(ExrPicture, PicturesWithOtherMeaningsAreNamed) {
  OIIO::ImageSpec acescg = spec_of(8, 4, {"R", "G", "B"});
  const float ap1[8] = {0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f};
  acescg.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), ap1);
  EXPECT_TRUE(any_contains(read_exr(acescg).remarks, "chromaticities are not used"));
  const float srgb[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  acescg.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), srgb);
  EXPECT_TRUE(read_exr(acescg).remarks.empty());
}

TEST(ExrPicture, CutOffOrDamagedItIsReadOrRefused) {
  const TemporaryFolder folder;
  std::mt19937 random(5);
  SCOPED_TRACE("seed 5");
  for (const char* compression : {"none", "rle", "zips", "zip"}) {
    const OIIO::ImageSpec spec = spec_of(24, 20, {"R", "G", "B", "Z"}, compression);
    write_exr(folder.path() / "whole.exr", spec, samples(spec));
    std::ifstream stream(folder.path() / "whole.exr", std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(stream)), {});
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 60) {
      const std::string error = read_exr_bytes(whole.substr(0, length)).error;
      EXPECT_TRUE(contains(error, "sky.exr")) << "cut at " << length << " of " << whole.size();
    }
    int refused = 0;
    for (int round = 0; round < 300; ++round) {
      std::string bytes = whole;
      for (int i = 0; i < 1 + round % 3; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
      const ReadEnvironment read = read_exr_bytes(bytes);
      refused += read.error.empty() ? 0 : 1;
      for (const float value : read.image.rgba) ASSERT_TRUE(value >= 0 && value <= 65504);
    }
    EXPECT_GT(refused, 20) << compression;
  }
}

TEST(ExrPicture, ABlockThatUnpacksToAnotherLengthIsRefused) {
  // 8 x 1 pixels of three halves: one block of 48 bytes, the last of the file, behind its line and its
  // length.
  const auto with_block = [](const char* compression, const std::string& packed) {
    const TemporaryFolder folder;
    const OIIO::ImageSpec spec = spec_of(8, 1, {"R", "G", "B"}, compression);
    write_exr(folder.path() / "whole.exr", spec, std::vector<float>(24));
    std::ifstream stream(folder.path() / "whole.exr", std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    const std::size_t table = bytes.rfind(std::string("screenWindowWidth\0float\0\4\0\0\0", 28)) + 28 + 5;
    std::uint64_t block = 0;
    std::memcpy(&block, &bytes[table], sizeof block);
    return read_exr_bytes(bytes.substr(0, block) +
                          bytes_of<std::int32_t>({0, static_cast<std::int32_t>(packed.size())}) + packed)
        .error;
  };
  // RLE: a count n and a byte that comes n + 1 times.
  EXPECT_EQ(with_block("rle", std::string("\x2f\0", 2)), "");
  EXPECT_TRUE(contains(with_block("rle", std::string("\x2e\0", 2)), "block 0"));
  EXPECT_TRUE(contains(with_block("rle", std::string("\x30\0", 2)), "block 0"));
  // zlib: two bytes of header; a last block, stored, of 20 zeros: 1, length, its complement; Adler-32 of
  // 20 zeros: 20 * 65536 + 1.
  const std::string short_stream =
      std::string("\x78\x01\x01\x14\0\xeb\xff", 7) + std::string(20, '\0') + std::string("\0\x14\0\x01", 4);
  EXPECT_TRUE(contains(with_block("zips", short_stream), "block 0"));
  EXPECT_TRUE(contains(with_block("zip", short_stream), "block 0"));
  EXPECT_TRUE(contains(with_block("none", std::string(47, '\0')), "block 0"));
  EXPECT_EQ(with_block("none", std::string(48, '\0')), "");
}

TEST(ExrPicture, AWindowOfBillionsOfPixelsIsRefusedBeforeMemoryIsTaken) {
  const TemporaryFolder folder;
  const OIIO::ImageSpec spec = spec_of(8, 4, {"R", "G", "B"});
  write_exr(folder.path() / "whole.exr", spec, samples(spec));
  std::ifstream stream(folder.path() / "whole.exr", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  const auto with = [&](const std::string& attribute, std::int32_t right, std::int32_t bottom) {
    std::string bytes = whole;
    const std::size_t at = bytes.find(attribute + std::string("\0box2i\0", 7)) + attribute.size() + 7 + 4;
    bytes.replace(at + 8, 8, bytes_of<std::int32_t>({right, bottom}));
    return read_exr_bytes(bytes).error;
  };
  EXPECT_TRUE(contains(with("displayWindow", 79999, 39999), "80000 x 40000 pixels"));
  EXPECT_NE(with("dataWindow", 2000000000, 3), "");
  EXPECT_NE(with("dataWindow", 7, 2000000000), "");
  EXPECT_NE(with("dataWindow", -3, 3), "");
}

}  // namespace
}  // namespace herr::test
