// `herr convert --check`: what a recording seems to be, and the command line that converts it. Before:
// run_convert. After: stdout; a proposed column map in a file of its own.
#pragma once

#include "server/convert/convert_options.h"
#include "sessions/import/presets/choose_format.h"

namespace herr {

// Returns an exit code: done, or inconclusive when the data cannot tell. Throws InputError, UsageError,
// WriteError.
int run_format_check(const ConvertOptions& options, const FormatRequest& request);

}  // namespace herr
