// The gaze of a recording alone, as replay samples it: no pose is read, no picture decoded.
// Before: a session that was inspected. After: what a frame's gaze decides, asked frame by frame.
#pragma once

#include <filesystem>

#include "sessions/format/session_header.h"
#include "sessions/streams/gaze_sampler.h"

namespace herr {

// `has_gaze`: there is a gaze stream. Bad rows are passed over, as --keep-going does. Throws InputError where
// the stream cannot be read.
GazeSampler recorded_gaze(const std::filesystem::path& session_folder, const SessionHeader& header,
                          bool has_gaze);

}  // namespace herr
