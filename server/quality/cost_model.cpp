#include "server/quality/cost_model.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

constexpr double kMsPerNs = 1e-6;
constexpr double kFreeWidth = 1e9;

double sane_ms(double ms) {
  return std::isfinite(ms) ? std::clamp(ms, 0.0, kLongestMs) : kLongestMs;
}

double smoothed(double before, double now, double keep) {
  return now + (before - now) * keep;
}

// Samples of a polar buffer; a height of none is of a frame that tells none, and never changes.
double samples(const FrameQuality& quality) {
  return static_cast<double>(quality.polar_width) * std::max(1, quality.polar_height);
}

// Units of work of a kind in a frame.
double units(std::size_t kind, const FrameQuality& quality) {
  switch (static_cast<WorkKind>(kind)) {
    case WorkKind::light:
      return samples(quality) * quality.light_samples;
    case WorkKind::probe:
      return quality.probes;
    case WorkKind::eye:
    case WorkKind::occlusion:
    case WorkKind::second:
      break;
  }
  return samples(quality);
}

}  // namespace

void CostModel::learn(const FrameCost& cost, double keep) {
  double rest_ms = sane_ms(cost.total_ms);
  for (std::size_t kind = 0; kind < kWorkKinds; ++kind) {
    const double units_done = units(kind, cost.quality);
    const auto rays = static_cast<double>(cost.rays[kind]);
    if (!(rays > 0 && units_done > 0)) {  // its time, if any, is not by the ray
      rays_per_unit_[kind] = 0;
      continue;
    }
    const double ms = std::min(sane_ms(cost.work_ms[kind]), rest_ms);
    rest_ms -= ms;
    const bool first = ns_per_ray_[kind] == 0;
    ns_per_ray_[kind] = smoothed(ns_per_ray_[kind], ms / kMsPerNs / rays, first ? 0.0 : keep);
    const double now = rays / units_done;
    rays_per_unit_[kind] = std::max(now, smoothed(rays_per_unit_[kind], now, keep));
  }
  fixed_ms_ = smoothed(fixed_ms_, rest_ms, keep);
}

double CostModel::per_column_ms(const FrameQuality& quality) const {
  const FrameQuality one_column{quality.light_samples, 1, 0, quality.polar_height};
  double ms = 0;
  for (std::size_t kind = 0; kind < kWorkKinds; ++kind) {
    ms += kMsPerNs * ns_per_ray_[kind] * rays_per_unit_[kind] * units(kind, one_column);
  }
  return ms;
}

double CostModel::without_columns_ms(const FrameQuality& quality) const {
  constexpr auto kProbe = static_cast<std::size_t>(WorkKind::probe);
  return fixed_ms_ + kMsPerNs * ns_per_ray_[kProbe] * rays_per_unit_[kProbe] * units(kProbe, quality);
}

double CostModel::predict_ms(const FrameQuality& quality) const {
  return without_columns_ms(quality) + quality.polar_width * per_column_ms(quality);
}

double CostModel::width_for(double budget_ms, const FrameQuality& quality) const {
  const double left_ms = budget_ms - without_columns_ms(quality);
  const double column_ms = per_column_ms(quality);
  if (left_ms <= 0) return 0;
  return column_ms * kFreeWidth > left_ms ? left_ms / column_ms : kFreeWidth;
}

}  // namespace herr
