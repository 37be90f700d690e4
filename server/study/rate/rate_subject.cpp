#include "server/study/rate/rate_subject.h"

#include <algorithm>
#include <array>

#include "server/check/measure/cpu_time.h"
#include "server/process/steady_time.h"
#include "server/process/stop_signal.h"
#include "server/results/output_folder.h"
#include "server/settings/quality_target.h"
#include "server/study/plan/study_setting.h"
#include "server/text/number_text.h"
#include "server/text/shell_word.h"

namespace herr {
namespace {

constexpr double kMostSeconds = 20;  // of one measurement that has kFewestFrames
constexpr int kFewestFrames = 20;
constexpr int kFarTooSlow = 3;  // frames of twice the period that are enough to give up
constexpr int kMostLate = kRateFrames / 20;

// A mean of what not all frames have.
class MeanOfSome {
 public:
  void add(const std::array<std::optional<double>, 2>& eyes) {
    if (!eyes[0] && !eyes[1]) return;
    sum_ += eyes[0] && eyes[1] ? std::min(*eyes[0], *eyes[1]) : eyes[0].value_or(eyes[1].value_or(0));
    ++count_;
  }
  std::optional<double> mean() const {
    if (count_ == 0) return std::nullopt;
    return sum_ / count_;
  }

 private:
  double sum_ = 0;
  int count_ = 0;
};

// Adds frames up until a measurement has enough of them.
class TrialFrames {
 public:
  explicit TrialFrames(double period_ms) : period_ms_(period_ms), began_ns_(steady_now_ns()) {
    times_ms_.reserve(kRateFrames), free_ms_.reserve(kRateFrames);
  }

  void add(const RateFrame& frame, const FrameRecord& record, double frame_ms, int cores) {
    const double free_ms =
        free_frame_ms(frame_ms, record.times.frame_ms, record.cpu_ms.value_or(record.times.frame_ms), cores);
    times_ms_.push_back(frame_ms), free_ms_.push_back(free_ms);
    add_to_stretch(frame, frame_ms, free_ms);
    if (frame_ms > period_ms_) ++late_;
    if (frame_ms > 2 * period_ms_) ++far_too_slow_;
    if (frame_ms > kHopelessTimes * period_ms_) ++hopeless_;
    k_radial_.add(record.k_radial), k_angular_.add(record.k_angular);
    trial_.sample_ms += record.sample_ms;
    for (std::size_t i = 0; i < kStageCount; ++i) trial_.stages.ms[i] += record.times.ms[i];
    trial_.stages.frame_ms += record.times.frame_ms;
    MachineUse& machine = trial_.machine;
    machine.cpu_ms += record.cpu_ms.value_or(0), machine.cores_ms += record.times.frame_ms * cores;
    machine.cpu_known = machine.cpu_known && record.cpu_ms.has_value();
    machine.preemptions += record.preemptions.value_or(0);
    if (!record.missed) return;
    ++machine.late;
    if (record.cause == MissCause::machine) ++machine.late_by_machine;
  }
  bool complete(bool to_the_end) const {
    const auto count = static_cast<int>(times_ms_.size());
    if (count >= kRateFrames) return true;
    if (!to_the_end && far_too_slow_ >= kFarTooSlow && far_too_slow_ == count) return true;
    if (count < kFewestFrames) return false;
    if (hopeless_ == count) return true;
    const double seconds = static_cast<double>(steady_now_ns() - began_ns_) * 1e-9;
    return (!to_the_end && late_ > kMostLate) || seconds > kMostSeconds;
  }
  RateTrial result() {
    const auto count = static_cast<double>(times_ms_.size());
    trial_.frames = static_cast<int>(times_ms_.size());
    trial_.all_p95_ms = percentile_95(times_ms_);
    for (Stretch& each : stretches_) {
      each.stretch.p95_ms = percentile_95(each.times_ms);
      trial_.stretches.push_back(each.stretch);
    }
    if (trial_.machine.cpu_known) trial_.free_p95_ms = free_p95_ms();
    const RateStretch* worst = worst_stretch(trial_);
    trial_.p95_ms = std::max(trial_.all_p95_ms, worst != nullptr ? worst->p95_ms : 0.0);
    trial_.cut_short = trial_.frames < kRateFrames;
    trial_.hopeless = hopeless_ == trial_.frames;
    trial_.k_radial = k_radial_.mean(), trial_.k_angular = k_angular_.mean();
    for (const double ms : times_ms_) trial_.frame_ms += ms / count;
    trial_.sample_ms /= count, trial_.stages.frame_ms /= count;
    for (double& ms : trial_.stages.ms) ms /= count;
    return trial_;
  }
  MachineUse& machine() { return trial_.machine; }

 private:
  struct Stretch {
    int number = 0;
    RateStretch stretch;
    std::vector<double> times_ms, free_ms;
  };
  double free_p95_ms() const {
    double worst_ms = percentile_95(free_ms_);
    for (const Stretch& each : stretches_) {
      if (each.stretch.frames >= kFewestOfStretch) worst_ms = std::max(worst_ms, percentile_95(each.free_ms));
    }
    return worst_ms;
  }
  // A session that is gone through again has the same stretches.
  void add_to_stretch(const RateFrame& frame, double frame_ms, double free_ms) {
    auto found = std::find_if(stretches_.begin(), stretches_.end(),
                              [&](const Stretch& each) { return each.number == frame.stretch; });
    const double from_s = 1e-3 * period_ms_ * static_cast<double>(frame.frame),
                 to_s = from_s + 1e-3 * period_ms_;
    if (found == stretches_.end()) {
      stretches_.push_back({frame.stretch, {from_s, to_s, 0, 0}, {}, {}});
      found = stretches_.end() - 1;
    }
    RateStretch& stretch = found->stretch;
    stretch.from_s = std::min(stretch.from_s, from_s), stretch.to_s = std::max(stretch.to_s, to_s);
    ++stretch.frames;
    found->times_ms.push_back(frame_ms), found->free_ms.push_back(free_ms);
  }

