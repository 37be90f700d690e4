// The flags of `herr check`. Before: command_line makes its parser. After: CheckOptions.
#pragma once

#include <string>
#include <vector>

#include "server/check/check_options.h"

namespace CLI {
class App;
}

namespace herr {

// The options hold the defaults that the help states.
void add_check_flags(CLI::App& app, CheckOptions& options);

// What was given on the line, parsed by `app`, that a measured run must know: session and settings, not what
// to compare with or where to write. Of what presets choose between, as it is in `render`, every flag: two
// builds may have other defaults.
std::vector<std::string> measured_run_arguments(const CLI::App& app, const RenderSettings& render);

}  // namespace herr
