// How the time of a study is shared out: what a setting takes, what the clip takes, what is left out.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "server/process/terminal.h"
#include "server/study/measure/measure_setting.h"
#include "server/study/plan/reference_forecast.h"
#include "server/study/plan/short_plan.h"
#include "server/study/plan/study_budget.h"
#include "server/study/reference/reference_spec.h"
#include "server/study/study_run.h"
#include "server/text/number_text.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr double kMostShareOfClip = 0.15;
constexpr double kSoftOverHard = 8;  // times of a frame, of the sample session about (MEASURED.md, Table 1)
constexpr double kOverdrawn = 1.25;  // of its share: what a last pass may take more
constexpr double kLeastShareForAdvice = 0.25;
constexpr double kSeedFramesOfOne = 16.0 / 5;  // about so many settings share a reference of 16 frames
constexpr double kMostShareOfSoft = 0.25;      // its default, beside sweeps that were asked for
constexpr double kReserve = 1.25;              // estimates are off, and machines busy

}  // namespace

double StudyRun::clip_seconds() const {
  double of_pass = 0;
  for (const auto& [frame, reference] : state_.references) {
    if (reference.settings == "seeds" || reference.passes == 0) continue;
    of_pass =
        std::max(of_pass, reference.seconds / (2.0 * std::max(reference.passes, reference.most_passes)));
  }
  return static_cast<double>(subject_.frames().clip.size()) * (2 * kClipPasses * of_pass + 4);
}

// Kept free for the clip, unless it would take too much of the time.
double StudyRun::until_clip_s() const {
  const double clip_s = clip_seconds() <= kMostShareOfClip * limit_s() ? clip_seconds() : 0;
  return limit_s() - clip_s - kReportSeconds;
}

// From the two bases at the first frame, in proportion; with hard light alone by what soft light mostly
// takes.
double StudyRun::seconds_of_frame(const RenderSettings& of) const {
  const std::int64_t frame = subject_.frames().frames.front().number;
  const StudyRow *hard = row_of(default_name(kHardSamples), frame),
                 *soft = row_of(default_name(kSoftSamples), frame);
  const RenderSettings& usual = subject_.defaults();
  const double soft_ms = soft != nullptr ? soft->frame_ms : kSoftOverHard * hard->frame_ms;
  const double per_sample_s = 1e-3 * std::max(0.0, soft_ms - hard->frame_ms) / (kSoftSamples - kHardSamples);
  double size = static_cast<double>(of.polar_width) * of.polar_height /
                (static_cast<double>(usual.polar_width) * usual.polar_height);
  if (of.foveation == Foveation::off) size = 4 * of.scale * of.scale;
  return size * (1e-3 * hard->frame_ms + per_sample_s * (of.light_samples - kHardSamples));
}

// Beyond the share of it that estimated_seconds() counts; 0 while nothing is known.
double StudyRun::reference_seconds(const StudySetting& setting) const {
  const std::int64_t frame = subject_.frames().frames.front().number;
  if (setting.own != OwnReference::seeds || row_of(default_name(kHardSamples), frame) == nullptr) return 0;
  const ReferenceSpec spec = own_reference(subject_.defaults(), setting);
  return (2 * spec.passes - kSeedFramesOfOne) * seconds_of_frame(spec.settings);
}

// References of many seeds are of the sweep: no share for each.
std::vector<SettingCost> StudyRun::costs() const {
  std::vector<SettingCost> costs;
  for (const StudySetting& setting : sweeps_.settings) {
    SettingCost cost{estimated_seconds(setting), "", 0};
    if (setting.own == OwnReference::seeds) {
      const ReferenceSpec spec = own_reference(subject_.defaults(), setting);
      const double share_s = kSeedFramesOfOne * seconds_of_frame(spec.settings);
      cost = {cost.seconds - share_s, spec.name, reference_seconds(setting) + share_s};
    }
    costs.push_back(cost);
  }
  return costs;
}

