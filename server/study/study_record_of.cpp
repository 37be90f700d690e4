#include "server/study/study_record_of.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "server/results/settings_report.h"
#include "server/study/findings/default_points.h"
#include "server/study/findings/study_advice.h"
#include "server/study/findings/study_fits.h"
#include "server/study/findings/study_points.h"
#include "server/study/findings/study_timing.h"
#include "server/study/reference/reference_spec.h"
#include "server/study/report/difference_picture.h"
#include "server/study/study_head.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr double kPictureGain = 8;
constexpr int kPanelPx = 300;
constexpr std::size_t kMostPictured = 6;

// One of each name, over its frames; the first is the picture of endless effort.
std::vector<StudyReference> references_of(const StudyState& state, const StudySubject& subject) {
  std::vector<StudyReference> all;
  std::vector<std::vector<ErrorTable>> errors;
  const auto is_frame = [&](std::int64_t number) {
    const auto& frames = subject.frames().frames;
    return std::any_of(frames.begin(), frames.end(), [&](const StudyFrame& f) { return f.number == number; });
  };
  for (const auto& [frame, reference] : state.references) {
    if (!is_frame(frame)) continue;
    const auto same = [&, &name = reference.name](const StudyReference& one) { return one.name == name; };
    const auto found = std::find_if(all.begin(), all.end(), same);
    if (found == all.end()) {
      all.push_back(reference);
      errors.push_back({reference.error});
      continue;
    }
    found->passes = std::min(found->passes, reference.passes);
    found->most_passes = std::max(found->most_passes, reference.most_passes);
    found->goal_met = found->goal_met && reference.goal_met;
    found->seconds += reference.seconds;
    errors[static_cast<std::size_t>(found - all.begin())].push_back(reference.error);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].error = over_frames(errors[i]);
    all[i].settings =
        all[i].settings == "seeds" ? "frames of many seeds" : "rays through many places of each pixel";
  }
  return all;
}

bool is_pictured(const StudySetting& setting) {
  return setting.knob == "default" || setting.name == "adaptive light samples 64" ||
         (setting.knob == "filter" && setting.value == "nearest" && setting.base == "N = 64") ||
         (setting.knob == "uniform" && setting.value == "0.25" && setting.base == "N = 64") ||
         (setting.knob == "polar" && setting.n < 400 && setting.n > 300 && setting.base == "N = 64");
}

std::vector<StudyPicture> pictures_of(StudySubject& subject, StudyRun& run, double limit_s) {
  std::vector<StudyPicture> pictures;
  subject.rewind();
  const FrameInstant instant = subject.instant(subject.frames().frames.front().number);
  const std::unique_ptr<Renderer> unit = renderer_at(instant, subject.defaults());
  References::Context context = run.reference_context();
  context.parallel_for = threads_of(*unit);
  context.tell = {};
  References references(instant, context);
  const ReferencePicture& truth = references.get(endless_effort(subject.defaults(), {}));
  const auto& names = *run.state().settings;
  for (const StudySetting& setting : run.sweeps().settings) {
    if (!is_pictured(setting) || pictures.size() >= 2 * kMostPictured) continue;
    // Not without a picture, but no longer than asked for.
    if (!pictures.empty() && run.seconds() > limit_s) break;
    if (std::find(names.begin(), names.end(), setting.name) == names.end()) continue;
    const auto renderer = renderer_at(instant, with_changes(subject.defaults(), setting.changes));
    RenderedFrame frame;
    renderer->render_frame(*instant.sample, *instant.state, frame);
    std::vector<LinearPicture> test;
    read_viewports(frame, instant, threads_of(*renderer), test);
    for (std::size_t v = 0; v < test.size() && v < instant.profile->viewports.size(); ++v) {
      const Viewport& viewport = instant.profile->viewports[v];
      if (viewport.eye != instant.profile->viewports.front().eye) continue;
      limit_to_white(test[v]);
      pictures.push_back(difference_picture(setting.name + ", " + viewport.name, test[v], truth.picture[v],
                                            kPictureGain, kPanelPx));
      const std::vector<std::uint8_t>& band = instant.maps[v].band;
      if (std::find(band.begin(), band.end(), kNotSeen) != band.end()) {
        pictures.back().caption += " Black: a focus viewport covers it; no error counts there.";
      }
    }
  }
  return pictures;
}

