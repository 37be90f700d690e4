#include "server/study/error/flicker.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace herr {
namespace {

bool fits(const ViewportMap& map, const LinearPicture& picture) {
  return picture.width_px == map.width_px && picture.height_px == map.height_px &&
         picture.plane[0].size() == map.band.size();
}

}  // namespace

void FlickerSum::add(std::span<const ViewportMap> maps, std::vector<LinearPicture> test,
                     std::vector<LinearPicture> reference) {
  bool same = test.size() == maps.size() && reference.size() == maps.size() &&
              (frames_ == 0 || last_test_.size() == maps.size());
  for (std::size_t v = 0; same && v < maps.size(); ++v) {
    same = fits(maps[v], test[v]) && fits(maps[v], reference[v]) &&
           (frames_ == 0 || fits(maps[v], last_test_[v]));
  }
  if (!same) throw std::invalid_argument("pictures of a clip differ in number or size");
  for (std::size_t v = 0; frames_ > 0 && v < maps.size(); ++v) {
    for (std::size_t y = 0; y < static_cast<std::size_t>(maps[v].height_px); ++y)
      add_row(maps[v], v, y, test[v], reference[v]);
  }
  last_test_ = std::move(test);
  last_reference_ = std::move(reference);
  last_band_.clear();
  for (const ViewportMap& map : maps) last_band_.push_back(map.band);
  ++frames_;
}

void FlickerSum::add_row(const ViewportMap& map, std::size_t viewport, std::size_t y,
                         const LinearPicture& test, const LinearPicture& reference) {
  const LinearPicture &last_test = last_test_[viewport], &last_reference = last_reference_[viewport];
  const auto width = static_cast<std::size_t>(map.width_px);
  std::array<Sum, kAllPixels> row{};
  for (std::size_t i = width * y; i < width * (y + 1); ++i) {
    if (map.band[i] == kNotSeen || last_band_[viewport][i] == kNotSeen) continue;
    float of_test = 0, of_reference = 0, excess = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const float t = test.plane[c][i] - last_test.plane[c][i];
      const float r = reference.plane[c][i] - last_reference.plane[c][i];
      of_test += t * t;
      of_reference += r * r;
      excess += (t - r) * (t - r);
    }
    Sum& sum = row[map.band[i]];
    sum.test += static_cast<double>(of_test);
    sum.reference += static_cast<double>(of_reference);
    sum.excess += static_cast<double>(excess);
    sum.count += 3;
  }
  for (std::size_t band = 0; band < kAllPixels; ++band) {
    for (Sum* total : {&sums_[band], &sums_[kAllPixels]}) {
      total->test += row[band].test;
      total->reference += row[band].reference;
      total->excess += row[band].excess;
      total->count += row[band].count;
    }
  }
}

std::optional<Flicker> FlickerSum::flicker() const {
  if (frames_ < 2) return std::nullopt;
  Flicker result;
  for (std::size_t band = 0; band < kBands; ++band) {
    const Sum& sum = sums_[band];
    const auto rms = [&](double squares) {
      return sum.count > 0 ? std::sqrt(squares / sum.count) : std::numeric_limits<double>::quiet_NaN();
    };
    result.test[band] = rms(sum.test);
    result.reference[band] = rms(sum.reference);
    result.excess[band] = rms(sum.excess);
  }
  return result;
}

}  // namespace herr
