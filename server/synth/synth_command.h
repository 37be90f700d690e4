// `herr synth`: makes a synthetic session, the same for the same options. Before: the command line. After:
// OUT is a session that `herr replay` takes, or is as it was before.
#pragma once

#include "server/synth/synth_options.h"

namespace herr {

// What no single flag can know. Throws UsageError.
void check_synth_options(const SynthOptions& options);

// Returns an exit code. Throws UsageError, InputError (of the scenes), WriteError.
int run_synth(const SynthOptions& options);

}  // namespace herr
