#include "server/quality/deadline_policy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace herr {
namespace {

constexpr double kResolutionMs = 1e-3;  // below it times do not differ
constexpr double kLargestRatio = 1e9;
constexpr double kLongestStep_s = 3600;

// What is known fades with the time that went by; a clock that jumped back says nothing.
double seconds_between(TimeNs before_ns, TimeNs now_ns) {
  if (now_ns <= before_ns) return 0;
  // Unsigned: the difference of any two.
  const auto gone_ns = static_cast<std::uint64_t>(now_ns) - static_cast<std::uint64_t>(before_ns);
  return std::min(static_cast<double>(gone_ns) * kSecondsPerNs, kLongestStep_s);
}

double measured_ms(const FrameCost& cost) {
  return std::isfinite(cost.total_ms) ? std::clamp(cost.total_ms, 0.0, kLongestMs) : kLongestMs;
}

// How much longer than forecast a frame took; 1: as forecast.
double ratio_to(const CostModel& model, const FrameCost& cost) {
  const double forecast_ms = model.predict_ms(cost.quality);
  return std::min((measured_ms(cost) + kResolutionMs) / (forecast_ms + kResolutionMs), kLargestRatio);
}

}  // namespace

DeadlinePolicy::DeadlinePolicy(const DeadlineConfig& config)
    : config_(config), size_(least_size(config.limits.narrowest)), wait_s_(config.more_light_after_s) {
  const QualityLimits& limits = config_.limits;
  Effort effort{limits.full.light_samples, limits.full.probes};
  efforts_.push_back(effort);
  while (effort.light_samples > 1) {
    const auto below = static_cast<unsigned>(effort.light_samples - 1);
    effort.light_samples = static_cast<int>(std::bit_floor(below));
    efforts_.push_back(effort);
  }
  while (effort.probes > limits.fewest_probes) {
    effort.probes = std::max(limits.fewest_probes, effort.probes / 2);
    efforts_.push_back(effort);
  }
  effort_ = efforts_.size() - 1;
}

double DeadlinePolicy::deviation() const {
  return std::sqrt(variance_);
}

double DeadlinePolicy::headroom() const {
  return std::max(config_.least_headroom, config_.headroom_deviations * deviation());
}

FrameQuality DeadlinePolicy::with_effort(std::size_t level, const FrameQuality& wish) const {
  FrameQuality quality = wish;
  quality.light_samples = std::min(quality.light_samples, efforts_[level].light_samples);
  quality.probes = std::min(quality.probes, efforts_[level].probes);
  return quality;
}

bool DeadlinePolicy::fits(std::size_t level, double share, const FrameQuality& wish, double aim_ms) const {
  return model_.width_for(aim_ms, with_effort(level, wish)) >= share * wish.polar_width;
}

// Less at once, as much less as it takes; more one step at a time, when it has fitted for a while.
bool DeadlinePolicy::choose_effort(const FrameQuality& wish, double aim_ms) {
  const std::size_t before = effort_;
  while (effort_ + 1 < efforts_.size() && !fits(effort_, config_.less_light_below, wish, aim_ms)) ++effort_;
  if (effort_ != before) {
    // What was taken back soon after it was given was given too early.
    const bool too_early = since_more_s_ < 10 * config_.more_light_after_s;
    wait_s_ = too_early ? std::min(2 * wait_s_, config_.longest_wait_s) : config_.more_light_after_s;
    ready_s_ = 0;
    return true;
  }
  // While the wish is for less than this step has, nothing is learnt about a higher one.
  const bool bound = wish.light_samples < efforts_[effort_].light_samples;
  if (effort_ == 0 || bound || !fits(effort_ - 1, config_.more_light_above, wish, aim_ms)) {
    ready_s_ = 0;
    return false;
  }
  if (ready_s_ < wait_s_ || hold_ > 0) return false;
  --effort_;
  ready_s_ = since_more_s_ = 0;
  return true;
}

double DeadlinePolicy::columns_of(const PolarSize& size) const {
  const int rows = config_.limits.full.polar_height;
  return rows == size.height ? size.width : static_cast<double>(size.width) * size.height / rows;
}

// Rows and columns shrink by powers of the share of the whole that end at their least together. Where one of
// them is fixed the size is what the other is rounded to.
DeadlinePolicy::PolarSize DeadlinePolicy::size_of(double columns, int narrowest, int widest) const {
  const int rows = config_.limits.full.polar_height, lowest = config_.limits.lowest;
  if (lowest >= rows) return {static_cast<int>(columns), rows, std::floor(columns)};
  constexpr double kRounding = 1 + 1e-9;  // a height there and back is the same one
  const double of_rows = std::log(static_cast<double>(rows) / lowest),
               of_columns = std::log(static_cast<double>(widest) / narrowest);
  const double share = std::pow(columns / widest, of_rows / (of_rows + of_columns));
  const int height = std::clamp(2 * static_cast<int>(rows * share / 2 * kRounding), lowest, rows);
  const int width = static_cast<int>(columns * rows / height * kRounding);
  PolarSize size{std::clamp(width, narrowest, widest), height, columns};
  if (narrowest == widest) size.columns = columns_of(size);
  return size;
}

