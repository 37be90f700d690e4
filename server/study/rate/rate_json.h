// The answer of `herr study --hz` for machines. Before: RateChain. After: stdout.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/study/rate/rate_text.h"

namespace herr {

// {"hz", "period_ms", "holds", "command_line", "held", "prevented_by", "try_next", "ended_early",
// "open_settings", "machine", "estimate_for_free_cores", "warnings", "tried"}; null: there is none.
nlohmann::ordered_json rate_json(const RateQuestion& question, const RateAnswer& answer);
// The same of the last step, where "holds" is of what was asked, and besides "changes", the flags that the
// last step added to what was asked, or null; "holds_with_changes"; "steps": of each what it changed, whether
// it holds, what of it holds, what prevents more, and the estimate of free cores.
nlohmann::ordered_json rate_json(const RateQuestion& question, const RateChain& chain);

}  // namespace herr
