// The command line: which command, with which options. CLI11 stands behind the .cpp file; values are read
// strictly (flag_values.h), unknown flags name the nearest known one, and every mistake is a UsageError.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "server/bench/bench_options.h"
#include "server/check/check_options.h"
#include "server/convert/convert_options.h"
#include "server/inspect/inspect_options.h"
#include "server/look/look_options.h"
#include "server/serve/serve_options.h"
#include "server/settings/replay_options.h"
#include "server/study/study_options.h"
#include "server/synth/synth_options.h"

namespace herr {

// --help or --version: text for stdout, nothing else to do.
struct ShowText {
  std::string text;
};

using Command = std::variant<ShowText, ReplayOptions, ServeOptions, BenchOptions, CheckOptions,
                             InspectOptions, LookOptions, StudyOptions, SynthOptions, ConvertOptions>;

// Arguments without the program's name. --help and --version win over every mistake in the rest.
Command parse_command_line(const std::vector<std::string>& arguments);

}  // namespace herr
