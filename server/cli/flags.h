// Flags that take a value, and the flags that several commands share. Values are read strictly
// (flag_values.h). Before: command_line makes one parser for each command. After: options structs.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "server/serve/serve_options.h"
#include "server/settings/replay_options.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace herr {

using FlagReader = std::function<void(const std::string& text)>;

// A flag with a value. The reader runs once the whole line is understood. Given twice with different values,
// it throws UsageError: nobody could say which of them counts.
CLI::Option* value_flag(CLI::App& app, const std::string& flag, const std::string& value_name,
                        const std::string& help, const FlagReader& read);
// The same for a path that must not be empty.
void file_flag(CLI::App& app, const std::string& flag, const std::string& help, const FlagReader& read);

// --scene, in place of the one that the session names, and --asset-root.
void add_scene_flags(CLI::App& app, std::string& scene, std::vector<std::filesystem::path>& asset_roots);
// --asset-root, repeatable.
void add_asset_root_flag(CLI::App& app, std::vector<std::filesystem::path>& asset_roots);
// What is replayed, and how strictly it is read.
void add_session_flags(CLI::App& app, ReplayOptions& options);
// All of `herr replay` and of `herr serve`; the options hold the defaults.
void add_replay_flags(CLI::App& app, ReplayOptions& options);
void add_serve_flags(CLI::App& app, ServeOptions& options);
// What no single flag can know. Throws UsageError.
void check_serve_options(const ServeOptions& options);

}  // namespace herr
