// Which frames of a session a study looks at: those in which there is something to see, spread over how fast
// the head turns and where the eyes look; and a clip in which the gaze rests. Before: an opened session.
// After: study_run prepares them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "server/frames/frame_step.h"
#include "server/study/report/study_record.h"

namespace herr {

inline constexpr int kClipFrames = 8;

struct StudyFrames {
  std::vector<StudyFrame> frames;  // in order of time
  std::vector<StudyFrame> clip;    // kClipFrames in a row, fewer where the session is shorter
};

// How much the eye sees in the prepared frame: 0 for nothing.
using SeenContrast = std::function<double(const FrameStep& step)>;

// Looks at up to 96 moments, evenly spaced, and keeps the half with more contrast (all where `contrast` is
// null). Those are divided into `count` parts by the speed of the head; of each part the frame is taken whose
// eccentricity of gaze has the rank of another part, so that slow and fast, straight and sideways all occur.
// The clip begins at the moment whose gaze moves least, against the head and in the world. Rewinds `step`
// before and after.
StudyFrames choose_frames(FrameStep& step, const FrameRange& range, int count, const SeenContrast& contrast);

}  // namespace herr
