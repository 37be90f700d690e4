// Flags that take a value, and the flags that several commands share. Values are read strictly
// (flag_values.h). Before: command_line makes one parser for each command. After: options structs.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "renderer/render_settings.h"
#include "server/serve/serve_options.h"
#include "server/settings/replay_options.h"

namespace CLI {
class App;
}

namespace herr {

inline constexpr std::int64_t kMostFrames = 1'000'000'000;

using FlagReader = std::function<void(const std::string& text)>;

// A flag with a value. The reader runs once the whole line is understood.
void value_flag(CLI::App& app, const std::string& flag, const std::string& value_name,
                const std::string& help, const FlagReader& read);
// The same for a path that must not be empty.
void file_flag(CLI::App& app, const std::string& flag, const std::string& help, const FlagReader& read);

// What is replayed, and how strictly it is read.
void add_session_flags(CLI::App& app, ReplayOptions& options);
// How streams are read, and which part of the session.
void add_span_flags(CLI::App& app, ReplayOptions& options);
// How the pictures look, written or served.
void add_look_flags(CLI::App& app, RenderSettings& render);
// Settings that decide which stages a frame runs.
void add_plan_flags(CLI::App& app, RenderSettings& render);
// Threads and instruction set.
void add_machine_flags(CLI::App& app, RenderSettings& render);
void add_probe_ray_flag(CLI::App& app, ProbeSettings& probes);
// Settings that every rendering command shares: those of the plan, of probes and of the machine.
void add_render_flags(CLI::App& app, RenderSettings& render);
// All of `herr replay` and of `herr serve`; the options hold the defaults.
void add_replay_flags(CLI::App& app, ReplayOptions& options);
void add_serve_flags(CLI::App& app, ServeOptions& options);
// What no single flag can know. Throws UsageError.
void check_serve_options(const ServeOptions& options);

}  // namespace herr
