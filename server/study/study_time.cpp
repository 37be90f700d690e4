// What a setting, its reference and the clip are expected to take, from what was measured.
#include <algorithm>
#include <cmath>
#include <string>

#include "server/study/measure/measure_setting.h"
#include "server/study/plan/short_plan.h"
#include "server/study/reference/reference_spec.h"
#include "server/study/study_run.h"

namespace herr {
namespace {

constexpr double kMostShareOfClip = 0.15;
constexpr double kSoftOverHard = 20;           // times of a frame, of the sample session about (MEASURED.md)
constexpr double kSeedFramesOfOne = 16.0 / 5;  // about so many settings share a reference of 16 frames

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

// Of the frames that have references, those without a row of this setting.
double StudyRun::share_of_frames(const StudySetting& setting) const {
  const auto& frames = subject_.frames().frames;
  const auto missing =
      std::count_if(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(referenced_frames_),
                    [&](const StudyFrame& frame) { return !is_measured(setting.name, frame.number); });
  return static_cast<double>(missing) / static_cast<double>(referenced_frames_);
}

// References of many seeds are of the sweep: no share for each. Frames that have their row cost nothing.
std::vector<SettingCost> StudyRun::costs(const std::vector<StudySetting>& settings) const {
  std::vector<SettingCost> costs;
  for (const StudySetting& setting : settings) {
    const double share = share_of_frames(setting);
    if (share == 0) {
      costs.emplace_back();
      continue;
    }
    SettingCost cost{estimated_seconds(setting), "", 0};
    if (setting.own == OwnReference::seeds) {
      const ReferenceSpec spec = own_reference(subject_.defaults(), setting);
      const double share_s = kSeedFramesOfOne * seconds_of_frame(spec.settings);
      cost = {cost.seconds - share_s, spec.name, reference_seconds(setting) + share_s};
    }
    cost.seconds *= share;
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
  return row_of(default_name(kHardSamples), first) == nullptr ? 0 : estimated_seconds(setting);
}

}  // namespace herr
