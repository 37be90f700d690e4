// What no single flag can know: options that do not go together, or not with this machine.
// Before: the command line has filled the options. After: a command runs.
#pragma once

#include <string>

#include "renderer/render_settings.h"
#include "server/settings/replay_options.h"

namespace herr {

// The line that --threads is worth on a machine that lets this process use so many cores; empty: none.
std::string too_many_threads(int threads, int cores);
void warn_of_threads(int threads);
// Throws UsageError where this CPU lacks the instruction set, and for two exposures.
void check_render_settings(const RenderSettings& settings);
// A line on stderr for each setting that was given and changes nothing beside the others, and for more
// threads than cores.
void warn_of_idle_settings(const RenderSettings& settings);
// Throws UsageError that names the flag.
void check_replay_options(const ReplayOptions& options);

}  // namespace herr