double DeadlinePolicy::wanted_columns(double fitting, QualityReason& reason) const {
  const double before = size_.columns;
  if (missed_in_row_ >= 2 && fitting > config_.overload_share * before) {
    reason = QualityReason::overload;
    return config_.overload_share * before;
  }
  if (fitting >= config_.keep_above * before && fitting <= config_.keep_below * before) {
    reason = QualityReason::steady;
    return before;
  }
  if (fitting > before && hold_ > 0) {
    reason = QualityReason::hold;
    return before;
  }
  if (fitting > config_.growth * before) {
    reason = QualityReason::grow_limited;
    return config_.growth * before;
  }
  reason = fitting < before ? QualityReason::shrink : QualityReason::grow;
  return fitting;
}

DeadlinePolicy::PolarSize DeadlinePolicy::least_size(int narrowest) const {
  PolarSize least{narrowest, config_.limits.lowest, 0};
  least.columns = columns_of(least);
  return least;
}

DeadlinePolicy::PolarSize DeadlinePolicy::choose_size(const FrameQuality& quality, double aim_ms,
                                                      QualityReason& reason) const {
  const int widest = quality.polar_width, narrowest = std::min(config_.limits.narrowest, widest);
  const double wanted = wanted_columns(model_.width_for(aim_ms, quality), reason);
  if (wanted >= widest) {
    reason = QualityReason::full;
    return {widest, quality.polar_height, static_cast<double>(widest)};
  }
  const PolarSize least = least_size(narrowest);
  if (wanted < least.columns) {
    reason = QualityReason::floor;
    return least;
  }
  return size_of(wanted, narrowest, widest);
}

QualityDecision DeadlinePolicy::decide(const FrameQuality& wish) {
  QualityDecision decision;
  decision.aim_ms = config_.target_ms / (1 + headroom());
  if (!knows_) {
    decision.quality = with_effort(effort_, wish);
    size_ = least_size(std::min(config_.limits.narrowest, wish.polar_width));
    decision.quality.polar_width = size_.width;
    decision.quality.polar_height = size_.height;
    decision.reason = QualityReason::start;
    return decision;
  }
  const std::size_t effort_before = effort_;
  const bool other_effort = choose_effort(wish, *decision.aim_ms);
  decision.quality = with_effort(effort_, wish);
  size_ = choose_size(decision.quality, *decision.aim_ms, decision.reason);
  decision.quality.polar_width = size_.width;
  decision.quality.polar_height = size_.height;
  decision.predicted_ms = std::min(model_.predict_ms(decision.quality), kLongestMs);
  if (decision.reason == QualityReason::floor) {
    if (*decision.predicted_ms > config_.target_ms) decision.reason = QualityReason::floor_too_slow;
  } else if (other_effort) {
    decision.reason = effort_ > effort_before ? QualityReason::less_light : QualityReason::more_light;
  }
  return decision;
}

// A single frame moves the measured deviation by no more than the band within which it still is noise: a step
// of the load is none, and noise that has become larger is learnt in a few frames.
void DeadlinePolicy::learn_noise(double ratio, double band) {
  const double off = std::clamp(ratio - 1, -band, band);
  variance_ += (off * off - variance_) / config_.noise_frames;
  variance_ = std::min(variance_, config_.largest_deviation * config_.largest_deviation);
}

void DeadlinePolicy::observe(const FrameCost& cost) {
  const double dt_s = seconds_between(knows_ ? observed_ns_ : cost.finished_ns, cost.finished_ns);
  observed_ns_ = cost.finished_ns;
  const bool missed = cost.missed || measured_ms(cost) > config_.target_ms;
  missed_in_row_ = missed ? std::min(missed_in_row_ + 1, 1000) : 0;
  hold_ = missed ? config_.hold_frames : std::max(0, hold_ - 1);
  // Time passes by the frame here: after a clock's jump nobody has waited.
  const double waited_s = std::min(dt_s, 2e-3 * config_.target_ms);
  ready_s_ = std::min(ready_s_ + waited_s, 2 * config_.longest_wait_s);
  since_more_s_ = std::min(since_more_s_ + waited_s, 2 * config_.longest_wait_s);
  if (!knows_) {
    knows_ = true;
    model_.learn(cost, 0);
    return;
  }
  const double floor_deviation = config_.least_headroom / config_.headroom_deviations;
  const double band = config_.jump_deviations * std::max(deviation(), floor_deviation);
  // A slow frame whose successor is as it was before was a hiccup: what it taught is forgotten.
  if (before_jump_ && std::abs(ratio_to(*before_jump_, cost) - 1) <= band) model_ = *before_jump_;
  before_jump_.reset();
  const double ratio = ratio_to(model_, cost);
  const bool slow = ratio > 1 + band;
  if (slow) before_jump_ = model_;
  // A slow frame is believed sooner than a fast one: a mistake then costs a narrow frame,
  // the other way a late one.
  const bool jump = slow || ratio * std::pow(1 + band, 3) < 1;
  learn_noise(ratio, band);
  const double tau_s = ratio > 1 ? config_.rise_tau_s : config_.fall_tau_s;
  model_.learn(cost, jump ? 0.0 : std::exp(-dt_s / tau_s));
}

}  // namespace herr
