// Flags of `herr convert`. Before: command_line. After: ConvertOptions.
#pragma once

#include "server/convert/convert_options.h"

namespace CLI {
class App;
}

namespace herr {

void add_convert_flags(CLI::App& app, ConvertOptions& options);
// What no single flag can know. Throws UsageError.
void check_convert_flags(const ConvertOptions& options);

}  // namespace herr
