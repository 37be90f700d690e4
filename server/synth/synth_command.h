// `herr synth`: writes a synthetic session, the same for the same seed.
#pragma once

#include "server/synth/synth_options.h"

namespace herr {

int run_synth(const SynthOptions& options);

}  // namespace herr
