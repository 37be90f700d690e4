// JPEG and PNG as libjpeg and libpng decode them here, against what OpenImageIO makes of the same bytes; the
// PNG writer against the decoder; what is damaged.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstddef>
#include <string>
#include <vector>

#include "sessions/pictures/picture_reader.h"
#include "sessions/pictures/png_writer.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

// Samples that repeat nowhere.
std::vector<std::uint8_t> pattern(std::size_t count) {
  std::vector<std::uint8_t> values(count);
  std::uint32_t state = 12345;
  for (std::uint8_t& value : values)
    value = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  return values;
}

std::string file_of(const char* name, int width, int height, int channels, OIIO::TypeDesc type,
                    const std::vector<std::uint8_t>& bytes) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / name).string();
  const OIIO::ImageSpec spec(width, height, channels, type);
  const auto writer = OIIO::ImageOutput::create(file);
  EXPECT_TRUE(writer && writer->open(file, spec) && writer->write_image(type, bytes.data()) &&
              writer->close());
  return content_of(file);
}

struct Decoded {
  PictureHeader header;
  std::vector<std::uint8_t> bytes;
};

SampleType stored_as(const OIIO::TypeDesc& type) {
  return type == OIIO::TypeDesc::UINT16 ? SampleType::u16 : SampleType::u8;
}

Decoded by_openimageio(const std::string& format, const std::string& bytes, SampleType as) {
  Decoded decoded;
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const auto reader = OIIO::ImageInput::create(format);
  OIIO::ImageSpec spec, wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);  // else colour is multiplied by alpha
  reader->set_ioproxy(&memory);
  EXPECT_TRUE(reader->open("memory." + format, spec, wishes)) << reader->geterror();
  decoded.header = {spec.width, spec.height, spec.nchannels, stored_as(spec.format)};
  const OIIO::TypeDesc type = as == SampleType::u16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
  decoded.bytes.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels) * type.size());
  EXPECT_TRUE(reader->read_image(0, 0, 0, spec.nchannels, type, decoded.bytes.data())) << reader->geterror();
  return decoded;
}

void expect_as_openimageio(const char* format, const std::string& bytes, SampleType as,
                           const std::string& what) {
  PictureReader reader(format, bytes);
  ASSERT_EQ(reader.problem(), "") << what;
  const Decoded wanted = by_openimageio(format, bytes, as);
  EXPECT_EQ(reader.header().width_px, wanted.header.width_px) << what;
  EXPECT_EQ(reader.header().height_px, wanted.header.height_px) << what;
  ASSERT_EQ(reader.header().channels, wanted.header.channels) << what;
  EXPECT_EQ(reader.header().stored, wanted.header.stored) << what;
  std::vector<std::uint8_t> samples(wanted.bytes.size());
  EXPECT_TRUE(reader.read(as, samples.data(), samples.size())) << what << reader.problem();
  EXPECT_EQ(samples, wanted.bytes) << what;
}

TEST(Decoders, ReadTheSamplesThatOpenImageIoReads) {
  for (const int channels : {1, 2, 3, 4}) {
    const std::string what = std::to_string(channels) + " channels";
    const auto values = pattern(static_cast<std::size_t>(2 * 37 * 23 * channels));
    const std::string narrow = file_of("a.png", 37, 23, channels, OIIO::TypeDesc::UINT8, values);
    expect_as_openimageio("png", narrow, SampleType::u8, what);
    const std::string wide = file_of("a.png", 37, 23, channels, OIIO::TypeDesc::UINT16, values);
    expect_as_openimageio("png", wide, SampleType::u16, what + " of 16 bits");
    expect_as_openimageio("png", wide, SampleType::u8, what + " of 16 bits as 8");
    if (channels == 1 || channels == 3)
      expect_as_openimageio("jpeg", file_of("a.jpg", 37, 23, channels, OIIO::TypeDesc::UINT8, values),
                            SampleType::u8, what);
  }
}

// A PNG by its chunks (W3C PNG specification, section 5), of rows that begin with their filter's byte.
std::string png_of(const std::string& header, const std::string& before_data, std::string rows) {
  const auto word = [](std::uint64_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
  };
  const auto chunk = [&](const std::string& type_and_data) {
    const auto* data = reinterpret_cast<const Bytef*>(type_and_data.data());
    return word(type_and_data.size() - 4) + type_and_data +
           word(::crc32(0, data, static_cast<uInt>(type_and_data.size())));
  };
  std::string packed(::compressBound(rows.size()), '\0');
  uLongf size = packed.size();
  EXPECT_EQ(::compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                       reinterpret_cast<const Bytef*>(rows.data()), rows.size()),
            Z_OK);
  packed.resize(size);
  std::string extra;
  for (std::size_t at = 0; at < before_data.size();) {  // length, then type and data
    const auto length = static_cast<std::size_t>(before_data[at]);
    extra += chunk(before_data.substr(at + 1, length));
    at += 1 + length;
  }
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR" + header) + extra + chunk("IDAT" + packed) + chunk("IEND");
}