  const double period_ms_;
  const TimeNs began_ns_;
  std::vector<double> times_ms_, free_ms_;
  std::vector<Stretch> stretches_;
  int late_ = 0, far_too_slow_ = 0, hopeless_ = 0;
  MeanOfSome k_radial_, k_angular_;
  RateTrial trial_;
};

// " SESSION --scene FILE ..." as both commands take it.
std::string inputs_text(const StudyOptions& options) {
  std::string text = " " + shell_path(options.session);
  if (!options.scene.empty()) text += " --scene " + shell_path(options.scene);
  for (const std::filesystem::path& root : options.asset_roots) text += " --asset-root " + shell_path(root);
  if (options.profile_given) text += " --profile " + shell_path(options.profile);
  return text;
}

}  // namespace

RateSetting most_of(const StudyOptions& options) {
  constexpr int kMostUsualLight = 256;
  RateSetting most;
  most.polar_width = options.render.polar_width;
  most.polar_height = options.render.polar_height;
  most.light_samples = options.light_given ? options.render.light_samples : kMostUsualLight;
  most.profile_scale = options.profile_scale;
  return most;
}

ReplayOptions replay_options_of(const StudyOptions& options, const RateSetting& setting) {
  ReplayOptions run;
  run.sessions = {options.session};
  run.scene = options.scene;
  run.asset_roots = options.asset_roots;
  if (options.profile_given) run.profile = options.profile;
  run.profile_scale = setting.profile_scale;
  run.render = options.render;
  run.render.polar_width = setting.polar_width;
  run.render.polar_height = setting.polar_height;
  run.render.light_samples = setting.light_samples;
  run.session = options.reading;
  run.clock = ReplayClock::realtime;
  run.target_ms = 1e3 / *options.hz;
  run.formats = {};
  run.sheet = SheetChoice::none;
  return run;
}

std::string study_line_of(const StudyOptions& options, const SettingChanges& changes) {
  std::string text = "herr study" + inputs_text(options) + " --hz " + shortest_text(*options.hz);
  if (options.profile_scale != 1) text += " --profile-scale " + shortest_text(options.profile_scale);
  const RenderSettings asked = with_changes(options.render, changes);
  const std::string flags = flags_text(changes_between(RenderSettings{}, asked));
  if (!flags.empty()) text += " " + flags;
  if (options.light_given && asked.light_samples == RenderSettings{}.light_samples)
    text += " --light-samples " + std::to_string(asked.light_samples);  // else more are tried
  return text + (options.reading.strict ? " --strict" : "");
}

std::string command_line_of(const StudyOptions& options, const RateSetting& setting) {
  const ReplayOptions run = replay_options_of(options, setting);
  std::string text = "herr replay" + inputs_text(options);
  text += " --profile-scale " + shortest_text(run.profile_scale) + " --polar " + polar_text(setting) +
          " --light-samples " + std::to_string(setting.light_samples);
  RenderSettings usual;  // what the line says already
  usual.polar_width = setting.polar_width, usual.polar_height = setting.polar_height;
  usual.light_samples = setting.light_samples;
  const std::string flags = flags_text(changes_between(usual, run.render));
  return text + (flags.empty() ? "" : " " + flags) + (run.session.strict ? " --strict" : "") +
         " --clock realtime --target-ms " + target_text(*run.target_ms) +
         " --format none --contact-sheet none";
}

RateSubject::RateSubject(const StudyOptions& options, const RateSetting& least)
    : options_(options), run_(replay_options_of(options, least)) {
  report_.session_folder = options.session;
  report_.name = session_folder_name(options.session);
  open_session(run_, report_, opened_);
  profile_ = run_.profile.empty() ? report_.header.profile : load_display_profile(run_.profile);
  frames_ = rate_frames(report_.range);
  step_.emplace(run_, report_, opened_);
  set_up_ = least;
}

void RateSubject::set_up(const RateSetting& setting) {
  step_->rewind();  // a renderer is built on the scene as it was loaded
  if (set_up_ == setting) return;
  run_ = replay_options_of(options_, setting);
  report_.profile = scaled_profile(profile_, setting.profile_scale);
  build_renderer(run_.render, report_, opened_);
  report_.settings = opened_.renderer->settings();
  set_up_ = setting;
  step_->rewind();
}

std::optional<RateTrial> RateSubject::measure(const RateSetting& setting, bool to_the_end) {
  set_up(setting);
  TrialFrames frames(period_ms());
  const int cores = std::max(1, std::min(report_.settings.threads, report_.load.cores));
  const std::optional<CpuTicks> before = read_cpu_ticks();
  CountedFrames counted(period_ms());
  for (bool complete = false;;) {
    for (const RateFrame& each : frames_) {
      if (stop_signal() != 0) return std::nullopt;
      const TimeNs start_ns = steady_now_ns();
      step_->prepare(each.frame);
      step_->render(rendered_);
      const double frame_ms = static_cast<double>(step_->finished_ns() - start_ns) * 1e-6;
      if (counted.counts(each, frame_ms)) frames.add(each, step_->record(), frame_ms, cores);
      complete = frames.complete(to_the_end);
      if (complete) break;
    }
    if (complete) break;
    step_->rewind();
  }
  const std::optional<CpuTicks> after = read_cpu_ticks();
  if (before && after) {
    frames.machine().used_ticks = after->used - before->used;
    frames.machine().stolen_ticks = after->stolen - before->stolen;
  }
  return frames.result();
}

}  // namespace herr
