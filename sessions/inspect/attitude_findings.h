// Warnings of a head that most likely has other axes than its recording says: upside down, on its side,
// looking into the sky. Before: AttitudeMeter. After: inspect_session, Session::open, `herr convert`.
#pragma once

#include <filesystem>

#include "sessions/inspect/findings.h"
#include "sessions/inspect/meters/attitude_meter.h"

namespace herr {

// `file`: of the poses. Nothing is judged of fewer than PlausibilityMeter::kFewestRows rows.
void judge_attitude(const AttitudeMeter& head, const std::filesystem::path& file, FindingList& findings);

}  // namespace herr
