// The replay of one session: sample, render, encode, write, frame after frame.
// Before: replay_command. After: pictures, frames.csv and summary.json in the output folder, and a report.
#pragma once

#include <filesystem>

#include "server/results/session_report.h"
#include "server/settings/replay_options.h"

namespace herr {

// Never throws for what can go wrong in a replay: the report holds state, exit code and message.
// Ends early, without the frame in work, when stop_signal() says so; options.resume goes on with it.
// Shows progress on a terminal.
SessionReport replay_session(const std::filesystem::path& session, const ReplayOptions& options);

}  // namespace herr
