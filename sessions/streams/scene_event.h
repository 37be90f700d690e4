// A change of the scene as the session recorded it.
// Before: event_stream reads events.jsonl. After: the server hands it to scenes/, which knows what it says.
#pragma once

#include <cstdint>
#include <string>

#include "sessions/format/pose.h"

namespace herr {

// One line of events.jsonl, not interpreted here.
struct SceneEvent {
  TimeNs t_ns = 0;
  std::string json;       // the whole line
  std::int64_t line = 0;  // 1-based line in events.jsonl
};

}  // namespace herr
