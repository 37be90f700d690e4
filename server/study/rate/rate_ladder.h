// The settings that `herr study --hz` chooses from, in one order: each asks for as much as the one before or
// more, in everything. First the picture grows with one light sample, polar buffers and viewports together,
// so that both become sharper at the same pace; then the light samples. Before: the flags say the most of
// each. After: RateSearch.
#pragma once

#include <string>
#include <vector>

namespace herr {

struct RateSetting {
  int polar_width = 788;   // per eye
  int polar_height = 768;  // even
  int light_samples = 1;
  double profile_scale = 1;  // in hundredths

  bool operator==(const RateSetting&) const = default;
};

// As flags take it: "1576x768".
std::string polar_text(const RateSetting& setting);
// "polar 1576x768, light samples 1, profile scale 0.5".
std::string text_of(const RateSetting& setting);

// Ascending, no two alike, at least one; `most` is the last. The first has an eighth of the width, a quarter
// of the height (the floors of the policy deadline), a tenth of the profile scale, or the 0.1 that it may be
// at least, and one light sample. From one to the next the samples of the polar buffers grow by 5 % or by the
// least step of a width or height, then the light samples by half at most.
std::vector<RateSetting> rate_ladder(const RateSetting& most);

}  // namespace herr
