// `herr study --report`: prints a saved report again, study.json and stability.json alike. Before: the
// command line. After: stdout, and the page of --page.
#pragma once

#include "server/study/study_options.h"

namespace herr {

// Returns the exit code: 0 also where relations failed then. Throws UsageError, InputError, WriteError.
int print_report_again(const StudyOptions& options);

}  // namespace herr
