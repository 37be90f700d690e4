#include "server/study/error/acuity_filter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>

namespace herr {
namespace {

constexpr double kHalfResolutionDeg = 2.3, kAlpha = 0.106, kLogContrasts = 4.1588830833596715;  // ln 64
constexpr int kStripRows = 32, kTileColumns = 128;

// Gaussians by their width in pixels, 128 for each power of two: the upper half of the bits of the width as a
// float is the index. Narrower ones leave the pixel as it is; wider ones are cut to the widest.
constexpr float kNarrowestPx = 0.15f, kWidestPx = 64.0f;
constexpr std::uint32_t kFirstKernel = std::bit_cast<std::uint32_t>(kNarrowestPx) >> 16;
constexpr std::uint32_t kEndKernel = std::bit_cast<std::uint32_t>(kWidestPx) >> 16;
constexpr int kWidestRadius = 192;  // 3 sigma

struct AcuityKernel {
  const float* middle;  // weights from -radius to radius
  int radius;
};

class AcuityKernels {
 public:
  AcuityKernels() {
    std::vector<std::size_t> middles;
    std::vector<int> radii;
    for (std::uint32_t i = kFirstKernel; i < kEndKernel; ++i) {
      const double sigma =
          std::bit_cast<float>((i << 16) + 0x8000u);  // the middle of what the index stands for
      const int radius = std::min(static_cast<int>(std::ceil(3 * sigma)), kWidestRadius);
      middles.push_back(weights_.size() + static_cast<std::size_t>(radius));
      radii.push_back(radius);
      for (int k = -radius; k <= radius; ++k)
        weights_.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma))));
    }
    for (std::size_t i = 0; i < radii.size(); ++i)
      kernels_.push_back({weights_.data() + middles[i], radii[i]});
  }
  // None: the pixel stays as it is.
  const AcuityKernel* of_width(float sigma_px) const {
    if (!(sigma_px >= kNarrowestPx)) return nullptr;
    const std::uint32_t index = std::bit_cast<std::uint32_t>(sigma_px) >> 16;
    return &kernels_[std::min(index, kEndKernel - 1) - kFirstKernel];
  }

 private:
  std::vector<float> weights_;
  std::vector<AcuityKernel> kernels_;
};

const AcuityKernels& acuity_kernels() {
  static const AcuityKernels kernels;
  return kernels;
}

// Standard deviation in degrees at eccentricity e: this times (e + e2).
float sigma_factor() {
  return static_cast<float>(std::sqrt(0.5 * std::log(2.0)) / glm::pi<double>() * kAlpha /
                            (kHalfResolutionDeg * kLogContrasts));
}

// Red, green, blue and 1, or four times 0 where nothing is seen: the weights of a mean add up in the fourth.
struct alignas(16) SeenPixel {
  using Lanes [[gnu::vector_size(16)]] = float;
  Lanes lanes;
};

// The mean of pixels `step` apart from first to last, offsets from `middle`.
SeenPixel weighted_mean(const SeenPixel* middle, std::ptrdiff_t step, const float* weights, int first,
                        int last) {
  SeenPixel::Lanes sum{};
  for (int k = first; k <= last; ++k) sum += weights[k] * middle[k * step].lanes;
  return {sum / sum[3]};
}

struct AcuityPass {
  const ViewportMap& map;
  LinearPicture& picture;
  std::vector<SeenPixel>& along_rows;
  float factor = sigma_factor();

  const AcuityKernel* kernel(std::size_t i, const std::vector<float>& degrees_per_pixel) const {
    const float sigma_deg = factor * (map.eccentricity_deg[i] + static_cast<float>(kHalfResolutionDeg));
    return acuity_kernels().of_width(sigma_deg / degrees_per_pixel[i]);
  }

  // `row`: the width and twice the widest radius, its ends 0.
  void filter_row(int y, std::vector<SeenPixel>& row) const {
    const auto width = static_cast<std::size_t>(map.width_px);
    const std::size_t first = width * static_cast<std::size_t>(y);
    SeenPixel* const pixels = row.data() + kWidestRadius;
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = first + x;
      const bool seen = map.band[i] != kNotSeen;
      pixels[x].lanes =
          seen ? SeenPixel::Lanes{picture.plane[0][i], picture.plane[1][i], picture.plane[2][i], 1}
               : SeenPixel::Lanes{};
    }
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = first + x;
      const AcuityKernel* wide = map.band[i] != kNotSeen ? kernel(i, map.degrees_per_column) : nullptr;
      along_rows[i] =
          wide ? weighted_mean(pixels + x, 1, wide->middle, -wide->radius, wide->radius) : pixels[x];
    }
  }

  // Column by column of a strip of rows, a few columns at a time, so that what they read stays in the cache.
  void filter_columns(int first_row, int end_row) const {
    for (int left = 0; left < map.width_px; left += kTileColumns) {
      const int right = std::min(left + kTileColumns, map.width_px);
      for (int y = first_row; y < end_row; ++y) filter_row_of_columns(y, left, right);
    }
  }

  void filter_row_of_columns(int y, int left, int right) const {
    const std::ptrdiff_t width = map.width_px;
    for (int x = left; x < right; ++x) {
      const auto i = static_cast<std::size_t>(width * y + x);
      SeenPixel pixel = along_rows[i];
      const AcuityKernel* high = map.band[i] != kNotSeen ? kernel(i, map.degrees_per_row) : nullptr;
      if (high) {
        pixel = weighted_mean(&along_rows[i], width, high->middle, std::max(-high->radius, -y),
                              std::min(high->radius, map.height_px - 1 - y));
      }
      for (std::size_t c = 0; c < 3; ++c) picture.plane[c][i] = pixel.lanes[c];
    }
  }
};

}  // namespace

double finest_visible_cycles_per_deg(double eccentricity_deg) {
  return kHalfResolutionDeg * kLogContrasts / (kAlpha * (eccentricity_deg + kHalfResolutionDeg));
}

double acuity_weight(double eccentricity_deg, double solid_angle_sr) {
  constexpr double kDegreesPerRadian = 180 / glm::pi<double>();
  const double samples_per_deg = 2 * finest_visible_cycles_per_deg(eccentricity_deg);
  return solid_angle_sr * kDegreesPerRadian * kDegreesPerRadian * samples_per_deg * samples_per_deg;
}

void low_pass_at_acuity(const ViewportMap& map, LinearPicture& difference, const ParallelFor& parallel_for) {
  std::vector<SeenPixel> along_rows(difference.pixels());
  const AcuityPass pass{map, difference, along_rows};
  const int strips = (map.height_px + kStripRows - 1) / kStripRows;
  const auto end_of = [&](int strip) { return std::min((strip + 1) * kStripRows, map.height_px); };
  parallel_for(strips, [&](int strip) {
    std::vector<SeenPixel> row(static_cast<std::size_t>(map.width_px + 2 * kWidestRadius));
    for (int y = strip * kStripRows; y < end_of(strip); ++y) pass.filter_row(y, row);
  });
  parallel_for(strips, [&](int strip) { pass.filter_columns(strip * kStripRows, end_of(strip)); });
}

}  // namespace herr
