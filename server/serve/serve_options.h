// What `herr serve` is asked to do. Before: the command line fills it. After: serve_command.
#pragma once

#include <string>

#include "server/replay/replay_options.h"

namespace herr {

struct ServeOptions {
  ReplayOptions replay;            // sessions, scene, settings; nothing about files; clock realtime
  std::string host = "127.0.0.1";  // an address of loopback
  int port = 8080;                 // 0: a free one, printed on stdout
};

}  // namespace herr
