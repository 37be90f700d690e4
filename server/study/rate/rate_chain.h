// Asks again with less where nothing holds a rate: without the stages that flags leave out, then with half of
// --polar, as next_try says, until a setting holds. Pure: no clock, no machine. Before: RateAnswer of what
// was asked. After: rate_text, rate_json.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "server/study/rate/next_try.h"
#include "server/study/rate/rate_run.h"

namespace herr {

struct RateStep {
  SettingChanges changes;  // to what was asked, those of the steps before among them
  RateAnswer answer;
};

struct RateChain {
  std::vector<RateStep> steps;  // at least one; the first is what was asked, without changes
  NextTry next;                 // what is left to try after the last; only where `to_try`
  bool to_try = false;          // the last holds nothing: that is certain, and something is left
  bool ended_early = false;     // by the time, before `next`

  const RateAnswer& asked() const { return steps.front().answer; }
  const RateStep& last() const { return steps.back(); }
  // Not with what was asked, but with changes.
  bool holds_with_changes() const { return steps.size() > 1 && last().answer.held; }
  MachineUse machine() const;  // of all steps
  std::size_t runs() const;    // likewise
};

struct AskedRate {
  RateAnswer answer;
  FramePlan plan;  // of the settings that were asked for
};
// None: it was asked to stop.
using AskRate = std::function<std::optional<AskedRate>(const RenderSettings&)>;
// Before each step but the first: what the one before measured, and what comes next.
using TellStep = std::function<void(const MeasuredRate& smallest, const NextTry&)>;

// None where `ask` gave none. A step is begun only while `time_is_up` is not.
std::optional<RateChain> run_rate_chain(const RenderSettings& asked, const AskRate& ask, const TellStep& tell,
                                        const RateTimeIsUp& time_is_up = {});

}  // namespace herr
