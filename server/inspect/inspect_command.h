// `herr inspect`: is a recording or a scene sound, what is in it, and what will a frame of it do.
#pragma once

#include "server/inspect/inspect_options.h"

namespace herr {

// Prints the report and returns the exit code: 3 where replay would refuse the input, with the line that
// replay would print on stderr; else 0.
int run_inspect(const InspectOptions& options);

}  // namespace herr
