// `herr replay`: one or more sessions, one output folder each, then the results on stdout.
#pragma once

#include "server/settings/replay_options.h"

namespace herr {

// Returns the worst exit code of the sessions. Throws UsageError before anything is read or written when the
// output folders cannot be used.
int run_replay(const ReplayOptions& options);

}  // namespace herr
