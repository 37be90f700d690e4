#include "sessions/camera/camera_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "sessions/camera/half_from_samples.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/pictures/image_format.h"
#include "sessions/pictures/png_chunks.h"

namespace herr {
namespace {

constexpr int kMaxSidePx = 16384;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 26;  // 67 megapixels are 512 MiB as RGBA half
constexpr std::int64_t kMaxFileBytes = std::int64_t{1} << 30;
constexpr const char* kAgain = "export the image again";

// The library's own limits, as a second line of defence, and no threads of its own: frames are decoded by the
// caller.
void limit_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("try_all_readers", 0);
    OIIO::attribute("limits:channels", 8);
    OIIO::attribute("limits:imagesize_MB", 2048);
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
  });
}

// A reader on bytes that it does not own: the proxy goes last.
struct OpenedImage {
  ImageFormat format = ImageFormat::jpeg;
  std::unique_ptr<OIIO::Filesystem::IOProxy> bytes;
  std::unique_ptr<OIIO::ImageInput> reader;
  OIIO::ImageSpec spec;
};

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

// OpenEXR 3.1.5 has open memory errors in its other decoders; only these compressions reach it.
void check_exr(const std::filesystem::path& file, const OIIO::ImageSpec& spec) {
  const std::string compression = spec.get_string_attribute("compression", "none");
  if (compression != "none" && compression != "rle" && compression != "zip" && compression != "zips")
    throw InputError(file, 0, "is an EXR with compression " + printable(compression),
                     "use none, RLE, ZIPS or ZIP");
  const bool windows_agree = spec.x == 0 && spec.y == 0 && spec.full_x == 0 && spec.full_y == 0 &&
                             spec.full_width == spec.width && spec.full_height == spec.height;
  if (!windows_agree)
    throw InputError(file, 0, "is an EXR whose data window is not its display window",
                     "crop or pad the image");
  for (const OIIO::TypeDesc& type : spec.channelformats)
    if (type != OIIO::TypeDesc::HALF && type != OIIO::TypeDesc::FLOAT)
      throw InputError(file, 0, "is an EXR with integer channels", "use half or float");
  if (spec.format != OIIO::TypeDesc::HALF && spec.format != OIIO::TypeDesc::FLOAT)
    throw InputError(file, 0, "is an EXR with integer channels", "use half or float");
}

void check_channels(const std::filesystem::path& file, const OIIO::ImageSpec& spec, ImageFormat format) {
  if (spec.get_string_attribute("jpeg:ColorSpace") == "CMYK" ||
      spec.get_string_attribute("jpeg:ColorSpace") == "YCbCrK")
    throw InputError(file, 0, "is a CMYK image", "convert it to RGB");
  if (spec.nchannels < 1 || spec.nchannels > 4)
    throw InputError(file, 0, "has " + std::to_string(spec.nchannels) + " channels",
                     "use grey or RGB, with or without alpha");
  if (format != ImageFormat::exr) return;
  const bool colour =
      spec.channelindex("R") == 0 && spec.channelindex("G") == 1 && spec.channelindex("B") == 2;
  const bool grey = spec.nchannels <= 2 && spec.channelindex("Y") == 0;
  if (!colour && !grey) throw InputError(file, 0, "is an EXR without channels R, G, B or Y", kAgain);
}

OpenedImage open_image(const std::filesystem::path& file, const std::string& first_bytes,
                       std::unique_ptr<OIIO::Filesystem::IOProxy> bytes) {
  limit_library();
  OpenedImage opened;
  opened.format = recognised_format(file, first_bytes);
  opened.bytes = std::move(bytes);
  opened.reader = OIIO::ImageInput::create(reader_name(opened.format));
  if (!opened.reader || !opened.reader->set_ioproxy(opened.bytes.get()))
    throw std::runtime_error(std::string("OpenImageIO has no usable reader for ") +
                             reader_name(opened.format) + ": " + OIIO::geterror());
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha",
                   1);  // else colour is multiplied by alpha; a camera's alpha means nothing
  if (!opened.reader->open(file.string(), opened.spec, wishes))
    throw InputError(file, 0, "cannot be read as an image" + shortened(opened.reader->geterror()), kAgain);
  check_size(file, {opened.spec.width, opened.spec.height});
  check_channels(file, opened.spec, opened.format);
  if (opened.format == ImageFormat::exr) check_exr(file, opened.spec);
  return opened;
}

template <typename Sample>
std::vector<Sample> read_samples(const std::filesystem::path& file, OpenedImage& opened,
                                 OIIO::TypeDesc type) {
  const OIIO::ImageSpec& spec = opened.spec;
  std::vector<Sample> samples(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                              static_cast<std::size_t>(spec.nchannels));
  const bool read = opened.reader->read_image(0, 0, 0, spec.nchannels, type, samples.data());
  const std::string message = opened.reader->geterror();  // a cut-off file may "succeed" and leave only this
  if (!read || !message.empty())
    throw InputError(file, 0, "does not decode" + shortened(message) + ": damaged or cut off", kAgain);
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
  const std::filesystem::path& path = from.path();
  std::string first_bytes(kPngHeaderBytes, '\0');
  first_bytes.resize(from.read_at(0, first_bytes.data(), first_bytes.size()));
  if (recognised_format(path, first_bytes) == ImageFormat::png) {
    const ImageSize size = png_size(path, first_bytes);
    check_size(path, size);
    return size;
  }
  std::string bytes = all_bytes<std::string>(from, {kMaxFileBytes});
  const OpenedImage opened = open_image(
      path, first_bytes, std::make_unique<OIIO::Filesystem::IOMemReader>(bytes.data(), bytes.size()));
  return {opened.spec.width, opened.spec.height};
}

CameraImage read_camera_image(InputFile& from) {
  const std::filesystem::path& file = from.path();
  std::string bytes = all_bytes<std::string>(from, {kMaxFileBytes});
  if (recognised_format(file, std::string_view(bytes).substr(0, kPngHeaderBytes)) == ImageFormat::png) {
    check_size(file, png_size(file, bytes));
    bytes = essential_png(file, bytes);
  }
  OpenedImage opened = open_image(
      file, bytes.substr(0, 16), std::make_unique<OIIO::Filesystem::IOMemReader>(bytes.data(), bytes.size()));
  if (opened.format == ImageFormat::jpeg) check_jpeg_end(file, bytes);
  CameraImage image{opened.spec.width, opened.spec.height, {}};
  const int channels = opened.spec.nchannels;
  if (opened.format == ImageFormat::exr) {
    expand(read_samples<float>(file, opened, OIIO::TypeDesc::FLOAT), channels, image,
           [&](float value) { return half_from_linear(value, image.sanitised_values); });
  } else if (opened.spec.format == OIIO::TypeDesc::UINT16) {
    const std::vector<std::uint16_t>& table = half_from_srgb16();
    expand(read_samples<std::uint16_t>(file, opened, OIIO::TypeDesc::UINT16), channels, image,
           [&](std::uint16_t value) { return table[value]; });
  } else {
    const std::array<std::uint16_t, 256>& table = half_from_srgb8();
    expand(read_samples<std::uint8_t>(file, opened, OIIO::TypeDesc::UINT8), channels, image,
           [&](std::uint8_t value) { return table[value]; });
  }
  return image;
}

}  // namespace herr
