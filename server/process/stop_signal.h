// SIGINT, SIGTERM and SIGHUP: the first one asks the run to end, without the frame that is being
// rendered; a second one ends the process at once. SIGPIPE and SIGXFSZ are ignored, so that the
// write that failed reports it.
#pragma once

#include <atomic>

namespace herr {

// Call once at the start of main, before any thread exists. SIGHUP stays ignored if it was (nohup).
void install_signal_handling();

// From here on the first signal ends the process at once as well: for commands that leave nothing to finish.
// A signal that came before is still told by stop_signal().
void end_at_once_on_signal();

// Number of the signal that asked for the end, 0 while none did. Any thread.
int stop_signal();
// True from that signal on: for loops that must not know of signals.
const std::atomic<bool>& stop_flag();

}  // namespace herr
