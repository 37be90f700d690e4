#include "scenes/environment/environment_image.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <glm/gtc/packing.hpp>

#include "scenes/environment/environment_limits.h"
#include "scenes/environment/exr_picture.h"
#include "scenes/environment/radiance_picture.h"
#include "sessions/camera/camera_image.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"

namespace herr {
namespace {

constexpr std::int64_t kMaxRadianceBytes = std::int64_t{1} << 28;  // 8192 x 4096 pixels of 4 bytes, twice
constexpr std::int64_t kMaxExrBytes = std::int64_t{1} << 30;

std::string first_bytes(const std::filesystem::path& path) {
  InputFile file(path);
  std::string bytes(4, '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  return bytes;
}

EnvironmentImage read_srgb_picture(const std::filesystem::path& file, std::vector<std::string>& remarks) {
  const ImageSize size = read_image_size(file);
  check_environment_size(file, size.width_px, size.height_px);
  const CameraImage half = read_camera_image(file);
  if (half.sanitised_values > 0) remarks.push_back(range_remark(half.sanitised_values));
  EnvironmentImage image{half.width_px, half.height_px, 0, std::vector<float>(half.rgba_half.size())};
  std::transform(half.rgba_half.begin(), half.rgba_half.end(), image.rgba.begin(),
                 [](std::uint16_t value) { return glm::unpackHalf1x16(value); });
  return image;
}

EnvironmentImage read_any_picture(const std::filesystem::path& file, std::vector<std::string>& remarks) {
  const std::string first = first_bytes(file);
  const auto starts = [&](std::string_view magic) { return first.substr(0, magic.size()) == magic; };
  if (starts("#?")) return read_radiance_picture(read_whole_file(file, kMaxRadianceBytes), file, remarks);
  if (starts("\x76\x2f\x31\x01")) return read_exr_picture(read_whole_file(file, kMaxExrBytes), file, remarks);
  if (starts("\x89PNG") || starts("\xff\xd8\xff")) return read_srgb_picture(file, remarks);
  throw InputError(file, 0, first.empty() ? "is empty" : "is no Radiance, EXR, PNG or JPEG picture",
                   "convert it, for example: oiiotool IN -o OUT.exr");
}

}  // namespace

EnvironmentImage read_environment_image(const std::filesystem::path& file,
                                        std::vector<std::string>& remarks) {
  EnvironmentImage image = read_any_picture(file, remarks);
  // A pixel more or less is rounding.
  if (std::abs(image.width_px - 2 * image.height_px) > std::max(2, image.width_px / 100)) {
    remarks.push_back("has " + std::to_string(image.width_px) + " x " + std::to_string(image.height_px) +
                      " pixels, where an equirectangular picture is twice as wide as high; it is stretched");
  }
  return image;
}

}  // namespace herr
