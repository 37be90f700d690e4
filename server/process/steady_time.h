// The wall clock of the replay loops: one that never goes back, and a sleep that a stop can end.
#pragma once

#include <functional>

#include "sessions/format/pose.h"

namespace herr {

TimeNs steady_now_ns();

// Sleeps until due_ns, at once when that is past. False when `stop` ended it, at most 20 ms after it could.
bool sleep_until(TimeNs due_ns, const std::function<bool()>& stop);

}  // namespace herr
