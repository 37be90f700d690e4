#include "server/study/relations/picture_distance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "server/output/srgb_table.h"
#include "server/study/report/figure_text.h"

namespace herr {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

void require_same_sizes(const std::vector<LinearPicture>& got, const std::vector<LinearPicture>& wanted) {
  bool same = got.size() == wanted.size();
  for (std::size_t v = 0; same && v < got.size(); ++v) {
    same = got[v].width_px == wanted[v].width_px && got[v].height_px == wanted[v].height_px;
  }
  if (!same) throw std::invalid_argument("pictures of two sizes");
}

double limited(float value) {
  return value > 0.0f ? std::min(double{value}, 1.0) : 0.0;
}

double srgb_step(float linear) {
  return std::isnan(linear) ? -kFar : std::round(255 * srgb_from_linear(limited(linear)));
}

double distance_apart(double a, double b) {
  const double apart = std::abs(a - b);
  return std::isfinite(apart) ? apart : kFar;
}

// Calls visit(viewport, pixel, the colours' largest of of(got, wanted)) for every pixel.
template <typename Of, typename Visit>
void for_each_distance(const std::vector<LinearPicture>& got, const std::vector<LinearPicture>& wanted,
                       const Of& of, const Visit& visit) {
  require_same_sizes(got, wanted);
  for (std::size_t v = 0; v < got.size(); ++v) {
    for (std::size_t i = 0; i < got[v].pixels(); ++i) {
      double largest = 0;
      for (std::size_t c = 0; c < 3; ++c)
        largest = std::max(largest, of(got[v].plane[c][i], wanted[v].plane[c][i]));
      visit(v, i, largest);
    }
  }
}

std::string colour_text(const LinearPicture& picture, std::size_t pixel) {
  std::string text = "(";
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = double{picture.plane[c][pixel]};
    text += (c > 0 ? ", " : "") + (std::isfinite(value) ? figure(value, 4) : std::to_string(value));
  }
  return text + ")";
}

// Finds the farthest pixel.
class Farthest {
 public:
  void offer(std::size_t viewport, std::size_t pixel, double distance) {
    if (distance <= largest_) return;
    largest_ = distance, viewport_ = viewport, pixel_ = pixel, found_ = true;
  }
  double largest() const { return largest_; }
  PictureDistance told(double error, const std::vector<LinearPicture>& got,
                       const std::vector<LinearPicture>* wanted, const DisplayProfile& profile) const {
    PictureDistance out{error, {}, viewport_};
    if (!found_) return out;
    const LinearPicture& picture = got[viewport_];
    const auto width = static_cast<std::size_t>(picture.width_px);
    out.where = profile.viewports[viewport_].name + ", pixel (" + std::to_string(pixel_ % width) + ", " +
                std::to_string(pixel_ / width) + "): " + colour_text(picture, pixel_);
    if (wanted != nullptr) out.where += " instead of " + colour_text((*wanted)[viewport_], pixel_);
    return out;
  }

 private:
  double largest_ = 0;
  std::size_t viewport_ = 0, pixel_ = 0;
  bool found_ = false;
};

}  // namespace

PictureDistance share_beyond_one_step(const std::vector<LinearPicture>& got,
                                      const std::vector<LinearPicture>& wanted,
                                      const DisplayProfile& profile) {
  Farthest farthest;
  double beyond = 0, all = 0;
  for_each_distance(
      got, wanted, [](float a, float b) { return distance_apart(srgb_step(a), srgb_step(b)); },
      [&](std::size_t v, std::size_t i, double steps) {
        all += 1;
        if (steps <= 1) return;
        beyond += 1;
        farthest.offer(v, i, steps);
      });
  return farthest.told(all > 0 ? beyond / all : 0, got, &wanted, profile);
}

PictureDistance largest_relative(const std::vector<LinearPicture>& got,
                                 const std::vector<LinearPicture>& wanted, double floor_share,
                                 const DisplayProfile& profile) {
  double largest = 0;
  for (const LinearPicture& picture : wanted) {
    for (const auto& plane : picture.plane) {
      for (const float value : plane) {
        if (std::isfinite(value)) largest = std::max(largest, std::abs(double{value}));
      }
    }
  }
  const double floor = std::max(floor_share * largest, std::numeric_limits<double>::min());
  Farthest farthest;
  for_each_distance(
      got, wanted,
      [&](float a, float b) {
        const double apart = distance_apart(double{a}, double{b});
        return apart == 0 ? 0 : apart / std::max(std::abs(double{b}), floor);
      },
      [&](std::size_t v, std::size_t i, double apart) { farthest.offer(v, i, apart); });
  return farthest.told(farthest.largest(), got, &wanted, profile);
}

PictureDistance largest_of_sum(const std::vector<LinearPicture>& got,
                               const std::vector<LinearPicture>& wanted,
                               const std::vector<LinearPicture>& sum, double least,
                               const DisplayProfile& profile) {
  require_same_sizes(got, wanted);
  require_same_sizes(got, sum);
  Farthest farthest;
  for (std::size_t v = 0; v < got.size(); ++v) {
    for (std::size_t i = 0; i < got[v].pixels(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double apart = distance_apart(double{got[v].plane[c][i]}, double{wanted[v].plane[c][i]});
        farthest.offer(v, i, apart / (double{sum[v].plane[c][i]} + least));
      }
    }
  }
  return farthest.told(farthest.largest(), got, &wanted, profile);
}

PictureDistance differing_values(const std::vector<LinearPicture>& got,
                                 const std::vector<LinearPicture>& wanted, const DisplayProfile& profile) {
  Farthest farthest;
  double count = 0;
  for_each_distance(
      got, wanted,
      [&](float a, float b) {
        const bool differ = std::bit_cast<std::uint32_t>(a) != std::bit_cast<std::uint32_t>(b);
        count += differ ? 1 : 0;
        return differ ? std::max(distance_apart(double{a}, double{b}), 1e-300) : 0.0;
      },
      [&](std::size_t v, std::size_t i, double apart) { farthest.offer(v, i, apart); });
  return farthest.told(count, got, &wanted, profile);
}

double rms_difference(const std::vector<LinearPicture>& got, const std::vector<LinearPicture>& wanted) {
  require_same_sizes(got, wanted);
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < got.size(); ++v) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < got[v].pixels(); ++i) {
        const float a = got[v].plane[c][i], b = wanted[v].plane[c][i];
        const double apart = std::isnan(a) || std::isnan(b) ? kFar : limited(a) - limited(b);
        sum += apart * apart, count += 1;
      }
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

PictureDistance values_not_finite(const std::vector<LinearPicture>& got, const DisplayProfile& profile) {
  Farthest farthest;
  double count = 0;
  for_each_distance(
      got, got,
      [&](float value, float) {
        count += std::isfinite(value) ? 0 : 1;
        return std::isfinite(value) ? 0.0 : kFar;
      },
      [&](std::size_t v, std::size_t i, double apart) { farthest.offer(v, i, apart); });
  return farthest.told(count, got, nullptr, profile);
}

RelationPictures worst_pictures(const PictureDistance& distance, const std::vector<LinearPicture>& got,
                                const std::vector<LinearPicture>& wanted, std::string caption) {
  RelationPictures out{std::move(caption), got[distance.viewport], wanted[distance.viewport]};
  limit_to_white(out.got);
  limit_to_white(out.wanted);
  return out;
}

}  // namespace herr
