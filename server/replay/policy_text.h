// What a policy did in a run, for its headline. Before: RunStatistics. After: replay_command prints it.
#pragma once

#include <string>

#include "server/quality/quality_policy.h"
#include "server/statistics/run_statistics.h"

namespace herr {

// "deadline: polar width 788 ... 1576 (mean 1204), height 384 ... 768 (mean 701), light samples 1, 3 of 100
// frames at the floor, 1 of them over the target" (as measured); the width is that of both eyes, as --polar
// takes it; what never changed is one number. Probes are told where there are any. Empty for the policy
// fixed, and for a run without frames.
std::string policy_text(const RunStatistics& statistics, QualityPolicy policy);

}  // namespace herr
