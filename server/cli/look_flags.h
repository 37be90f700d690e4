// Flags of `herr look`. Before: command_line makes its parser. After: LookOptions.
#pragma once

#include "server/look/look_options.h"

namespace CLI {
class App;
}

namespace herr {

// The options hold the defaults.
void add_look_flags(CLI::App& app, LookOptions& options);

}  // namespace herr
