#include "sessions/import/check/axis_trials.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sessions/import/check/axis_candidates.h"
#include "sessions/import/check/gaze_trials.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

using Candidates = std::vector<AxisCandidate>;

constexpr double kLevelRows = 0.8;  // people seldom lie on their side
constexpr double kSteadyTimes = 1.5, kSteadyByDeg = 1;
constexpr double kAhead = 0.7, kBackwards = 0.3;  // of the way
constexpr double kAboveFloorM = 0.4, kTallestHeadM = 3;
constexpr double kLyingDeg = 10;                        // no head leans so far for half of the time
constexpr double kLeaningDeg = 8, kLeaningTimes = 0.5;  // roll of a head that leans all the time

std::string share_text(double share) {
  return fixed_text(100 * share, 0) + " %";
}

void exclude_alone(AxisCandidate& one) {
  one.against = implausible(one.trial);
  const auto& level = one.figures().level_share;
  if (one.against.empty() && level && *level < kLevelRows)
    one.against = "the head is not level in " + share_text(1 - *level) + " of the rows";
}

template <typename Excludes>
void exclude(Candidates& candidates, const Excludes& against) {
  for (AxisCandidate& one : candidates)
    if (one.against.empty()) one.against = against(one);
}

// The head turns about the true up more than about anything else.
void exclude_wavering(Candidates& candidates) {
  double least = 1e9;
  for (const AxisCandidate& one : candidates)
    if (one.against.empty() && one.figures().head_turns) least = std::min(least, one.figures().up_spread_deg);
  exclude(candidates, [&](const AxisCandidate& one) -> std::string {
    if (one.figures().up_spread_deg <= kSteadyTimes * least + kSteadyByDeg) return "";
    return "the head's up wavers by " + fixed_text(one.figures().up_spread_deg, 0) + " degrees instead of " +
           fixed_text(least, 0);
  });
}

// People walk where they look.
bool exclude_by_walking(Candidates& candidates) {
  const bool known = std::any_of(candidates.begin(), candidates.end(), [](const AxisCandidate& one) {
    return one.against.empty() && one.figures().forwards_share.value_or(0) >= kAhead;
  });
  exclude(candidates, [&](const AxisCandidate& one) -> std::string {
    const auto& ahead = one.figures().forwards_share;
    if (ahead && *ahead < kBackwards)
      return "the head walks backwards over " + share_text(1 - *ahead) + " of the way";
    if (known && ahead.value_or(0) < kAhead) return "the head walks sideways";
    return "";
  });
  return known;
}

// Worlds begin on the floor or where the head began: heads are above or near it.
void exclude_below_floor(Candidates& candidates) {
  const bool above = std::any_of(candidates.begin(), candidates.end(), [](const AxisCandidate& one) {
    return one.against.empty() && one.trial.mean_height_m > kAboveFloorM &&
           one.trial.mean_height_m < kTallestHeadM;
  });
  exclude(candidates, [&](const AxisCandidate& one) -> std::string {
    if (!above || one.trial.mean_height_m > -kAboveFloorM) return "";
    return "the head is " + fixed_text(-one.trial.mean_height_m, 1) + " m below the world's origin";
  });
}

// Heads nod all the time and hardly ever lean for long.
void exclude_leaning(Candidates& candidates) {
  double least = 1e9;
  for (const AxisCandidate& one : candidates)
    if (one.against.empty()) least = std::min(least, one.figures().median_roll_deg);
  exclude(candidates, [&](const AxisCandidate& one) -> std::string {
    const double roll = one.figures().median_roll_deg;
    if (roll < kLeaningDeg || (roll < kLyingDeg && least > kLeaningTimes * roll)) return "";
    return "the head leans sideways by " + fixed_text(roll, 0) + " degrees in the median";
  });
}

// Names and units belong to one engine: where it remains, the others are dropped.
void exclude_by_words(Candidates& candidates, const std::vector<AxisReading>& readings) {
  const auto is_meant = [&](const AxisCandidate& one) {
    return readings[one.reading].only_one == one.convention;
  };
  if (std::none_of(candidates.begin(), candidates.end(),
                   [&](const AxisCandidate& one) { return one.against.empty() && is_meant(one); }))
    return;
  exclude(candidates, [&](const AxisCandidate& one) {
    return is_meant(one) ? std::string() : std::string("names and units are unusual");
  });
}

Candidates head_candidates(const RecordingFiles& files, const std::vector<AxisReading>& readings) {
  Candidates candidates;
  for (std::size_t reading = 0; reading < readings.size(); ++reading) {
    std::vector<std::size_t> conventions = readings[reading].conventions;
    if (conventions.empty()) {
      conventions.resize(axis_conventions().size());
      std::iota(conventions.begin(), conventions.end(), std::size_t{0});
    }
    for (const std::size_t convention : conventions) {
      ColumnMap map = readings[reading].map;
      set_head_axes(map, convention);
      candidates.push_back(tried(files, std::move(map), reading, convention, false));
    }
  }
  return candidates;
}

