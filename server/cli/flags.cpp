#include "server/cli/flags.h"

#include <arpa/inet.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "server/cli/setting_flags.h"
#include "server/settings/flag_values.h"
#include "server/settings/option_checks.h"
#include "server/settings/run_settings.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr const char* kAssetRootFlag = "--asset-root";

bool is_ipv4_loopback(const std::string& text) {
  in_addr address{};
  return ::inet_pton(AF_INET, text.c_str(), &address) == 1 && (ntohl(address.s_addr) >> 24) == 127;
}

// As a Host header has it, in lower case, without a port.
std::string parse_host_name(const std::string& text) {
  std::string name = text;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  // The parser of the command line takes brackets for those of a list, and away.
  if (name.find(':') != std::string::npos && !name.starts_with('[')) name = "[" + name + "]";
  const bool ipv6 = name.size() > 2 && name.front() == '[' && name.back() == ']';
  const std::string allowed = ipv6 ? "[]0123456789abcdef:." : "0123456789abcdefghijklmnopqrstuvwxyz-._";
  if (name.empty() || name.size() > 253 || name.find_first_not_of(allowed) != std::string::npos)
    throw UsageError("--allowed-host: '" + printable(text) +
                     "' is no name of a host; give one without scheme and port");
  return name;
}

}  // namespace

CLI::Option* value_flag(CLI::App& app, const std::string& flag, const std::string& value_name,
                        const std::string& help, const FlagReader& read) {
  const auto once = [flag, read](const CLI::results_t& given) {
    for (const std::string& text : given) {
      if (text != given.front())
        throw UsageError(flag + ": is given twice, as '" + printable(given.front()) + "' and '" +
                         printable(text) + "'; give it once");
    }
    read(given.front());
    return true;
  };
  return app.add_option(flag, once, help)
      ->type_name(value_name)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)  // to see that they are several
      ->expected(1);
}

void file_flag(CLI::App& app, const std::string& flag, const std::string& help, const FlagReader& read) {
  value_flag(app, flag, "PATH", help, [flag, read](const std::string& text) { read(non_empty(flag, text)); });
}

void add_asset_root_flag(CLI::App& app, std::vector<std::filesystem::path>& asset_roots) {
  app.add_option_function<std::vector<std::string>>(
         kAssetRootFlag,
         [&asset_roots](const std::vector<std::string>& folders) {
           for (const std::string& folder : folders)
             asset_roots.emplace_back(non_empty(kAssetRootFlag, folder));
         },
         "folder below which a scene document finds models that are not in its own; may be given several "
         "times; has no effect on a bare .gltf, .glb or .vox")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
}

void add_scene_flags(CLI::App& app, std::string& scene, std::vector<std::filesystem::path>& asset_roots) {
  file_flag(app, "--scene", "scene file (default: the one that the session names)",
            [&scene](const std::string& text) { scene = text; });
  add_asset_root_flag(app, asset_roots);
}

void add_session_flags(CLI::App& app, ReplayOptions& options) {
  app.add_option("SESSION", options.sessions, "session folders")->required()->type_name("");
  add_scene_flags(app, options.scene, options.asset_roots);
  app.add_flag_callback(
      "--strict", [&] { options.session.strict = true; }, "a stream that was cut off is an error");
}

void add_replay_flags(CLI::App& app, ReplayOptions& options) {
  add_session_flags(app, options);
  file_flag(app, "--out", "folder for results; each session gets a folder in it (default out)",
            [&](const std::string& text) { options.out = text; });
  add_preset_flags(app, options.render);
  add_setting_flags(app, settings_of(options),
                    {SettingGroup::session, SettingGroup::look, SettingGroup::time, SettingGroup::span,
                     SettingGroup::files, SettingGroup::views});
  add_render_flags(app, options.render);
  app.add_flag_callback(
      "--overwrite", [&] { options.overwrite = true; }, "replace results that are there");
  app.add_flag_callback(
      "--resume", [&] { options.resume = true; }, "go on with a replay that was interrupted");
  app.add_flag_callback(
      "--keep-going", [&] { options.session.keep_going = true; },
      "skip bad rows and images, end with exit code 5");
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "results on stdout as JSON");
}

void add_serve_flags(CLI::App& app, ServeOptions& options) {
  options.replay.clock = ReplayClock::realtime;
  options.replay.formats = {};
  options.replay.sheet = SheetChoice::none;
  add_session_flags(app, options.replay);
  value_flag(app, "--host", "ADDRESS", "address of this machine to listen on (default 127.0.0.1)",
             [&](const std::string& text) { options.host = non_empty("--host", text); });
  value_flag(app, "--port", "N", "port, 0 ... 65535; 0: a free one (default 8080)",
             [&](const std::string& text) {
               options.port = static_cast<int>(parse_whole_number("--port", text, 0, 65535));
             });
  app.add_option_function<std::vector<std::string>>(
         "--allowed-host",
         [&](const std::vector<std::string>& names) {
           for (const std::string& name : names) options.allowed_hosts.push_back(parse_host_name(name));
         },
         "further name under which clients may address the server; may be given several times")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  file_flag(app, "--auth-token-file",
            "file of mode 0600 with the token that clients must show; a must off loopback",
            [&](const std::string& text) { options.auth_token_file = text; });
  add_preset_flags(app, options.replay.render);
  std::vector<Setting> settings = settings_of(options.replay);
  for (Setting& setting : settings) {
    if (setting.group == SettingGroup::span) setting.sentence += ", in each lap";
  }
  add_setting_flags(app, settings,
                    {SettingGroup::session, SettingGroup::look, SettingGroup::time, SettingGroup::span,
                     SettingGroup::views});
  add_render_flags(app, options.replay.render);
  app.add_flag_callback(
      "--keep-going", [&] { options.replay.session.keep_going = true; }, "skip bad rows and images");
}

void check_serve_options(const ServeOptions& options) {
  check_replay_options(options.replay);
  // Without a token, what is served is for this machine alone.
  const bool loopback =
      options.host == "localhost" || options.host == "::1" || is_ipv4_loopback(options.host);
  if (!loopback && options.auth_token_file.empty())
    throw UsageError(
        "--host: '" + printable(options.host) +
        "' is not an address of loopback, where anybody could look in; give --auth-token-file, or "
        "use 127.0.0.1, ::1 or localhost");
}

}  // namespace herr
