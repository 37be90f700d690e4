// The flags of `herr study`. Before: command_line makes its parser. After: StudyOptions.
#pragma once

#include "server/study/study_options.h"

namespace CLI {
class App;
}

namespace herr {

// The options hold the defaults that the help states.
void add_study_flags(CLI::App& app, StudyOptions& options);
// What no single flag can know. Throws UsageError.
void check_study_flags(const CLI::App& app, StudyOptions& options);

}  // namespace herr
