// The flags of `herr synth`. Before: command_line makes its parser. After: SynthOptions.
#pragma once

#include "server/synth/synth_options.h"

namespace CLI {
class App;
}

namespace herr {

// The options hold the defaults that the help states.
void add_synth_flags(CLI::App& app, SynthOptions& options);

}  // namespace herr
