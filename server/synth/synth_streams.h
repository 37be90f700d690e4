// Writes the streams of a synthetic session, row by row. Before: what was asked for, as options and header.
// After: the recorder's files. Each stream has its own rate; all leave out the same hitches.
#pragma once

#include <cstdint>

#include "scenes/model/scene.h"
#include "server/synth/head_motion.h"
#include "server/synth/synth_options.h"
#include "sessions/record/session_recorder.h"

namespace herr {

// What was written of a stream.
struct SynthCounts {
  std::int64_t rows = 0;
  std::int64_t hitches = 0;               // that left rows out
  std::int64_t saccades = 0, blinks = 0;  // gaze
  std::int64_t lost_rows = 0;             // gaze: rows that are not valid
};

// All end early once stop_signal() tells of a signal. They throw WriteError.
SynthCounts write_poses(const SynthOptions& options, const HeadMotion& head, SessionRecorder& recorder);
SynthCounts write_gaze(const SynthOptions& options, const HeadMotion& head, const SessionHeader& header,
                       SessionRecorder& recorder);
// One picture for each row, of the room as the header's first camera sees it.
SynthCounts write_camera(const SynthOptions& options, const HeadMotion& head, const SessionHeader& header,
                         const Scene& room, SessionRecorder& recorder);

}  // namespace herr
