// What to ask next where no setting holds the rate. Before: the smallest setting as it was measured. After:
// run_rate_chain asks it, or rate_command makes a line of it.
#pragma once

#include <optional>
#include <string>

#include "renderer/frame_plan.h"
#include "server/study/plan/study_setting.h"
#include "server/study/rate/rate_run.h"

namespace herr {

struct NextTry {
  SettingChanges changes;    // to what was asked
  std::optional<double> hz;  // in place of the rate, where there are no changes; mostly none
  std::string words;         // "without what flags leave out"
};

// The flags of all long stages that `asked` does not have yet and `plan`, of `asked`, has something to leave
// out for, and --no-camera where viewports take most over a camera feed; without any half of the --polar of
// `asked`; where that is the least, or viewports alone take longer than the period, the rate that `smallest`
// is enough for, in whole Hz where it is 1 or more.
NextTry next_try(const MeasuredRate& smallest, const RenderSettings& asked, const FramePlan& plan,
                 double period_ms);

}  // namespace herr
