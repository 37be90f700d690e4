// What is studied: a session and its scene, opened as `herr replay` opens them, and its frames as instants.
// Before: StudyOptions. After: study_run, clip_flicker, study_pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/frames/frame_step.h"
#include "server/study/measure/study_frames.h"
#include "server/study/reference/frame_instant.h"
#include "server/study/study_options.h"

namespace herr {

// An object of this kind stays where it is: the renderer refers to its scene.
class StudySubject {
 public:
  // Throws InputError and UsageError.
  explicit StudySubject(const StudyOptions& options);

  // Frames in ascending order until rewind(). The instant refers to this subject; valid until the next call.
  FrameInstant instant(std::int64_t frame);
  void rewind() { step_->rewind(); }
  // No instant needs it, and its threads limit those of others. No rewind() from then on.
  void free_renderer() { opened_.renderer.reset(); }

  const StudyFrames& frames() const { return frames_; }
  const RenderSettings& defaults() const { return report_.settings; }  // threads and isa resolved
  const SessionReport& report() const { return report_; }
  FramePlan plan_of(const RenderSettings& settings) const;
  // What pictures are of, beside frame and settings: the content of every input, profile and instruction set.
  const std::string& inputs() const { return inputs_; }

 private:
  ReplayOptions options_;
  SessionReport report_;
  OpenedSession opened_;
  std::optional<FrameStep> step_;
  StudyFrames frames_;
  std::string inputs_;
};

}  // namespace herr