// From the bases at the first frame: errors cost what they cost there, frames in proportion.
double StudyRun::estimated_seconds(const StudySetting& setting) const {
  const std::int64_t frame = subject_.frames().frames.front().number;
  const StudyRow *hard = row_of(default_name(kHardSamples), frame),
                 *soft = row_of(default_name(kSoftSamples), frame);
  const RenderSettings settings = with_changes(subject_.defaults(), setting.changes);
  const RenderSettings& usual = subject_.defaults();
  const double unit_s = 1e-3 * hard->frame_ms;
  const MeasuringRules rules = measuring_rules();
  // As time_pairs() goes about it: a long frame is rendered twice, a short one in every pair and once before.
  const auto seconds_of_timing = [&](double frame_s) {
    const double pairs_s = 2 * (unit_s + frame_s);
    const bool is_long = 2 * frame_s > rules.timing.seconds / rules.timing.blocks;
    return unit_s +
           (is_long ? rules.timing.fewest_blocks * pairs_s : frame_s + rules.timing.blocks * pairs_s);
  };
  const double frame_s = seconds_of_frame(settings);
  const StudyRow& base = soft != nullptr ? *soft : *hard;
  const double fixed_s = std::max(0.05, base.seconds - seconds_of_timing(1e-3 * base.frame_ms));
  double seconds = fixed_s + seconds_of_timing(frame_s);
  if (setting.own == OwnReference::seeds) {
    seconds += rules.bias_seeds * frame_s +
               kSeedFramesOfOne * seconds_of_frame(with_changes(settings, setting.own_limit));
  }
  if (settings.probes.on) {
    constexpr double kRest_s = 0.4;  // of the default's probes
    seconds += kRest_s * settings.probes.rays / usual.probes.rays * std::pow(settings.probes.density, 3);
  }
  return seconds;
}

// What is known before a setting is measured; 0 where nothing is.
double StudyRun::expected_seconds(const StudySetting& setting) const {
  const std::int64_t first = subject_.frames().frames.front().number;
  const StudyRow *hard = row_of(default_name(kHardSamples), first),
                 *soft = row_of(default_name(kSoftSamples), first);
  if (hard != nullptr && soft != nullptr) return estimated_seconds(setting);
  if (hard == nullptr || setting.name != default_name(kSoftSamples)) return 0;
  return kSoftOverHard * hard->seconds;
}

// The first frame's are made whatever they take; further ones where those before leave room for their like.
bool StudyRun::has_time_for_references(std::size_t frame) const {
  if (frame == 0) return true;
  const double half_s = kShareOfReferences * limit_s(), spent_s = pixel_references_s();
  const double share_s =
      half_s * static_cast<double>(frame) / static_cast<double>(subject_.frames().frames.size());
  return spent_s <= kOverdrawn * share_s || spent_s * (1 + 1 / static_cast<double>(frame)) <= half_s;
}

// Decided, and told, after the first pass of the first one that is made.
bool StudyRun::references_are_coarse(double two_passes_s) {
  if (coarse_) return *coarse_;
  const std::string what =
      too_long_references(two_passes_s, options_.minutes, subject_.defaults(), options_.profile_scale);
  coarse_ = !what.empty();
  if (*coarse_) {
    print_message("warning: " + what);
    warnings_.push_back(what);
  }
  return *coarse_;
}

// The default with hard light, whatever it takes; with soft light where the time is enough.
void StudyRun::measure_bases() {
  const std::int64_t first = subject_.frames().frames.front().number;
  for (const int samples : {kHardSamples, kSoftSamples}) {
    std::vector<StudySetting> base;
    for (const StudySetting& setting : sweeps_.settings) {
      if (setting.name == default_name(samples)) base.push_back(setting);
    }
    subject_.rewind();
    // Of sweeps that were asked for soft light is no more than a part.
    const double left_s = until_clip_s() - seconds(),
                 soft_s = options_.only.empty() ? left_s : kMostShareOfSoft * left_s;
    measure_frame(base, first, samples == kHardSamples ? HUGE_VAL : seconds() + soft_s);
  }
}

