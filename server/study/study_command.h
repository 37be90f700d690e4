// `herr study`: error against run time. Before: the command line. After: study.csv, study.json, study.html,
// and the report on stdout.
#pragma once

#include "server/study/study_options.h"

namespace herr {

// Returns the exit code. Throws UsageError, InputError, WriteError, TemporaryError.
int run_study(const StudyOptions& options);

}  // namespace herr
