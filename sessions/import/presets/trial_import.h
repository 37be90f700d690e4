// The first rows of a recording, read with some columns and judged: what tells siblings of a format apart.
// Before: fitting_columns. After: choose_format, check/proposal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sessions/import/import_rows.h"
#include "sessions/inspect/plausibility.h"

namespace herr {

inline constexpr std::int64_t kTrialRows = 20000;

struct TrialImport {
  std::optional<std::string> error;  // what reading threw
  PlausibilityFigures figures;
  std::string words;            // of the head
  double lost_share = 0;        // of the poses or the gaze, the larger
  std::uint64_t rows_hash = 0;  // of all stamps, poses and rays: equal for columns that mean the same
};

// At most kTrialRows of each stream.
TrialImport trial_import(ImportRequest request);

// What excludes a person's head and eyes in these axes, a sentence; empty where nothing does.
std::string implausible(const TrialImport& trial);
// How much better the eyes counter the head than by chance, in standard deviations; 0 without gaze. To be compared
// between readings of one recording: chance makes up kChanceEvidence.
double eye_evidence(const TrialImport& trial);
inline constexpr double kChanceEvidence = 3.5;

}  // namespace herr
