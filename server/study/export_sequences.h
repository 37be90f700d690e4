// The clip of a study as sequences of pictures, for video metrics that take frames: reference and settings
// side by side, with what such a metric must know. Before: a subject. After: a new folder of EXR files and
// sequence.json.
#pragma once

#include "server/study/study_run.h"

namespace herr {

// DIR/reference/VIEWPORT/frame_0000.exr and DIR/SETTING/VIEWPORT/frame_0000.exr: float, linear light, white
// = 1. sequence.json: frames per second; of each viewport its size, pixels per degree and, for each frame,
// the pixel that the gaze meets. Throws UsageError when the folder is there and not empty, WriteError.
void export_sequences(const StudyOptions& options, StudySubject& subject, StudyRun& run);

}  // namespace herr
