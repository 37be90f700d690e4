#include "server/frames/warnings/picture_warnings_drawn.h"

#include <algorithm>
#include <cmath>

#include "server/frames/warnings/picture_warnings.h"
#include "server/output/srgb_table.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::uint16_t kHalfInfinity = 0x7C00;
constexpr double kBrightened = 0.8,
                 kMostStops = 30;  // what the proposed exposure brings the brightest value to

// Positive halfs sort as their bits do.
double brightest_channel(const ViewportImage& picture) {
  std::uint16_t most = 0;
  for (int y = 0; y < picture.height_px; ++y) {
    const std::uint16_t* texel = picture.row(y);
    for (int x = 0; x < picture.width_px; ++x, texel += 4)
      for (int channel = 0; channel < 3; ++channel)
        if (texel[channel] < kHalfInfinity) most = std::max(most, texel[channel]);
  }
  return double{float_from_half(most)};
}

std::string two_digits(double value) {
  if (!(value > 0)) return "0";
  const double parts = std::pow(10.0, 1 - std::floor(std::log10(value)));
  return shortest_text(std::round(value * parts) / parts);
}

double strength(const AreaLight& light) {
  return std::max({light.intensity_w_sr.x, light.intensity_w_sr.y, light.intensity_w_sr.z});
}

// "light "lamp" more than its intensity of 0.001 W/sr"; empty without lights.
std::string strongest_light(const Scene& scene) {
  const auto found =
      std::max_element(scene.lights.begin(), scene.lights.end(),
                       [](const AreaLight& a, const AreaLight& b) { return strength(a) < strength(b); });
  if (found == scene.lights.end()) return {};
  const bool sun = found->kind == LightKind::sun;
  return "light" + (found->name.empty() ? "" : " \"" + printable(found->name) + "\"") + " more than its " +
         (sun ? "irradiance" : "intensity") + " of " + two_digits(strength(*found)) +
         (sun ? " W/m2" : " W/sr");
}

}  // namespace

void DrawnPictures::add(const std::vector<ViewportImage>& pictures, const Pose& world_from_head) {
  ++frames_;
  if (!first_head_) first_head_ = world_from_head;
  for (const ViewportImage& picture : pictures) {
    if (brightest_ >= kDark) return;
    exposure_ = double{picture.exposure};
    brightest_ = std::max(brightest_, brightest_channel(picture) * exposure_);
  }
}

std::string DrawnPictures::warning(const Scene& scene, std::int64_t frames, std::int64_t object_samples,
                                   const DisplayProfile& profile) const {
  if (frames == 0) return {};
  if (object_samples == 0) return nothing_seen_warning(scene, frames, first_head_, profile);
  return frames_ == frames && brightest_ < kDark ? dark_warning(scene) : std::string();
}

std::string DrawnPictures::dark_warning(const Scene& scene) const {
  const std::string light = strongest_light(scene);
  const std::string now = fixed_text(std::log2(exposure_), 1) + " EV";
  if (!(brightest_ > 0))
    return "all pictures are black, at any --exposure: no light reaches what is in view" +
           (light.empty() ? "; add a light" : "; move lights towards it, or give " + light);
  const double stops = std::floor(std::log2(kBrightened / brightest_) + std::log2(exposure_));
  return "all pictures are darker than 1/255 of white at " + now + ", the brightest value is " +
         two_digits(brightest_) + "; give --auto-exposure, or --exposure " +
         fixed_text(std::min(stops, kMostStops), 0) + (light.empty() ? "" : ", or " + light);
}

}  // namespace herr
