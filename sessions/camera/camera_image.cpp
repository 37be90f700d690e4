#include "sessions/camera/camera_image.h"

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sessions/camera/half_from_samples.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/pictures/exr_header.h"
#include "sessions/pictures/header_bytes.h"
#include "sessions/pictures/image_format.h"
#include "sessions/pictures/jpeg_header.h"
#include "sessions/pictures/picture_reader.h"
#include "sessions/pictures/png_chunks.h"

namespace herr {
namespace {

constexpr int kMaxSidePx = 16384;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 26;  // 67 megapixels are 512 MiB as RGBA half
constexpr std::int64_t kMaxFileBytes = std::int64_t{1} << 30;
constexpr const char* kAgain = "export the image again";

std::string shortened(const std::string& message) {
  const std::string line = message.substr(0, message.find('\n'));
  return line.empty() ? "" : " (" + printable(line) + ")";
}

void check_size(const std::filesystem::path& file, const ImageSize& size) {
  const bool good = size.width_px >= 1 && size.height_px >= 1 && size.width_px <= kMaxSidePx &&
                    size.height_px <= kMaxSidePx &&
                    std::int64_t{size.width_px} * size.height_px <= kMaxPixels;
  if (!good)
    throw InputError(
        file, 0, "has " + std::to_string(size.width_px) + " x " + std::to_string(size.height_px) + " pixels",
        "images have 1 to 16384 pixels on a side and at most 67 million");
}

void check_channels(const std::filesystem::path& file, int channels) {
  if (channels < 1 || channels > 4)
    throw InputError(file, 0, "has " + std::to_string(channels) + " channels",
                     "use grey or RGB, with or without alpha");
}

PictureHeader header_of_rgb_jpeg(HeaderBytes& bytes) {
  const JpegHeader header = read_jpeg_header(bytes);
  if (header.cmyk) throw InputError(bytes.path(), 0, "is a CMYK image", "convert it to RGB");
  return header.picture;
}

struct CheckedHeader {
  ImageFormat format = ImageFormat::jpeg;
  ImageSize size;
};

// All that can be known before the pixels. The small libraries read it: OpenImageIO is not loaded for that.
CheckedHeader checked_header(HeaderBytes& bytes) {
  const std::filesystem::path& file = bytes.path();
  const std::string_view first = bytes.first(kPngHeaderBytes);
  CheckedHeader checked{recognised_format(file, first), {}};
  if (checked.format == ImageFormat::png) {
    checked.size = png_size(file, first);
    check_size(file, checked.size);
    return checked;
  }
  const PictureHeader header =
      checked.format == ImageFormat::jpeg ? header_of_rgb_jpeg(bytes) : read_exr_header(bytes);
  checked.size = {header.width_px, header.height_px};
  check_size(file, checked.size);
  check_channels(file, header.channels);
  return checked;
}

template <typename Sample>
constexpr SampleType kTypeOf = std::is_same_v<Sample, float>           ? SampleType::f32
                               : std::is_same_v<Sample, std::uint16_t> ? SampleType::u16
                                                                       : SampleType::u8;

template <typename Sample>
std::vector<Sample> read_samples(const std::filesystem::path& file, PictureReader& reader) {
  const PictureHeader& header = reader.header();
  std::vector<Sample> samples(static_cast<std::size_t>(header.width_px) *
                              static_cast<std::size_t>(header.height_px) *
                              static_cast<std::size_t>(header.channels));
  if (!reader.read(kTypeOf<Sample>, samples.data(), samples.size() * sizeof(Sample)))
    throw InputError(file, 0, "does not decode" + shortened(reader.problem()) + ": damaged or cut off",
                     kAgain);
  return samples;
}

// Writes `converted(sample)` of grey or RGB to RGBA; the file's alpha is dropped.
template <typename Sample, typename Convert>
void expand(const std::vector<Sample>& samples, int channels, CameraImage& image, const Convert& converted) {
  const auto step = static_cast<std::size_t>(channels);
  const std::size_t green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
  const std::size_t pixels = samples.size() / step;
  image.rgba_half.resize(4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const Sample* from = &samples[i * step];
    std::uint16_t* to = &image.rgba_half[4 * i];
    to[0] = converted(from[0]);
    to[1] = green == 0 ? to[0] : converted(from[green]);
    to[2] = blue == 0 ? to[0] : converted(from[blue]);
    to[3] = kHalfOne;
  }
}

// libjpeg takes a file that ends early for a grey picture and only warns: the end marker tells. Bytes after
// it are legal, but no marker at all is not; FF D9 cannot occur inside coded data.
void check_jpeg_end(const std::filesystem::path& file, const std::string& bytes) {
  if (bytes.rfind("\xff\xd9") == std::string::npos)
    throw InputError(file, 0, "is a JPEG without its end: damaged or cut off", kAgain);
}

}  // namespace

ImageSize read_image_size(const std::filesystem::path& path) {
  InputFile file(path);
  return read_image_size(file);
}

CameraImage read_camera_image(const std::filesystem::path& path) {
  InputFile file(path);
  return read_camera_image(file);
}

ImageSize read_image_size(InputFile& from) {
  HeaderBytes bytes(from);
  return checked_header(bytes).size;
}

CameraImage read_camera_image(InputFile& from) {
  const std::filesystem::path& file = from.path();
  std::string bytes = all_bytes<std::string>(from, {kMaxFileBytes});
  HeaderBytes first_bytes(file, bytes);
  const CheckedHeader checked = checked_header(first_bytes);
  if (checked.format == ImageFormat::png) bytes = essential_png(file, bytes);
  if (checked.format == ImageFormat::jpeg) check_jpeg_end(file, bytes);

  PictureReader reader(reader_name(checked.format), bytes);
  if (!reader.problem().empty())
    throw InputError(file, 0, "cannot be read as an image" + shortened(reader.problem()), kAgain);
  const PictureHeader& header = reader.header();
  check_channels(file, header.channels);
  if (header.width_px != checked.size.width_px || header.height_px != checked.size.height_px)
    throw InputError(file, 0, "does not decode: its header can be read in two ways", kAgain);

  CameraImage image{header.width_px, header.height_px, {}};
  if (checked.format == ImageFormat::exr) {
    expand(read_samples<float>(file, reader), header.channels, image,
           [&](float value) { return half_from_linear(value, image.sanitised_values); });
  } else if (header.stored == SampleType::u16) {
    const std::vector<std::uint16_t>& table = half_from_srgb16();
    expand(read_samples<std::uint16_t>(file, reader), header.channels, image,
           [&](std::uint16_t value) { return table[value]; });
  } else {
    const std::array<std::uint16_t, 256>& table = half_from_srgb8();
    expand(read_samples<std::uint8_t>(file, reader), header.channels, image,
           [&](std::uint8_t value) { return table[value]; });
  }
  return image;
}

}  // namespace herr
