// `herr study --hz`: the largest setting whose frames hold a rate on this machine. Before: the command line.
// After: two sentences and a command line on stdout; nothing is written.
#pragma once

#include "server/study/study_options.h"

namespace herr {

// Returns the exit code (rate_exit_code). Throws UsageError, InputError, TemporaryError.
int run_rate(const StudyOptions& options);

}  // namespace herr
