// What `herr serve` is asked to do. Before: the command line fills it. After: serve_command.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/settings/replay_options.h"

namespace herr {

struct ServeOptions {
  ReplayOptions replay;                    // sessions, scene, settings; nothing about files; clock realtime
  std::string host = "127.0.0.1";          // off loopback only with a token
  int port = 8080;                         // 0: a free one, printed on stdout
  std::vector<std::string> allowed_hosts;  // further names under which clients may address the server
  std::filesystem::path auth_token_file;   // empty: everybody may ask
};

}  // namespace herr
