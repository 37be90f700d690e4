#include "server/output/exposure.h"

#include <algorithm>
#include <cmath>

namespace herr {

double scale_of_ev(double ev) {
  return std::exp2(ev);
}

std::optional<double> automatic_ev(const LightPicture& picture, const std::vector<std::uint8_t>& of_surface,
                                   const ExposureRule& rule) {
  std::vector<float> levels;
  for (std::size_t i = 0; i < picture.pixels(); ++i) {
    if (!of_surface.empty() && of_surface[i] == 0) continue;
    const float* texel = &picture.rgba[4 * i];
    levels.push_back(std::max({texel[0], texel[1], texel[2]}));
  }
  if (levels.empty()) return std::nullopt;
  const auto place = static_cast<std::size_t>(rule.share * static_cast<double>(levels.size() - 1));
  std::nth_element(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(place), levels.end());
  const double level = double{levels[place]};
  if (!(level > 0)) return std::nullopt;
  return std::clamp(std::log2(rule.level / level), -kLargestEv, rule.most_ev);
}

void srgb8_from_light(const LightPicture& picture, double ev, bool with_alpha, Srgb8Image& out) {
  out.width_px = picture.width_px;
  out.height_px = picture.height_px;
  out.channels = with_alpha ? 4 : 3;
  out.nonfinite_values = 0;
  out.values.resize(picture.pixels() * static_cast<std::size_t>(out.channels));
  const std::array<std::uint8_t, 65536>& table = srgb8_of_half();
  const auto scale = static_cast<float>(scale_of_ev(ev));
  std::uint8_t* pixel = out.values.data();
  for (std::size_t i = 0; i < picture.pixels(); ++i, pixel += out.channels) {
    const float* texel = &picture.rgba[4 * i];
    for (std::size_t c = 0; c < 4; ++c) out.nonfinite_values += std::isfinite(texel[c]) ? 0 : 1;
    const float alpha = std::clamp(texel[3], 0.0f, 1.0f);
    const float factor = !with_alpha ? scale : alpha > 0 ? scale / alpha : 0.0f;
    // Above 1 is white in any case: the range of halves does not matter.
    for (std::size_t c = 0; c < 3; ++c) pixel[c] = table[half_from_float(std::min(texel[c] * factor, 2.0f))];
    if (with_alpha) pixel[3] = static_cast<std::uint8_t>(std::lround(255.0f * alpha));
  }
}

}  // namespace herr
