// Exposure: how bright a picture's light is shown, and the one step from linear light to 8-bit sRGB that
// knows it. EV 0 shows radiance 1 as white; each EV more doubles. Before: averaged frames. After: PNG files.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "server/output/srgb_table.h"

namespace herr {

// Linear light, premultiplied RGBA, rows from the top without padding.
struct LightPicture {
  int width_px = 0, height_px = 0;
  std::vector<float> rgba;

  std::size_t pixels() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
};

inline constexpr double kLargestEv = 24;

double scale_of_ev(double ev);

// What automatic exposure asks of what is seen, by the brightest channel of each pixel.
struct ExposureRule {
  double share = 0.99;  // of the pixels of surfaces are to be at most
  double level = 0.9;   // this bright
  double most_ev = 0;   // and are made brighter by no more than that
};

// The EV at which rule.share of the pixels that `of_surface` names (one byte each, 0: not; empty: all) are at
// most rule.level, within [-kLargestEv, rule.most_ev]. None where none is named or they are black.
std::optional<double> automatic_ev(const LightPicture& picture, const std::vector<std::uint8_t>& of_surface,
                                   const ExposureRule& rule);

// Values are multiplied by scale_of_ev(ev) and encoded by the sRGB curve; what is above 1 is white. With
// alpha: colours are divided by alpha before. Without: as they are, i.e. over black.
void srgb8_from_light(const LightPicture& picture, double ev, bool with_alpha, Srgb8Image& out);

}  // namespace herr
