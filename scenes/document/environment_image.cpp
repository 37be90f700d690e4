#include "scenes/document/environment_image.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <string>

#include "sessions/camera/camera_image.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/pictures/picture_reader.h"

namespace herr {
namespace {

constexpr int kMaxWidth_px = 8192, kMaxHeight_px = 4096;
constexpr std::int64_t kMaxRadianceBytes = std::int64_t{1} << 28;  // 8192 x 4096 pixels of 4 bytes, twice
constexpr float kBrightestTexel = 65504.0f;  // what EXR's half holds, and far above any display

bool is_radiance_picture(const std::filesystem::path& path) {
  InputFile file(path);
  char first[2] = {};
  return file.read(first, sizeof first) == sizeof first && std::memcmp(first, "#?", 2) == 0;
}

void check_size(const std::filesystem::path& file, int width_px, int height_px) {
  if (width_px >= 2 && height_px >= 1 && width_px <= kMaxWidth_px && height_px <= kMaxHeight_px) return;
  throw InputError(file, 0,
                   "has " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                       " pixels, which is no picture of an environment",
                   "use an equirectangular picture of 2 x 1 to 8192 x 4096 pixels");
}

float usable(float value, std::int64_t& sanitised) {
  if (value >= 0 && value <= kBrightestTexel) return value;
  ++sanitised;
  return value > kBrightestTexel ? kBrightestTexel : 0.0f;
}

EnvironmentImage read_radiance_picture(const std::filesystem::path& file, std::int64_t& sanitised) {
  const auto damaged = [&](std::string message) {
    message = message.substr(0, message.find('\n'));
    return InputError(file, 0, "does not decode as Radiance HDR (" + printable(message) + ")",
                      "copy or export the picture again");
  };
  const std::string bytes = read_whole_file(file, kMaxRadianceBytes);
  PictureReader reader("hdr", bytes);
  if (!reader.problem().empty()) throw damaged(reader.problem());
  const PictureHeader& header = reader.header();
  check_size(file, header.width_px, header.height_px);
  if (header.channels != 3) throw damaged("it has " + std::to_string(header.channels) + " channels");
  const std::size_t pixels =
      static_cast<std::size_t>(header.width_px) * static_cast<std::size_t>(header.height_px);
  std::vector<float> rgb(3 * pixels);
  if (!reader.read(SampleType::f32, rgb.data(), rgb.size() * sizeof(float))) throw damaged(reader.problem());
  EnvironmentImage image{header.width_px, header.height_px, 0, std::vector<float>(4 * pixels)};
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * i + c] = usable(rgb[3 * i + c], sanitised);
  }
  return image;
}

}  // namespace

EnvironmentImage read_environment_image(const std::filesystem::path& file, std::int64_t& sanitised_values) {
  if (is_radiance_picture(file)) return read_radiance_picture(file, sanitised_values);
  const ImageSize size = read_image_size(file);
  check_size(file, size.width_px, size.height_px);
  const CameraImage half = read_camera_image(file);
  sanitised_values += half.sanitised_values;
  EnvironmentImage image{half.width_px, half.height_px, 0, std::vector<float>(half.rgba_half.size())};
  std::transform(half.rgba_half.begin(), half.rgba_half.end(), image.rgba.begin(),
                 [](std::uint16_t value) { return glm::unpackHalf1x16(value); });
  return image;
}

}  // namespace herr