// Two palette entries, the second half clear; 2x2 pixels of one bit each.
TEST(Decoders, ExpandPalettesFewBitsAndClearColoursToRgba) {
  const std::string palette("\x0aPLTE\x0a\x14\x1e\x28\x32\x3c\x06tRNS\xff\x80", 18);
  const std::string bits =
      png_of(std::string("\0\0\0\2\0\0\0\2\1\3\0\0\0", 13), palette, std::string("\0\x40\0\x80", 4));
  expect_as_openimageio("png", bits, SampleType::u8, "palette");
  PictureReader reader("png", bits);
  std::vector<std::uint8_t> rgba(16);
  ASSERT_TRUE(reader.read_rgba8(rgba.data())) << reader.problem();
  const std::vector<std::uint8_t> wanted{10, 20, 30, 255, 40, 50, 60, 128, 40, 50, 60, 128, 10, 20, 30, 255};
  EXPECT_EQ(rgba, wanted);
  // Grey of two bits: 0, 1, 2, 3 are 0, 85, 170, 255.
  PictureReader grey("png",
                     png_of(std::string("\0\0\0\4\0\0\0\1\2\0\0\0\0", 13), "", std::string("\0\x1b", 2)));
  ASSERT_TRUE(grey.read_rgba8(rgba.data())) << grey.problem();
  EXPECT_EQ(rgba, (std::vector<std::uint8_t>{0, 0, 0, 255, 85, 85, 85, 255, 170, 170, 170, 255, 255, 255, 255,
                                             255}));
}

// Cameras and editors leave bytes before the end marker; libjpeg warns of them and decodes the same pixels.
TEST(Decoders, PassOverBytesThatAJpegHasTooMany) {
  const std::string clean = file_of("a.jpg", 16, 8, 3, OIIO::TypeDesc::UINT8, pattern(3 * 16 * 8));
  std::string longer = clean;
  longer.insert(clean.rfind("\xff\xd9"), 4, '\0');
  expect_as_openimageio("jpeg", longer, SampleType::u8, "four bytes too many");
  std::vector<std::uint8_t> wanted(4 * 16 * 8), read(wanted.size());
  PictureReader first("jpeg", clean), second("jpeg", longer);
  ASSERT_TRUE(first.read_rgba8(wanted.data()));
  ASSERT_TRUE(second.read_rgba8(read.data())) << second.problem();
  EXPECT_EQ(read, wanted);
}

TEST(Decoders, GiveColourPicturesAsRgbaWithoutFurtherWork) {
  const std::string jpeg = file_of("a.jpg", 16, 8, 3, OIIO::TypeDesc::UINT8, pattern(3 * 16 * 8));
  PictureReader rgb("jpeg", jpeg), rgba("jpeg", jpeg);
  std::vector<std::uint8_t> three(3 * 16 * 8), four(4 * 16 * 8);
  ASSERT_TRUE(rgb.read(SampleType::u8, three.data(), three.size()) && rgba.read_rgba8(four.data()));
  for (std::size_t i = 0; i < 16 * 8; ++i) {
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(four[4 * i + c], three[3 * i + c]) << i;
    ASSERT_EQ(four[4 * i + 3], 255);
  }
}

TEST(Decoders, SayWhatIsWrongWithDamagedPicturesWithoutAWordOnStderr) {
  const std::string png = file_of("a.png", 40, 40, 3, OIIO::TypeDesc::UINT8, pattern(4800));
  const std::string jpeg = file_of("a.jpg", 40, 40, 3, OIIO::TypeDesc::UINT8, pattern(4800));
  ::testing::internal::CaptureStderr();
  std::vector<std::uint8_t> room(4 * 40 * 40);
  for (const auto& [format, bytes] : {std::pair{"png", png}, std::pair{"jpeg", jpeg}}) {
    for (std::size_t length = 0; length + 20 < bytes.size(); length += 37) {
      const std::string cut = bytes.substr(0, length);
      PictureReader reader(format, cut);
      if (reader.problem().empty()) {
        EXPECT_FALSE(reader.read_rgba8(room.data())) << format << " of " << length;
      }
      EXPECT_NE(reader.problem(), "") << format << " of " << length;
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(PngWriter, WritesWhatTheDecoderReadsBack) {
  for (const int channels : {3, 4}) {
    const auto values = pattern(static_cast<std::size_t>(31 * 17 * channels));
    std::vector<std::uint8_t> file;
    write_png({31, 17, channels, values.data()}, 1, file);
    const std::string bytes(file.begin(), file.end());
    PictureReader reader("png", bytes);
    ASSERT_EQ(reader.header().channels, channels) << reader.problem();
    std::vector<std::uint8_t> back(values.size());
    ASSERT_TRUE(reader.read(SampleType::u8, back.data(), back.size())) << reader.problem();
    EXPECT_EQ(back, values);
    expect_as_openimageio("png", bytes, SampleType::u8, "written here");
    std::vector<std::uint8_t> again;
    write_png({31, 17, channels, values.data()}, 1, again);
    EXPECT_EQ(again, file);
  }
}

}  // namespace
}  // namespace herr
