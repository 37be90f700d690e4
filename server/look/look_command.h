// `herr look`: a picture of a model, or a turntable of them, without a session.
#pragma once

#include "server/look/look_options.h"

namespace herr {

// Returns the exit code; throws InputError, UsageError, WriteError.
int run_look(const LookOptions& options);

}  // namespace herr
