// How some settings flicker over a clip in which the gaze rests. Before: a subject and its clip. After: rows
// of study.csv, one a setting.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "server/study/measure/references.h"
#include "server/study/measure/study_row.h"
#include "server/study/plan/study_setting.h"
#include "server/study/study_subject.h"

namespace herr {

// Each frame's reference has `passes` passes a half. Every setting keeps its renderer over the clip, as a
// replay does. `progress` is told of each frame; when it answers false the clip is given up and no row is
// returned. `keep` (may be empty) gets each frame's reference and pictures, by setting.
using KeepClipFrame = std::function<void(std::size_t frame, const FrameInstant& instant,
                                         const std::vector<LinearPicture>& reference,
                                         const std::vector<std::vector<LinearPicture>>& pictures)>;
std::vector<StudyRow> measure_clip(StudySubject& subject, const std::vector<StudySetting>& settings,
                                   const References::Context& context, int passes,
                                   const std::function<bool(std::size_t frame)>& progress,
                                   const KeepClipFrame& keep = {});

}  // namespace herr
