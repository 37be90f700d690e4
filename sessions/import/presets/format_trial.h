// Reads a part of a recording in several ways and says which of them looks like a person: by gravity, by how
// level and steady the head is, by eyes that converge and counter the head.
// Before: format_fit. After: choose_format takes the winner or names those that it cannot tell apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/presets/format_fit.h"
#include "sessions/inspect/plausibility.h"

namespace herr {

struct FormatTrial {
  FormatCandidate candidate;
  PlausibilityFigures figures;
  std::optional<InputError> error;  // it cannot be read so
};

// `most_rows`: of each stream; 0: all.
FormatTrial try_format(const RecordingFiles& files, const FormatCandidate& candidate, std::int64_t most_rows);

// Why `a` is clearly the more plausible one; empty where it is not.
std::string better_because(const FormatTrial& a, const FormatTrial& b);

// The one that is better than all others; null where there is none. Throws InputError where none can be read.
const FormatTrial* best_of(const std::vector<FormatTrial>& trials);

}  // namespace herr
