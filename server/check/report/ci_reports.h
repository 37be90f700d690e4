// The report of a check for what surrounds it: Markdown for a summary page, JUnit XML for a test report,
// workflow commands of GitHub. Before: CheckReport. After: files, stdout.
#pragma once

#include <string>

#include "server/check/report/check_report.h"

namespace herr {

// A section with a heading and tables; ends with an empty line, so that sections can follow each other.
std::string check_markdown(const CheckReport& report);

// One suite; one test case for each counter and each time that decides. A regression is a failure, what
// cannot be told is skipped; what is not comparable, and a check that broke off, is an error. `time` is in
// seconds: of the suite what the whole check took; all cases come from the same runs, so each has an equal
// share. Well-formed whatever the names hold.
std::string check_junit(const CheckReport& report);

// "::error title=...::..." for each regression and what is not comparable, "::warning ..." for what cannot be
// told, ten at most: more are not shown. Empty where all is well.
std::string check_annotations(const CheckReport& report);

}  // namespace herr
