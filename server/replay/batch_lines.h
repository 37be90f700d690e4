// What a replay of several sessions says of them together, on stderr. Before: check_sessions() and the
// replays. After: replay_command.cpp prints the lines.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "server/replay/replay_session.h"

namespace herr {

// "1 of 3 sessions refused: broken (exit 3); the other 2 are replayed": known before the first frame is
// drawn. Empty where none was refused.
std::string refused_line(const std::vector<SessionReport>& checked);

// "2 of 3 sessions done, 1 of them in part: a (1 row left out, exit 5), 1 failed: b (..., exit 3)": the last
// line, as the errors have long gone by. `reports`: of sessions that were begun or refused; `unbegun`: names
// of the others. Empty where all are done and end with 0. A remark says when --resume goes on.
std::string closing_line(const std::vector<SessionReport>& reports, const std::vector<std::string>& unbegun,
                         const ReplayOptions& options);

// The warnings of one of several sessions. One that begins with a path of the session stands as it is; one of
// the scene (of its file, or among `of_scene`: those that loading it gave), likewise and only the first time;
// others begin with the session's name. `said`: those of scenes so far; grows.
std::vector<std::string> batch_warnings(const SessionReport& report, const std::vector<std::string>& of_scene,
                                        std::set<std::string>& said);

}  // namespace herr
