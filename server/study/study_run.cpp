#include "server/study/study_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/process/stop_signal.h"
#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "server/study/clip_flicker.h"
#include "server/study/findings/study_timing.h"
#include "server/study/measure/measure_setting.h"
#include "server/study/plan/combinations.h"
#include "server/study/plan/study_budget.h"
#include "server/study/reference/reference_spec.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"

namespace herr {
namespace {

constexpr std::int64_t kLongestCsv = std::int64_t{1} << 30;
constexpr double kLongestClipFrame_ms = 1500;
constexpr int kMostCombinations = 40;

// Thrown through the loops when a signal asks for the end.
struct Stopped {};

void stop_if_asked() {
  if (stop_signal() != 0) throw Stopped{};
}

std::string only_text(const StudyOptions& options) {
  std::string text;
  for (const std::string& name : options.only) text += (text.empty() ? "; only " : ",") + name;
  return text;
}

// How a reference came: only rendering it took time of this study.
const char* kind_of(const ReferencePicture& reference) {
  return !reference.spec.by_pixels ? "seeds" : reference.found ? "found" : "pixels";
}

std::string subject_of(const StudySubject& subject, const StudyOptions& options) {
  const bool camera = subject.report().findings.camera_rows[0] > 0;
  return std::string(program_with_version()) + "; " + subject.inputs() +
         settings_text(subject.defaults(), camera) + "; " + std::to_string(options.frames) + " frames" +
         only_text(options);
}

// One of many seeds, which the first setting of its sweep makes.
bool has_made(const References& references, const std::string& name) {
  return std::any_of(references.made().begin(), references.made().end(),
                     [&](const ReferencePicture& made) { return made.spec.name == name; });
}

double seconds_since(TimeNs start_ns) {
  return static_cast<double>(steady_now_ns() - start_ns) * 1e-9;
}

}  // namespace

StudyRun::StudyRun(const StudyOptions& options, StudySubject& subject, StudySweeps sweeps,
                   const StudyFolder& folder, TimeNs started_ns)
    : options_(options),
      subject_(subject),
      folder_(folder),
      sweeps_(std::move(sweeps)),
      cache_(options.references.empty() ? folder.references() : options.references),
      progress_(60 * options.minutes),
      start_ns_(started_ns),
      last_row_ns_(steady_now_ns()),
      reference_start_ns_(last_row_ns_) {
  state_.subject = subject_of(subject, options);
  if (options.resume && path_exists(folder.state())) {
    StudyState earlier = read_state(folder.state());
    if (earlier.subject != state_.subject) {
      throw InputError(folder.state(), 0, "is of another session, scene, setting or program",
                       "give the same command, or begin anew with --overwrite");
    }
    if (earlier.frames > subject.frames().frames.size()) {
      throw InputError(folder.state(), 0, "names more frames than the study has",
                       "begin anew with --overwrite");
    }
    state_ = std::move(earlier);
  }
  read_rows();
}

// Whole rows stay as they are; a last one that was cut off is measured again.
void StudyRun::read_rows() {
  std::int64_t kept = 0;
  if (options_.resume && path_exists(folder_.csv())) {
    const std::string text = read_whole_file(folder_.csv(), {kLongestCsv, "begin anew with --overwrite"});
    const std::string header = study_csv_header();
    if (!text.empty() && !text.starts_with(header) && !header.starts_with(text)) {
      throw InputError(folder_.csv(), 1, "has other columns", "begin anew with --overwrite");
    }
    std::size_t at = text.starts_with(header) ? header.size() : 0;
    for (std::int64_t line = 2; at > 0; ++line) {
      const std::size_t end = text.find('\n', at);
      if (end == std::string::npos) break;
      const std::optional<StudyRow> row = study_row_of(std::string_view(text).substr(at, end - at));
      if (!row) throw InputError(folder_.csv(), line, "is no row of a study", "begin anew with --overwrite");
      rows_.push_back(*row);
      earlier_s_ += row->seconds;
      at = end + 1;
    }
    kept = static_cast<std::int64_t>(at);
  }
  earlier_s_ += pixel_references_s();
  csv_.emplace(folder_.csv(), kept);
  if (kept == 0) csv_->append(study_csv_header());
  csv_->sync();
}

double StudyRun::seconds() const {
  return earlier_s_ + seconds_since(start_ns_);
}

References::Context StudyRun::reference_context(std::optional<std::int64_t> frame) {
  References::Context context;
  context.subject = subject_.inputs();
  context.cache = &cache_;
  context.out_of_time = [this] {
    return stop_signal() != 0 || pixel_references_s() + seconds_since(reference_start_ns_) > references_s_;
  };
  context.one_pass = [this](double so_far_s, double pass_s) {
    return references_are_coarse(so_far_s + pass_s);
  };
  context.stopped = [] { return stop_signal() != 0; };
  context.is_known = [this, frame](const std::string& name) { return frame && is_noted(name, *frame); };
  context.warn = [this](const std::string& what) { warnings_.push_back(what); };
  context.tell = [this](const std::string& what) {
    reference_start_ns_ = steady_now_ns();
    progress_.tell(what, seconds());
  };
  return context;
}

// That references over pixels took, those of families of light beside the two that come first included.
double StudyRun::pixel_references_s() const {
  double sum = 0;
  for (const auto& [frame, reference] : state_.references) {
    if (reference.settings == "pixels") sum += reference.seconds;
  }
  return sum;
}

bool StudyRun::is_noted(const std::string& name, std::int64_t frame) const {
  return std::any_of(state_.references.begin(), state_.references.end(),
                     [&](const auto& one) { return one.first == frame && one.second.name == name; });
}

void StudyRun::note(const References& references, std::int64_t frame) {
  bool changed = false;
  for (const ReferencePicture& made : references.made()) {
    if (is_noted(made.spec.name, frame)) continue;
    state_.references.emplace_back(
        frame, StudyReference{made.spec.name, kind_of(made), made.passes, made.most_passes, made.error,
                              made.goal_met, made.seconds});
    changed = true;
  }
  if (changed) write_state(folder_.state(), state_);
}

bool StudyRun::measure() {
  try {
    make_references();
    share_time();
    progress_.expect(state_.settings->size() * state_.frames);
    measure_settings(wanted_settings(), state_.frames, until_clip_s());
    measure_left_over(until_clip_s());
    choose_combinations();
    progress_.expect(state_.combinations->size() * state_.frames);
    measure_settings(*state_.combinations, state_.frames, until_clip_s());
    measure_flicker();
    measure_left_over(limit_s() - kReportSeconds);
  } catch (const Stopped&) {
    return false;
  }
  return true;
}

// Endless effort and hard light at every frame; each has its share of half the time.
void StudyRun::make_references() {
  StudySetting hard;
  hard.own = OwnReference::pixels;
  hard.changes = {{"light_samples", std::to_string(kHardSamples)}};
  const std::vector<ReferenceSpec> specs{endless_effort(subject_.defaults(), {}),
                                         own_reference(subject_.defaults(), hard)};
  const auto all = static_cast<double>(specs.size() * subject_.frames().frames.size());
  double done = 0;
  subject_.rewind();
  for (const StudyFrame& frame : subject_.frames().frames) {
    const auto is_known = [&](const ReferenceSpec& spec) { return is_noted(spec.name, frame.number); };
    if (!shares_anew() && referenced_frames_ == state_.frames) break;
    if (std::all_of(specs.begin(), specs.end(), is_known)) {
      done += static_cast<double>(specs.size());
      ++referenced_frames_;
      continue;
    }
    if (!has_time_for_references(referenced_frames_)) break;
    const FrameInstant instant = subject_.instant(frame.number);
    const std::unique_ptr<Renderer> threads = renderer_at(instant, subject_.defaults());
    References::Context context = reference_context(frame.number);
    context.parallel_for = threads_of(*threads);
    References references(instant, context);
    for (const ReferenceSpec& spec : specs) {
      stop_if_asked();
      references_s_ = kShareOfReferences * limit_s() * ++done / all;
      references.get(spec, !is_known(spec));
      stop_if_asked();  // one that was cut short is not noted
      note(references, frame.number);
    }
    ++referenced_frames_;
  }
  references_s_ = kShareOfReferences * limit_s();
  last_row_ns_ = steady_now_ns();
}

// Three blocks over all frames: six pairs, the fewest that have an interval.
MeasuringRules StudyRun::measuring_rules() const {
  MeasuringRules rules;
  const auto frames = static_cast<int>(shares_anew() ? referenced_frames_ : state_.frames);
  rules.timing.fewest_blocks = (3 + frames - 1) / std::max(1, frames);
  rules.timing.blocks = std::max(rules.timing.blocks, rules.timing.fewest_blocks);
  return rules;
}

bool StudyRun::is_measured(const std::string& name, std::int64_t frame) const {
  return row_of(name, frame) != nullptr;
}

const StudyRow* StudyRun::row_of(const std::string& name, std::int64_t frame) const {
  for (const StudyRow& row : rows_) {
    if (row.name == name && row.frame == frame && row.error) return &row;
  }
  return nullptr;
}

std::vector<StudySetting> StudyRun::wanted_settings() const {
  std::vector<StudySetting> wanted;
  for (const std::string& name : *state_.settings) {
    const auto found = std::find_if(sweeps_.settings.begin(), sweeps_.settings.end(),
                                    [&](const StudySetting& setting) { return setting.name == name; });
    if (found != sweeps_.settings.end()) wanted.push_back(*found);
  }
  return wanted;
}

void StudyRun::keep(StudyRow row) {
  row.seconds = seconds_since(last_row_ns_);
  last_row_ns_ = steady_now_ns();
  csv_->append(study_csv_row(row));
  csv_->sync();
  rows_.push_back(std::move(row));
}

void StudyRun::measure_settings(const std::vector<StudySetting>& settings, std::size_t frames,
                                double until_s) {
  subject_.rewind();
  for (std::size_t f = 0; f < frames; ++f) {
    measure_frame(settings, subject_.frames().frames[f].number, until_s);
  }
}

void StudyRun::measure_frame(const std::vector<StudySetting>& settings, std::int64_t frame, double until_s) {
  const auto missing = [&](const StudySetting& setting) { return !is_measured(setting.name, frame); };
  for (const StudySetting& setting : settings) {
    if (!missing(setting)) progress_.count();
  }
  if (std::none_of(settings.begin(), settings.end(), missing)) return;
  const FrameInstant instant = subject_.instant(frame);
  const std::unique_ptr<Renderer> unit = renderer_at(instant, subject_.defaults());
  Calibration calibration(*unit);
  References::Context context = reference_context(frame);
  context.parallel_for = threads_of(*unit);
  References references(instant, context);
  const MeasuringBench bench{subject_.defaults(), instant, *unit, calibration, references, measuring_rules()};
  for (const StudySetting& setting : settings) {
    if (!missing(setting)) continue;
    stop_if_asked();
    const bool waits = setting.own == OwnReference::seeds &&
                       !has_made(references, own_reference(subject_.defaults(), setting).name);
    const double reference_s = waits ? reference_seconds(setting) : 0;
    if (seconds() + expected_seconds(setting) + reference_s > until_s) {
      if (setting.knob == "combination")
        out_of_time_.push_back(setting.name + ", frame " + std::to_string(frame));
      continue;
    }
    progress_.tell(setting.name + ", frame " + std::to_string(frame), seconds());
    StudyRow row = measure_setting(setting, bench);
    stop_if_asked();
    note(references, frame);
    keep(std::move(row));
    progress_.count();
  }
}

double StudyRun::seconds_of_rows() const {
  double sum = 0;
  for (const StudyRow& row : rows_) sum += row.seconds;
  return sum;
}

// By the means over frames of what each knob did alone.
void StudyRun::choose_combinations() {
  if (state_.combinations) return;
  struct Mean {
    double log_time = 0, squared = 0;
    int frames = 0;
  };
  const auto mean_of = [&](const std::string& name) {
    Mean mean;
    for (const StudyRow& row : rows_) {
      if (row.name != name || !row.error || row.log_ratios.empty()) continue;
      for (const double ratio : row.log_ratios)
        mean.log_time += is_the_default(row) ? 0 : ratio / static_cast<double>(row.log_ratios.size());
      mean.squared += std::pow(row.error->at(Metric::acuity_rmse), 2);
      ++mean.frames;
    }
    return mean;
  };
  std::vector<MeasuredSetting> measured;
  for (const StudySetting& setting : wanted_settings()) {
    const Mean own = mean_of(setting.name);
    if (own.frames == 0 || !setting.model.empty()) continue;
    measured.push_back({setting, own.log_time / own.frames, std::sqrt(own.squared / own.frames)});
  }
  // What was shared out is an estimate; what rows really took tells how many more the time is enough for.
  const auto rows = static_cast<double>(std::max<std::size_t>(1, measured.size()));
  const double row_s = seconds_of_rows() / (rows * static_cast<double>(state_.frames));
  const double affordable = (until_clip_s() - seconds()) / (row_s * static_cast<double>(state_.frames));
  const auto most = static_cast<std::size_t>(std::clamp(affordable, 0.0, double{kMostCombinations}));
  state_.combinations = combinations(subject_.defaults(), measured, most);
  std::erase(state_.dropped, "combinations");
  if (most == 0) state_.dropped.emplace_back("combinations");
  write_state(folder_.state(), state_);
}

void StudyRun::measure_flicker() {
  std::vector<StudySetting> shown;
  const auto has_flicker = [&](const StudySetting& setting) {
    return std::any_of(rows_.begin(), rows_.end(),
                       [&](const StudyRow& row) { return row.name == setting.name && row.flicker; });
  };
  double frames_s = 0;
  const std::int64_t frame = subject_.frames().frames.front().number;
  for (const StudySetting& setting : wanted_settings()) {
    const bool wanted = setting.knob == "default" || setting.knob == "paper" || setting.knob == "filter" ||
                        setting.name == "adaptive light samples 64" || setting.name == "light samples 4" ||
                        (setting.knob == "uniform" && setting.value == "0.5");
    const StudyRow* row = row_of(setting.name, frame);
    if (!wanted || row == nullptr || has_flicker(setting)) continue;
    if (row->frame_ms > kLongestClipFrame_ms) {
      out_of_time_.push_back("flicker of " + setting.name + ": its frames take too long");
      continue;
    }
    shown.push_back(setting);
    frames_s += 1e-3 * row->frame_ms * static_cast<double>(subject_.frames().clip.size());
  }
  if (shown.empty() || subject_.frames().clip.size() < 2) return;
  if (seconds() + clip_seconds() + frames_s > limit_s() - kReportSeconds) {
    out_of_time_.emplace_back("flicker over the clip");
    return;
  }
  References::Context context = reference_context();
  context.parallel_for = [](int count, const std::function<void(int)>& work) {
    for (int i = 0; i < count; ++i) work(i);
  };
  std::vector<StudyRow> rows = measure_clip(subject_, shown, context, kClipPasses, [&](std::size_t at) {
    progress_.tell("clip, frame " + std::to_string(at + 1) + " of " + std::to_string(kClipFrames), seconds());
    return stop_signal() == 0;
  });
  stop_if_asked();
  for (StudyRow& row : rows) keep(std::move(row));
}

}  // namespace herr
