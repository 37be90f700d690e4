// How the time of a study is shared out: what a setting takes, what the clip takes, what is left out.
#include <algorithm>
#include <cmath>

#include "server/study/measure/measure_setting.h"
#include "server/study/plan/study_budget.h"
#include "server/study/study_run.h"

namespace herr {
namespace {

constexpr double kMostShareOfClip = 0.15;

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

// From the two bases at the first frame: errors cost what they cost there, frames in proportion.
double StudyRun::estimated_seconds(const StudySetting& setting) const {
  const std::int64_t frame = subject_.frames().frames.front().number;
  const StudyRow *hard = row_of(default_name(kHardSamples), frame),
                 *soft = row_of(default_name(kSoftSamples), frame);
  const RenderSettings settings = with_changes(subject_.defaults(), setting.changes);
  const RenderSettings& usual = subject_.defaults();
  const double per_sample_s =
      1e-3 * std::max(0.0, soft->frame_ms - hard->frame_ms) / (kSoftSamples - kHardSamples);
  const double unit_s = 1e-3 * hard->frame_ms;
  const auto seconds_of_frame = [&](const RenderSettings& of) {
    double size = static_cast<double>(of.polar_width) * of.polar_height /
                  (static_cast<double>(usual.polar_width) * usual.polar_height);
    if (of.foveation == Foveation::off) size = 4 * of.scale * of.scale;
    return size * (unit_s + per_sample_s * (of.light_samples - kHardSamples));
  };
  const MeasuringRules rules = measuring_rules();
  // As time_pairs() goes about it: a long frame is rendered twice, a short one in every pair and once before.
  const auto seconds_of_timing = [&](double frame_s) {
    const double pairs_s = 2 * (unit_s + frame_s);
    const bool is_long = 2 * frame_s > rules.timing.seconds / rules.timing.blocks;
    return unit_s +
           (is_long ? rules.timing.fewest_blocks * pairs_s : frame_s + rules.timing.blocks * pairs_s);
  };
  const double frame_s = seconds_of_frame(settings);
  const double fixed_s = std::max(0.05, soft->seconds - seconds_of_timing(1e-3 * soft->frame_ms));
  double seconds = fixed_s + seconds_of_timing(frame_s);
  if (setting.own == OwnReference::seeds) {
    // About so many settings share a reference of 16 frames.
    constexpr double kShare = 16.0 / 5;
    seconds +=
        rules.bias_seeds * frame_s + kShare * seconds_of_frame(with_changes(settings, setting.own_limit));
  }
  if (settings.probes.on) {
    constexpr double kRest_s = 0.4;  // of the default's probes
    seconds += kRest_s * settings.probes.rays / usual.probes.rays * std::pow(settings.probes.density, 3);
  }
  return seconds;
}

void StudyRun::share_time() {
  if (state_.settings) return;
  const std::int64_t first = subject_.frames().frames.front().number;
  std::vector<StudySetting> bases;
  for (const StudySetting& setting : sweeps_.settings) {
    if (setting.knob == "default") bases.push_back(setting);
  }
  subject_.rewind();
  measure_frame(bases, first, HUGE_VAL);
  std::vector<double> costs;
  for (const StudySetting& setting : sweeps_.settings) costs.push_back(estimated_seconds(setting));
  const double left = std::max(1.0, until_clip_s() - seconds());
  const StudyBudget budget = fit_to_time(sweeps_.settings, costs, subject_.frames().frames.size(), left);
  state_.settings.emplace();
  for (const StudySetting& setting : budget.settings) state_.settings->push_back(setting.name);
  state_.frames = budget.frames;
  state_.dropped = budget.dropped;
  write_state(folder_.state(), state_);
}

}  // namespace herr
