// `herr study --stability`: relations that must hold on stiff and extreme cases, on the user's own scene.
// Before: the command line. After: stability.json, stability.html, and the table on stdout.
#pragma once

#include "server/study/study_options.h"

namespace herr {

// Returns the exit code: 0, or 1 when a relation does not hold. Throws UsageError, InputError, WriteError,
// TemporaryError.
int run_stability(const StudyOptions& options);

}  // namespace herr
