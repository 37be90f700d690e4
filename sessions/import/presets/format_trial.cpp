#include "sessions/import/presets/format_trial.h"

#include <algorithm>

#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

constexpr double kLevel = 0.7, kNotLevel = 0.4;  // share of rows in which the head is upright
// The head's up is steadier under the true axes than its sides: by so much it is told from chance.
constexpr double kSteadierTimes = 1.5, kSteadierByDeg = 1;
constexpr double kEvidence = 4;                    // standard deviations between two readings
constexpr double kConverge = 0.2, kDiverge = 0.8;  // share of rows in which the eyes diverge
constexpr double kMostLost = 0.5;                  // share of rows; and the highest rate of any recording:
constexpr double kHighestHz = 20000;

std::string percent(double share) {
  return fixed_text(100 * share, 0) + " %";
}

std::string level_because(const PlausibilityFigures& a, const PlausibilityFigures& b) {
  if (!a.level_share || !b.level_share) return {};
  if (*a.level_share >= kLevel && *b.level_share <= kNotLevel)
    return "the head is upright in " + percent(*a.level_share) + " of the rows, not in " +
           percent(*b.level_share);
  if (*a.level_share >= kLevel && a.head_turns &&
      b.up_spread_deg > kSteadierTimes * a.up_spread_deg + kSteadierByDeg)
    return "the head's up wavers by " + fixed_text(a.up_spread_deg, 1) + " degrees, not by " +
           fixed_text(b.up_spread_deg, 1);
  return {};
}

// Eyes that diverge in nearly every row cannot be; what they do under head motion is a matter of chance.
std::string eyes_because(const PlausibilityFigures& a, const PlausibilityFigures& b) {
  const auto converges = [](const PlausibilityFigures& one, const PlausibilityFigures& other) {
    return one.diverging_share && other.diverging_share && *one.diverging_share <= kConverge &&
           *other.diverging_share >= kDiverge;
  };
  if (converges(a, b))
    return "the eyes diverge in " + percent(*a.diverging_share) + " of the rows, not in " +
           percent(*b.diverging_share);
  if (converges(b, a)) return {};
  const double more = a.evidence_x + a.evidence_y - b.evidence_x - b.evidence_y;
  if (more <= kEvidence) return {};
  return "the eyes counter the head's turns, by " + fixed_text(more, 1) + " standard deviations more";
}

// What no recording is.
std::optional<InputError> unlikely(const ImportReport& report) {
  for (const ImportedStream* stream : {&report.poses, &report.gaze}) {
    if (stream->lost_share() > kMostLost)
      return InputError(stream->file, 0, "most rows are lost", "check the unit of time and the columns");
    if (stream->rate_hz() > kHighestHz)
      return InputError(stream->file, 0,
                        "stamps are " + fixed_text(stream->intervals.median_ns(), 0) + " ns apart",
                        "check the unit of time");
  }
  return std::nullopt;
}

}  // namespace

FormatTrial try_format(const RecordingFiles& files, const FormatCandidate& candidate,
                       std::int64_t most_rows) {
  FormatTrial trial{candidate, {}, std::nullopt};
  ImportRequest request = request_of(files, candidate);
  request.keep_going = true;
  request.most_rows = most_rows;
  const bool per_eye = candidate.columns.gaze != nullptr && candidate.columns.gaze->rays.size() == 2;
  PlausibilityMeter meter;
  try {
    const ImportReport report = import_rows(request, {[&](const PoseRow& row) { meter.add(row); },
                                                      [&](const GazeRow& row) { meter.add(row, per_eye); }});
    trial.error = unlikely(report);
  } catch (const InputError& error) {
    trial.error = error;
    return trial;
  }
  meter.finish();
  trial.figures = meter.figures();
  return trial;
}

std::string better_because(const FormatTrial& a, const FormatTrial& b) {
  if (a.error) return {};
  if (b.error) return b.error->problem();
  const std::string level = level_because(a.figures, b.figures);
  if (!level.empty() || !level_because(b.figures, a.figures).empty()) return level;
  return eyes_because(a.figures, b.figures);
}

const FormatTrial* best_of(const std::vector<FormatTrial>& trials) {
  if (std::all_of(trials.begin(), trials.end(),
                  [](const FormatTrial& trial) { return trial.error.has_value(); }))
    throw *trials.front().error;
  for (const FormatTrial& one : trials)
    if (std::all_of(trials.begin(), trials.end(), [&](const FormatTrial& other) {
          return &other == &one || !better_because(one, other).empty();
        }))
      return one.error ? nullptr : &one;
  return nullptr;
}

}  // namespace herr
