// All sessions of a replay are looked at before the first frame of the first one: a typing error in the last
// of them is told at once, not after a night. Before: options. After: replay_session(), for the good ones.
#pragma once

#include <vector>

#include "server/results/session_report.h"
#include "server/settings/replay_options.h"

namespace herr {

// A report for each session, in their order; one that could not be opened is `failed` and `unopened`, with
// error and exit code, and was named on stderr. What may be otherwise later (memory), and a single session,
// which is opened at once anyway, are left to the replay. Ends early at a signal. Writes no file.
std::vector<SessionReport> check_sessions(const ReplayOptions& options);

// Adds to the error of a report that --keep-going gets past it, where opening the session with it succeeds.
void add_keep_going(const ReplayOptions& options, SessionReport& report);

// The small summary.json of a session that was refused, in its folder, unless results of an earlier replay or
// other files lie there. Throws UsageError and WriteError as OutputFolder::prepare does.
void write_refusal(const SessionReport& report, const ReplayOptions& options);

}  // namespace herr