void StudyRun::share_time() {
  if (state_.settings) return;
  measure_bases();
  const std::size_t all = subject_.frames().frames.size();
  StudyBudget budget;
  const double left = std::max(1.0, until_clip_s() - seconds());
  if (!options_.only.empty()) {
    budget = fit_in_order(sweeps_.settings, costs(), referenced_frames_, left);
  } else if (row_of(default_name(kSoftSamples), subject_.frames().frames.front().number) == nullptr) {
    for (const StudySetting& setting : sweeps_.settings) {
      if (setting.name == default_name(kHardSamples)) budget.settings.push_back(setting);
    }
    budget.dropped.push_back("all but the default with hard light: " +
                             std::to_string(sweeps_.settings.size() - budget.settings.size()) + " settings");
  } else {
    std::vector<double> costs;
    for (const StudySetting& setting : sweeps_.settings) costs.push_back(estimated_seconds(setting));
    budget = fit_to_time(sweeps_.settings, costs, referenced_frames_, left);
  }
  if (referenced_frames_ < all) {
    budget.dropped.push_back(std::to_string(all - referenced_frames_) + " of " + std::to_string(all) +
                             " frames: their references would have taken more than half of the time");
  }
  print_message("plan: " + std::to_string(budget.settings.size()) + " of " +
                std::to_string(sweeps_.settings.size()) + " settings on " + std::to_string(budget.frames) +
                " of " + counted(static_cast<std::int64_t>(all), "frame", "frames") +
                " are expected to fit into --minutes " + shortest_text(options_.minutes));
  const auto all_settings = static_cast<double>(sweeps_.settings.size());
  if (static_cast<double>(budget.settings.size()) < kLeastShareForAdvice * all_settings) {
    print_message("warning: --minutes " + shortest_text(options_.minutes) + " is enough for " +
                  std::to_string(budget.settings.size()) + " of " + std::to_string(sweeps_.settings.size()) +
                  " settings, too few for a recommendation; give --minutes " +
                  fixed_text(minutes_for_advice(), 0) + " or more");
  }
  state_.settings.emplace();
  for (const StudySetting& setting : budget.settings) state_.settings->push_back(setting.name);
  state_.frames = budget.frames;
  state_.dropped = budget.dropped;
  write_state(folder_.state(), state_);
}

// So long that a quarter of the settings can be measured on one frame, references half of it.
double StudyRun::minutes_for_advice() const {
  const double references_s =
      pixel_references_s() / static_cast<double>(std::max<std::size_t>(1, referenced_frames_));
  const std::int64_t first = subject_.frames().frames.front().number;
  double rows_s = 0;
  for (const StudySetting& setting : sweeps_.settings) {
    const StudyRow* hard = row_of(default_name(kHardSamples), first);
    const bool both = row_of(default_name(kSoftSamples), first) != nullptr && hard != nullptr;
    rows_s += kLeastShareForAdvice * (both   ? estimated_seconds(setting)
                                      : hard ? kSoftOverHard / 2 * hard->seconds
                                             : 0);
  }
  const double needed_s = std::max(references_s / kShareOfReferences, references_s + rows_s) + kReportSeconds;
  return std::max(std::ceil(options_.minutes + 0.5), std::ceil(kReserve * needed_s / 60));
}

std::string StudyRun::no_advice() const {
  std::size_t measured = 0;
  const auto& frames = subject_.frames().frames;
  for (const StudySetting& setting : sweeps_.settings) {
    const auto on_frame = [&](const StudyFrame& frame) { return is_measured(setting.name, frame.number); };
    if (std::all_of(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(state_.frames), on_frame))
      ++measured;
  }
  const auto all = static_cast<double>(sweeps_.settings.size());
  if (static_cast<double>(measured) >= kLeastShareForAdvice * all) return {};
  return std::to_string(measured) + " of " + std::to_string(sweeps_.settings.size()) +
         " settings measured: no recommendation; give --minutes " + fixed_text(minutes_for_advice(), 0) +
         " or more";
}

}  // namespace herr
