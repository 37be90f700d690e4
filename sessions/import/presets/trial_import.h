// The first rows of a recording, read with some columns and judged: what tells siblings of a format apart.
// Before: fitting_columns. After: choose_format, check/proposal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/import_rows.h"
#include "sessions/inspect/plausibility.h"

namespace herr {

// Of each stream; where they do not tell, more of it may, at a price that a log of an hour does not feel.
inline constexpr std::int64_t kTrialRows = 20000, kLongTrialRows = 60000;

struct TrialImport {
  std::optional<InputError> error;  // what reading threw
  PlausibilityFigures figures;
  std::string rarity;                // that its rows are too rare for a head; or empty
  double unusable_share = 0;         // of the poses or the gaze, the larger; without lost tracking
  std::string words, gaze_words;     // of the head; of the eyes, or empty
  std::vector<std::string> remarks;  // what the clock did, where ids change: whole sentences
  double pose_hz = 0, gaze_hz = 0;
  double mean_height_m = 0;     // of the head above the world's origin
  std::uint64_t rows_hash = 0;  // of all stamps, poses and rays: equal for columns that mean the same
};

// At most `most_rows` of each stream; 0: all.
TrialImport trial_import(ImportRequest request, std::int64_t most_rows = kTrialRows);

// What excludes a person's head and eyes in these axes, a sentence; empty where nothing does.
std::string implausible(const TrialImport& trial);
// Why one of two readings of a recording is clearly the more plausible, a sentence; empty where it is not.
std::string better_because(const TrialImport& a, const TrialImport& b);
// How much better the eyes counter the head than by chance, in standard deviations; 0 without gaze.
double eye_evidence(const TrialImport& trial);
inline constexpr double kChanceEvidence = 4;

}  // namespace herr
