// What `herr study --hz` measures: a session, opened as `herr replay` opens it, rendered with one setting
// after the other at the rate asked for. Before: StudyOptions. After: RateTrial of each.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/frames/frame_step.h"
#include "server/study/plan/study_setting.h"
#include "server/study/rate/rate_frames.h"
#include "server/study/rate/rate_ladder.h"
#include "server/study/rate/rate_trial.h"
#include "server/study/study_options.h"

namespace herr {

// The most that the flags let it try.
RateSetting most_of(const StudyOptions& options);

// What one run is made of: the flags of `options` with `setting` in their place, at `options.hz`.
ReplayOptions replay_options_of(const StudyOptions& options, const RateSetting& setting);
// The command line of `herr replay` that does the same, to be pasted into a shell. Realtime, as a display has
// it.
std::string command_line_of(const StudyOptions& options, const RateSetting& setting);

// The command line that asks for the rate again, with `changes` to the frame.
std::string study_line_of(const StudyOptions& options, const SettingChanges& changes);

// Not thread-safe. Stays where it is: the renderer refers to its scene.
class RateSubject {
 public:
  // Opens with the least that is measured. Throws InputError and UsageError.
  RateSubject(const StudyOptions& options, const RateSetting& least);

  double period_ms() const { return report_.range.period_ms(); }
  const SessionReport& report() const { return report_; }

  // kRateFrames frames, or as many as fit into a time; fewer where more than a twentieth of them was late
  // before, unless `to_the_end`; 20 where each of these is hopeless (RateTrial). None: a signal asked for the
  // end.
  std::optional<RateTrial> measure(const RateSetting& setting, bool to_the_end);

 private:
  void set_up(const RateSetting& setting);

  const StudyOptions& options_;
  ReplayOptions run_;
  SessionReport report_;
  OpenedSession opened_;
  std::optional<FrameStep> step_;
  std::optional<RateSetting> set_up_;  // that the renderer has
  DisplayProfile profile_;             // not scaled
  std::vector<RateFrame> frames_;
  RenderedFrame rendered_;
};

}  // namespace herr
