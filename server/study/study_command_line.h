// The command line that measures the same again, as a shell takes it. Before: StudyOptions. After: the head
// of every report.
#pragma once

#include <string>

#include "server/study/study_options.h"

namespace herr {

std::string study_command_line(const StudyOptions& options);

}  // namespace herr
