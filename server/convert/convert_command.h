// `herr convert`: makes a session of a recording in another format. Before: the command line. After: OUT is a
// session that Session::open accepts, or does not exist.
#pragma once

#include "server/convert/convert_options.h"

namespace herr {

// Returns an exit code: done, or partial when --keep-going left rows out. Throws
// UsageError, InputError, WriteError.
int run_convert(const ConvertOptions& options);

}  // namespace herr
