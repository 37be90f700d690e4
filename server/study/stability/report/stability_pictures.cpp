#include "server/study/stability/report/stability_pictures.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "server/study/report/difference_picture.h"
#include "server/study/stability/report/stability_verdict.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr std::size_t kMostShown = 3;
constexpr int kShownPanelPx = 300;
constexpr int kMostGainBits = 20;  // differences of 1e-6 of white fill the ramp

// The largest power of two at which no difference leaves the ramp.
double gain_for(const RelationPictures& pictures) {
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<float>&got = pictures.got.plane[c], &wanted = pictures.wanted.plane[c];
    for (std::size_t i = 0; i < std::min(got.size(), wanted.size()); ++i) {
      const double apart = std::abs(double{got[i]} - double{wanted[i]});
      if (std::isfinite(apart)) largest = std::max(largest, apart);
    }
  }
  if (!(largest > 0)) return 1;
  return std::exp2(std::clamp(std::floor(-std::log2(largest)), 0.0, double{kMostGainBits}));
}

StudyPicture picture_of_result(const RelationResult& result) {
  const RelationPictures& pictures = *result.pictures;
  const double gain = gain_for(pictures);
  StudyPicture picture = difference_picture(result.group + ": " + result.relation.name, pictures.got,
                                            pictures.wanted, gain, kShownPanelPx);
  picture.caption = pictures.caption + "; " + verdict_text(result) + ": error " + error_figure(result.error) +
                    ", bound " + bound_figure(result.relation.bound) + " (" + result.relation.unit +
                    "). The difference is that of the brightest channel times " + shortest_text(gain) +
                    ", from black over red and yellow to white.";
  if (!result.where.empty()) picture.caption += " Worst: " + result.where + ".";
  return picture;
}

}  // namespace

std::vector<StudyPicture> worst_shown(std::span<const RelationResult> results) {
  std::vector<StudyPicture> shown;
  for (const RelationResult* result : worst_first(results)) {
    if (shown.size() < kMostShown && result->pictures) shown.push_back(picture_of_result(*result));
  }
  return shown;
}

}  // namespace herr
