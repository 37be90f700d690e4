// Headers as the small libraries read them against what OpenImageIO says of the same bytes.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <jpeglib.h>

#include "sessions/files/input_error.h"
#include "sessions/pictures/exr_header.h"
#include "sessions/pictures/header_bytes.h"
#include "sessions/pictures/jpeg_header.h"
#include "sessions/pictures/picture_reader.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::RecordedFolder;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string picture(const RecordedFolder& folder, const std::string& name, const OIIO::ImageSpec& spec) {
  const auto file = folder / name;
  const std::vector<float> samples(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels), 0.5f);
  const auto writer = OIIO::ImageOutput::create(file.string());
  EXPECT_TRUE(writer && writer->open(file.string(), spec) &&
              writer->write_image(OIIO::TypeDesc::FLOAT, samples.data()) && writer->close());
  return bytes_of(file);
}

// A JPEG by libjpeg itself, of any colour space, with `metadata` before the size.
std::string jpeg(int width_px, int height_px, int components, J_COLOR_SPACE space, bool progressive = false,
                 std::size_t metadata = 0) {
  jpeg_compress_struct info;
  jpeg_error_mgr errors;
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &memory, &size);
  info.image_width = static_cast<JDIMENSION>(width_px);
  info.image_height = static_cast<JDIMENSION>(height_px);
  info.input_components = components;
  info.in_color_space = space;
  jpeg_set_defaults(&info);
  if (progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  const std::vector<unsigned char> note(60000, 'n');
  for (std::size_t written = 0; written < metadata; written += note.size())
    jpeg_write_marker(&info, JPEG_APP0 + 5, note.data(), static_cast<unsigned>(note.size()));
  std::vector<unsigned char> row(static_cast<std::size_t>(width_px * components), 99);
  unsigned char* rows[] = {row.data()};
  for (int y = 0; y < height_px; ++y) jpeg_write_scanlines(&info, rows, 1);
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  std::string bytes(reinterpret_cast<char*>(memory), size);
  std::free(memory);
  return bytes;
}

void expect_same(const PictureHeader& header, const char* format, const std::string& bytes,
                 const std::string& what) {
  const PictureReader reader(format, bytes);
  ASSERT_EQ(reader.problem(), "") << what;
  EXPECT_EQ(header.width_px, reader.header().width_px) << what;
  EXPECT_EQ(header.height_px, reader.header().height_px) << what;
  EXPECT_EQ(header.channels, reader.header().channels) << what;
  EXPECT_EQ(header.stored, reader.header().stored) << what;
}

TEST(JpegHeader, IsWhatDecodingSays) {
  for (const bool progressive : {false, true})
    for (const int components : {1, 3}) {
      const std::string bytes =
          jpeg(37, 21, components, components == 1 ? JCS_GRAYSCALE : JCS_RGB, progressive);
      HeaderBytes first("a.jpg", bytes);
      expect_same(read_jpeg_header(first).picture, "jpeg", bytes, std::to_string(components));
    }
}

TEST(JpegHeader, IsFoundBehindLongMetadataInAFileThatIsReadNoFurther) {
  const RecordedFolder folder;
  const std::string bytes = jpeg(37, 21, 3, JCS_RGB, false, std::size_t{300} << 10);
  folder.write("a.jpg", bytes + std::string(std::size_t{17} << 20, 'x'));
  InputFile file(folder / "a.jpg");
  HeaderBytes first(file);
  EXPECT_EQ(read_jpeg_header(first).picture.width_px, 37);
  char rest[16];
  EXPECT_GT(file.read(rest, sizeof rest), 0u) << "the file was read to its end";
}

TEST(JpegHeader, TellsInkAndRefusesWhatHasNoHeader) {
  const std::string cmyk = jpeg(8, 8, 4, JCS_CMYK);
  HeaderBytes ink("a.jpg", cmyk);
  EXPECT_TRUE(read_jpeg_header(ink).cmyk);
  const std::string good = jpeg(8, 8, 3, JCS_RGB);
  testing::internal::CaptureStderr();
  for (std::size_t length = 3; length < good.find("\xff\xda"); ++length) {  // up to the first scan
    const std::string cut = good.substr(0, length);
    HeaderBytes bytes("a.jpg", cut);
    EXPECT_INPUT_ERROR(read_jpeg_header(bytes), "cannot be read as an image");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ExrHeader, IsWhatDecodingSays) {
  const RecordedFolder folder;
  for (const OIIO::TypeDesc type : {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT})
    for (const char* compression : {"none", "rle", "zips", "zip"})
      for (const int channels : {1, 3, 4}) {
        OIIO::ImageSpec spec(19, 7, channels, type);
        if (channels == 1) spec.channelnames = {"Y"};
        spec.attribute("compression", std::string(compression));
        const std::string bytes = picture(folder, "a.exr", spec);
        HeaderBytes first("a.exr", bytes);
        expect_same(read_exr_header(first), "openexr", bytes, compression);
      }
}

TEST(ExrHeader, RefusesIntegersForeignChannelsAndEveryCut) {
  const RecordedFolder folder;
  OIIO::ImageSpec spec(8, 8, 3, OIIO::TypeDesc::UINT);
  spec.attribute("compression", std::string("zip"));
  const std::string integers = picture(folder, "i.exr", spec);
  HeaderBytes integer_bytes("i.exr", integers);
  EXPECT_INPUT_ERROR(read_exr_header(integer_bytes), "integer channels");
  spec.set_format(OIIO::TypeDesc::HALF);
  spec.channelnames = {"U", "V", "W"};
  const std::string foreign = picture(folder, "f.exr", spec);
  HeaderBytes foreign_bytes("f.exr", foreign);
  EXPECT_INPUT_ERROR(read_exr_header(foreign_bytes), "without channels R, G, B or Y");
  const std::string good = picture(folder, "g.exr", OIIO::ImageSpec(8, 8, 3, OIIO::TypeDesc::HALF));
  testing::internal::CaptureStderr();
  for (std::size_t length = 8; length < 300; ++length) {  // its header is longer
    const std::string cut = good.substr(0, length);
    HeaderBytes bytes("a.exr", cut);
    EXPECT_NE(test::error_of([&] { read_exr_header(bytes); }), "no error") << length;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace herr
