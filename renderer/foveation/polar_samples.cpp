#include "renderer/foveation/polar_samples.h"

#include <algorithm>
#include <cmath>

namespace herr {

PolarSamples::PolarSamples(int max_width, int max_height, int reach) : reach_(reach) {
  const std::size_t columns = static_cast<std::size_t>(max_width) + 32;
  const std::size_t rows = 4 * (static_cast<std::size_t>(max_height) + 16);
  sin_theta_.resize(columns);
  cos_theta_.resize(columns);
  margin_.resize(columns);
  spread_.resize(columns);
  sin_phi4_.resize(rows);
  cos_phi4_.resize(rows);
  divide_circle(max_height, 0);
}

void PolarSamples::divide_circle(int height, double row_off) {
  height_ = height;
  row_off_ = row_off;
  const std::size_t rows = 4 * static_cast<std::size_t>(height);
  for (std::size_t j = 0; j < static_cast<std::size_t>(height); ++j) {
    const double phi = phi_from_v((static_cast<double>(j) + 0.5 + row_off) / height);
    std::fill_n(&sin_phi4_[4 * j], 4, static_cast<float>(std::sin(phi)));
    std::fill_n(&cos_phi4_[4 * j], 4, static_cast<float>(std::cos(phi)));
  }
  constexpr std::size_t kPadding = 4 * 16;
  std::fill_n(&sin_phi4_[rows], kPadding, 0.0f);
  std::fill_n(&cos_phi4_[rows], kPadding, 0.0f);
}

void PolarSamples::update(const PolarMap& map, int width, int height, const CellPlace& place) {
  if (height != height_ || place.row != row_off_) divide_circle(height, place.row);
  width_ = width;
  map_ = map;
  const auto theta_rad = [&](int i) {
    const double deg = map.theta_from_u((i + 0.5 + place.column) / width);
    return std::min(deg, 180.0) / kDegreesPerRadian;
  };
  const double phi_step = glm::two_pi<double>() / height_;
  double theta = theta_rad(0);
  for (int i = 0; i < width; ++i) {
    const auto column = static_cast<std::size_t>(i);
    const double next = theta_rad(i + 1);
    sin_theta_[column] = static_cast<float>(std::sin(theta));
    cos_theta_[column] = static_cast<float>(std::cos(theta));
    const double farthest = theta_rad(i + reach_);
    // The circle's circumference grows up to 90 degrees; 1 bounds its radius beyond.
    const double ring = farthest < glm::half_pi<double>() ? std::sin(farthest) : 1.0;
    const double gap = std::hypot(farthest - theta + (i == 0 ? theta : 0.0), ring * reach_ * phi_step);
    constexpr double kRounding = 1.001;  // the tables and dot products are float
    margin_[column] = static_cast<float>(std::min(gap, 2.0) * kRounding + 1e-6);
    // Between the borders of the column, at u = i / W and (i + 1) / W, and of the row.
    const double inner = map.theta_from_u(i / static_cast<double>(width)) / kDegreesPerRadian;
    const double outer = map.theta_from_u((i + 1) / static_cast<double>(width)) / kDegreesPerRadian;
    spread_[column] = static_cast<float>(std::sqrt((outer - inner) * std::abs(std::sin(theta)) * phi_step));
    theta = next;
  }
  for (std::size_t i = static_cast<std::size_t>(width);
       i < std::min(sin_theta_.size(), static_cast<std::size_t>(width) + 32); ++i) {
    sin_theta_[i] = cos_theta_[i] = margin_[i] = spread_[i] = 0.0f;
  }
}

std::int64_t PolarSamples::bytes() const {
  std::size_t floats = 0;
  for (const auto* table : {&sin_theta_, &cos_theta_, &margin_, &spread_, &sin_phi4_, &cos_phi4_}) {
    floats += table->capacity();
  }
  return static_cast<std::int64_t>(floats * sizeof(float));
}

}  // namespace herr
