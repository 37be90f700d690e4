// What one measured run renders. Before: the command line, in the process that `herr check` started.
// After: measure_run.
#pragma once

#include "server/settings/replay_options.h"

namespace herr {

struct MeasureOptions {
  ReplayOptions replay;          // one session; nothing is written
  double slow_down_percent = 0;  // each frame waits busily for this share of its own time; 0: none
};

}  // namespace herr