void add_reference_warnings(StudyRecord& record) {
  for (const StudyReference& reference : record.references) {
    if (reference.goal_met) continue;
    record.warnings.push_back(
        "the reference '" + reference.name +
        "' was left with an error that may be larger than a fifth of the smallest that is judged by it: its "
        "share of the time was spent (give more --minutes), or 512 passes a half did not do, or probes of "
        "two "
        "seeds differ, which no pass mends");
  }
}

// Foveation saves where the eye does not look; where the gaze meets nothing it has nothing to lose either.
void add_gaze_warning(StudyRecord& record) {
  constexpr double kShareAtGaze = 0.1;
  for (const StudyPoint& point : record.points) {
    if (point.name != default_name(kSoftSamples) || !point.comparable) continue;
    const double at_gaze = point.error.at(Metric::rmse, 0), all = point.error.at(Metric::rmse);
    if (!(at_gaze < kShareAtGaze * all)) continue;
    record.warnings.push_back(
        "the gaze meets nothing with detail in these frames: within 5 degrees of it the error is " +
        error_text(at_gaze) + ", over all pixels " + error_text(all) +
        "; what foveation is for does not show here");
  }
}

// What is measured whatever it takes may be more than the time allowed.
void add_time_warning(StudyRecord& record) {
  constexpr double kMuch = 1.2;
  if (record.minutes_taken <= kMuch * record.minutes_allowed) return;
  record.warnings.push_back("the study took " + fixed_text(record.minutes_taken, 1) +
                            " minutes in place of " + fixed_text(record.minutes_allowed, 1) +
                            ": the references of one frame and the default alone take so long here");
}

}  // namespace

StudyRecord record_of(const StudyOptions& options, StudySubject& subject, StudyRun& run) {
  const SessionReport& report = subject.report();
  StudyRecord record;
  static_cast<ReportHead&>(record) = report_head_of(options, report);
  record.minutes_allowed = options.minutes;
  record.default_settings = settings_text(subject.defaults(), report.findings.camera_rows[0] > 0);
  const StudyFrames& frames = subject.frames();
  record.frames.assign(frames.frames.begin(),
                       frames.frames.begin() + static_cast<std::ptrdiff_t>(run.state().frames));
  record.clip = frames.clip;
  record.references = references_of(run.state(), subject);
  record.points = points_of(run.rows(), record.references);
  add_points_of_default(run.sweeps().of_default, record.points);
  StudyFits fits = fit_knobs(run.sweeps().knobs, record.points, record.references);
  record.fits = std::move(fits.fits);
  record.remarks = std::move(fits.remarks);
  record.no_advice = run.no_advice();
  if (record.no_advice.empty()) {
    record.advice = advice_of(record.points, record.references);
    record.advice_note = advice_note(options.profile_scale);
    record.aims = aims_of(record.points);
  }
  record.left_out = run.sweeps().left_out;
  record.dropped = run.dropped();
  if (record.aims.empty()) {
    record.dropped.emplace_back(
        "aims: rays per pixel and the paper's settings were not measured on all frames");
  }
  record.timing = timing_of(run.rows());
  record.warnings = report.warnings;
  record.warnings.insert(record.warnings.end(), run.warnings().begin(), run.warnings().end());
  add_reference_warnings(record);
  add_gaze_warning(record);
  record.pictures = pictures_of(subject, run, 60 * options.minutes);
  record.minutes_taken = run.seconds() / 60;
  add_time_warning(record);
  return record;
}

}  // namespace herr