// "With the axes of Unity the head walks backwards over 90 % of the way."
void say_excluded(const Candidates& candidates, AxisVerdict& verdict) {
  std::size_t not_level = 0;
  for (const AxisCandidate& one : candidates) {
    if (one.against.empty() || one.reading != verdict.reading) continue;
    if (one.figures().level_share && *one.figures().level_share < kLevelRows)
      ++not_level;
    else
      verdict.reasons.push_back(std::string("With the axes of ") + one.axes().words + " " + one.against +
                                ".");
  }
  if (not_level > 0)
    verdict.reasons.push_back("With " + std::to_string(not_level) +
                              " other usual choices of axes the head is not level.");
}

std::string names_of(const std::vector<const AxisCandidate*>& left) {
  std::string names;
  for (std::size_t i = 0; i < left.size(); ++i)
    names += (i == 0 ? "" : i + 1 == left.size() ? " and " : ", ") + std::string(left[i]->axes().words);
  return names;
}

void ask_axes(const Candidates& candidates, const std::vector<const AxisCandidate*>& left,
              AxisVerdict& verdict) {
  if (left.empty()) {
    const auto legible = std::find_if(candidates.begin(), candidates.end(),
                                      [](const AxisCandidate& one) { return !one.trial.error; });
    verdict.questions.push_back(
        legible == candidates.end()
            ? "Whether these columns are right: they cannot be read (" + candidates.front().against + ")."
            : "Where the axes point: with none of the usual ones the data look like a person's head and eyes "
              "(\"world_axes\" and \"head_axes\" in the map).");
    return;
  }
  verdict.questions.push_back("Where the axes point: the data fit those of " + names_of(left) +
                              " alike, as nobody walks ahead in it for long and no gaze tells "
                              "(\"world_axes\" and \"head_axes\" in the map).");
  const auto any_reads = [&](RotationKind kind) {
    return std::any_of(left.begin(), left.end(), [&](const AxisCandidate* one) {
      return !one->map->head.empty() && one->map->head.front().rotation_kind == kind;
    });
  };
  if (any_reads(RotationKind::quaternion_xyzw) && any_reads(RotationKind::quaternion_wxyz))
    verdict.questions.push_back(
        "Whether w is the quaternion's first or last number: with other axes the data fit both "
        "(\"quaternion_wxyz\" or \"quaternion_xyzw\" in the map).");
}

void ask_gaze_axes(const std::vector<const AxisCandidate*>& left, AxisVerdict& verdict) {
  std::string text;
  for (const AxisCandidate* one : left) {
    const auto axes = one->map->gaze.front().axes.words();
    text += (text.empty() ? "" : "; ") + std::string("a head of ") + one->axes().words + " with gaze (" +
            axes[0] + ", " + axes[1] + ", " + axes[2] + ")";
  }
  verdict.questions.push_back(
      "Where the axes of the head and the gaze point: the head turns too little against the "
      "eyes to tell these apart: " +
      text + " (\"head_axes\", \"world_axes\" and the gaze's \"axes\" in the map).");
}

void take(const AxisCandidate& candidate, AxisVerdict& verdict) {
  verdict.draft = *candidate.map;
  verdict.axes = &candidate.axes();
  verdict.reading = candidate.reading;
  verdict.trial = candidate.trial;
}

}  // namespace

AxisVerdict settle_axes(const RecordingFiles& files, const std::vector<AxisReading>& readings) {
  AxisVerdict verdict;
  const bool gaze = !readings.front().map.gaze.empty();
  Candidates candidates = head_candidates(files, readings);
  for (AxisCandidate& one : candidates) exclude_alone(one);
  exclude_wavering(candidates);
  verdict.walks_ahead = exclude_by_walking(candidates);
  exclude_leaning(candidates);
  exclude_below_floor(candidates);
  if (!gaze) exclude_by_words(candidates, readings);
  std::vector<const AxisCandidate*> left = remaining(candidates);
  take(left.empty() ? candidates.front() : *left.front(), verdict);
  if (!gaze || left.empty()) {
    say_excluded(candidates, verdict);
    if (left.size() == 1)
      verdict.map = verdict.draft;
    else
      ask_axes(candidates, left, verdict);
  } else {
    GazeTrials trials = try_gaze(files, left, readings);
    exclude_by_words(trials.candidates, readings);
    left = remaining(trials.candidates);
    if (left.size() > 1) ask_gaze_axes(left, verdict);
    if (!left.empty()) take(*left.front(), verdict);
    say_excluded(candidates, verdict);
    verdict.eyes_tell = trials.eyes_tell;
    verdict.reasons.insert(verdict.reasons.end(), trials.reasons.begin(), trials.reasons.end());
    verdict.questions.insert(verdict.questions.end(), trials.questions.begin(), trials.questions.end());
    if (left.size() == 1 && trials.questions.empty()) verdict.map = verdict.draft;
  }
  verdict.fitting = left.size();
  if (!verdict.trial.error && !verdict.trial.words.empty())
    verdict.reasons.push_back(std::string("With the axes of ") + verdict.axes->words + " " +
                              verdict.trial.words + ".");
  if (verdict.map)
    verdict.reasons.push_back(
        "Whether a recording is mirrored shows in no data: the hand of the axes is the one that is usual.");
  if (verdict.walks_ahead && verdict.map)
    verdict.reasons.push_back("The head goes where it looks over " +
                              share_text(verdict.trial.figures.forwards_share.value_or(1)) + " of the way.");
  return verdict;
}

}  // namespace herr
