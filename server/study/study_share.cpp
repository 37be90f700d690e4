// How the time of a study is shared out among frames and settings, and what becomes of what is left over.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "server/process/terminal.h"
#include "server/study/plan/reference_forecast.h"
#include "server/study/plan/short_plan.h"
#include "server/study/plan/study_budget.h"
#include "server/study/plan/time_advice.h"
#include "server/study/study_run.h"
#include "server/text/number_text.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr double kOverdrawn = 1.25;       // of its share: what a last pass may take more
constexpr double kMostShareOfSoft = 0.1;  // of what is left, for its default before its turn

}  // namespace

// More minutes than were shared out are shared out anew.
bool StudyRun::shares_anew() const {
  return !state_.settings || options_.minutes > state_.minutes;
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

// The default with hard light, whatever it takes; with soft light, by which times are foretold better, where
// it takes little: else it waits for its turn.
void StudyRun::measure_bases() {
  const std::int64_t first = subject_.frames().frames.front().number;
  for (const int samples : {kHardSamples, kSoftSamples}) {
    std::vector<StudySetting> base;
    for (const StudySetting& setting : sweeps_.settings) {
      if (setting.name == default_name(samples)) base.push_back(setting);
    }
    subject_.rewind();
    const double soft_s = kMostShareOfSoft * (until_clip_s() - seconds());
    measure_frame(base, first, samples == kHardSamples ? HUGE_VAL : seconds() + soft_s);
  }
}

// Where not even what a study of all sweeps never drops fits: as of sweeps that were asked for.
StudyBudget StudyRun::plan_of(double seconds) {
  if (options_.only.empty()) {
    std::vector<double> of_each;
    for (const StudySetting& setting : sweeps_.settings)
      of_each.push_back(share_of_frames(setting) * estimated_seconds(setting));
    StudyBudget budget = fit_to_time(sweeps_.settings, of_each, referenced_frames_, seconds);
    if (budget.fits) return budget;
    sweeps_.settings = ends_first(sweeps_.settings, sweeps_.of_default);
  }
  return fit_in_order(sweeps_.settings, costs(sweeps_.settings), referenced_frames_, seconds);
}

void StudyRun::share_time() {
  if (!shares_anew()) return;
  measure_bases();
  const std::size_t all = subject_.frames().frames.size();
  const StudyBudget budget = plan_of(std::max(0.0, until_clip_s() - seconds()));
  // Points of fewer frames than an earlier plan's would not compare with those that it measured.
  state_.frames = std::max(budget.frames, state_.settings ? state_.frames : 1);
  state_.settings.emplace();
  for (const StudySetting& setting : budget.settings) state_.settings->push_back(setting.name);
  state_.minutes = options_.minutes;
  state_.combinations.reset();
  state_.dropped.clear();
  if (std::find(budget.dropped.begin(), budget.dropped.end(), "combinations") != budget.dropped.end())
    state_.dropped.emplace_back("combinations");
  if (state_.frames < referenced_frames_)
    state_.dropped.push_back(left_out_frames(state_.frames, referenced_frames_));
  if (referenced_frames_ < all) {
    state_.dropped.push_back(left_out_frames(referenced_frames_, all) +
                             ": their references would have taken more than half of the time");
  }
  write_state(folder_.state(), state_);
  tell_plan();
}

void StudyRun::tell_plan() {
  const std::size_t planned = state_.settings->size(), all = sweeps_.settings.size();
  print_message("plan: " + std::to_string(planned) + " of " + std::to_string(all) + " settings on " +
                std::to_string(state_.frames) + " of " +
                counted(static_cast<std::int64_t>(subject_.frames().frames.size()), "frame", "frames") +
                " are expected to fit into --minutes " + shortest_text(options_.minutes));
  TimeShortage shortage;
  shortage.planned = planned, shortage.settings = all;
  shortage.minutes = options_.minutes, shortage.minutes_needed = minutes_for_advice();
  shortage.only = options_.only.size();
  shortage.references_s = pixel_references_s();
  if (options_.references.empty() && shortage.references_s > 0)
    shortage.references = folder_.references().string();
  shortage.profile_scale = options_.profile_scale;
  const std::string what = too_few_settings(shortage);
  if (!what.empty()) print_message("warning: " + what);
}

// What the plan had no time for, in its turn, as long as it still fits: estimates are off, most of all those
// of frames with soft light. Frames stay as many as they are, so that points compare.
void StudyRun::measure_left_over(double until_s) {
  for (;;) {
    std::vector<StudySetting> left;
    for (const StudySetting& setting : ends_first(sweeps_.settings, sweeps_.of_default)) {
      if (!is_measured_everywhere(setting)) left.push_back(setting);
    }
    const double seconds_of_each = (until_s - seconds()) / static_cast<double>(state_.frames);
    left = fit_in_order(left, costs(left), 1, std::max(0.0, seconds_of_each)).settings;
    const std::size_t rows = rows_.size();
    for (const StudySetting& setting : left) {
      std::vector<std::string>& names = *state_.settings;
      if (std::find(names.begin(), names.end(), setting.name) == names.end()) names.push_back(setting.name);
    }
    write_state(folder_.state(), state_);
    progress_.expect(left.size() * state_.frames);
    measure_settings(left, state_.frames, until_s);
    if (rows_.size() == rows) return;
  }
}

bool StudyRun::is_measured_everywhere(const StudySetting& setting) const {
  const auto& frames = subject_.frames().frames;
  return std::all_of(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(state_.frames),
                     [&](const StudyFrame& frame) { return is_measured(setting.name, frame.number); });
}

// So long that the settings whose turn comes first are measured on one frame.
double StudyRun::minutes_for_advice() const {
  const std::vector<StudySetting> order = ends_first(sweeps_.settings, sweeps_.of_default);
  const auto count =
      static_cast<std::size_t>(std::ceil(kLeastShareForAdvice * static_cast<double>(order.size())));
  const double references_s =
      pixel_references_s() / static_cast<double>(std::max<std::size_t>(1, referenced_frames_));
  return minutes_for(options_.minutes, references_s, seconds_of_rows(), seconds_of_first(costs(order), count),
                     referenced_frames_ == subject_.frames().frames.size());
}

std::string StudyRun::no_advice() const {
  const auto& settings = sweeps_.settings;
  const auto measured = std::count_if(settings.begin(), settings.end(), [&](const StudySetting& setting) {
    return is_measured_everywhere(setting);
  });
  if (static_cast<double>(measured) >= kLeastShareForAdvice * static_cast<double>(settings.size())) return {};
  return std::to_string(measured) + " of " + std::to_string(settings.size()) +
         " settings measured: no recommendation; give --minutes " + fixed_text(minutes_for_advice(), 0) +
         " or more (--resume keeps what is measured)";
}

std::vector<std::string> StudyRun::dropped() const {
  std::vector<std::string> all = left_out_settings(
      sweeps_.settings, [&](const StudySetting& setting) { return is_measured_everywhere(setting); });
  all.insert(all.end(), state_.dropped.begin(), state_.dropped.end());
  all.insert(all.end(), out_of_time_.begin(), out_of_time_.end());
  return all;
}

}  // namespace herr
