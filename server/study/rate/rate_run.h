// The search as a run: measures what the search asks for, and what the answer tells besides. Before: a ladder
// and who measures it. After: rate_text, rate_json.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "server/study/rate/rate_ladder.h"
#include "server/study/rate/rate_trial.h"

namespace herr {

struct MeasuredRate {
  RateSetting setting;
  std::vector<RateTrial> trials;  // at least one
  double p95_ms = 0;              // the median of theirs
  int frames() const;
  MachineUse machine() const;
};

struct RateAnswer {
  double period_ms = 0;
  std::optional<MeasuredRate> held;     // the largest that holds; none: not even the smallest does
  std::optional<MeasuredRate> refused;  // the next larger, which does not; none: the largest holds
  std::vector<MeasuredRate> tried;      // all that were measured, ascending
  // Where the time ended the search: `held` is the largest and `refused` the smallest that were found to be
  // so, and there may be neither.
  bool ended_early = false;
  std::size_t open = 0;        // settings between them, of which nothing is known
  std::size_t runs_to_go = 0;  // that a search takes to close them, about

  // What is slowest in: the next larger setting, or the largest where that holds. One of them is there.
  const MeasuredRate& limit() const { return refused ? *refused : *held; }
  MachineUse machine() const;  // of all trials
};

// `whole`: to its last frame, however slow. None: the measurement was asked to stop.
using MeasureRate = std::function<std::optional<RateTrial>(const RateSetting&, bool whole)>;
// After each trial.
using TellRate = std::function<void(const RateSetting&, const RateTrial&)>;

// Asked before each trial but the first.
using RateTimeIsUp = std::function<bool()>;

// That a search takes once what is open is halved to nothing: of the settings beside its answer, about.
inline constexpr std::size_t kRunsAtTheEnd = 4;

// None where a measurement gave none. The smallest setting is always measured whole: its percentile is told
// where it does not hold.
std::optional<RateAnswer> run_rate_search(const std::vector<RateSetting>& ladder, double period_ms,
                                          const MeasureRate& measure, const TellRate& tell,
                                          const RateTimeIsUp& time_is_up = {});

// The name of the stage that takes most of a frame, with its milliseconds: a mean over all trials; "sample"
// is the sampling of the session, which is none of the renderer's. Threads that wait at the end of a phase
// are none.
struct LongestStage {
  std::string name;
  double ms = 0, frame_ms = 0;
  std::optional<Stage> stage;  // none: the sampling
};
LongestStage longest_stage(const std::vector<RateTrial>& trials);
// Means over all frames of all trials.
StageTimes mean_stages(const std::vector<RateTrial>& trials);

}  // namespace herr
