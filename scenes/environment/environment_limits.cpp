#include "scenes/environment/environment_limits.h"

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::int64_t kMaxWidth_px = 8192, kMaxHeight_px = 4096;
constexpr double kBrightestTexel = 65504.0;

}  // namespace

void check_environment_size(const std::filesystem::path& file, std::int64_t width_px,
                            std::int64_t height_px) {
  if (width_px >= 2 && height_px >= 1 && width_px <= kMaxWidth_px && height_px <= kMaxHeight_px) return;
  throw InputError(file, 0,
                   "has " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                       " pixels, which is no picture of an environment",
                   "use an equirectangular picture of 2 x 1 to 8192 x 4096 pixels");
}

float radiance_in_range(double value, std::int64_t& changed) {
  if (value >= 0 && value <= kBrightestTexel) return static_cast<float>(value);
  ++changed;
  return value > kBrightestTexel ? static_cast<float>(kBrightestTexel) : 0.0f;
}

std::string range_remark(std::int64_t changed) {
  return std::to_string(changed) + " values are negative, not finite or above 65504; brought into range";
}

}  // namespace herr
