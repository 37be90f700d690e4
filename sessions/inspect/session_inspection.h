// Everything that `herr inspect` can say of a recording without its scene: the pass that replay makes before
// its first frame, but past every fault, with measurements of what it reads. An error is found exactly where
// replay would refuse the recording. Bounded memory.
// Before: a session's folder. After: the report.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "sessions/check/session_check.h"
#include "sessions/check/session_findings.h"
#include "sessions/format/session_header.h"
#include "sessions/inspect/findings.h"
#include "sessions/inspect/gaze_meter.h"
#include "sessions/inspect/head_meter.h"
#include "sessions/inspect/plausibility.h"
#include "sessions/inspect/stream_summary.h"
#include "sessions/streams/session_options.h"

namespace herr {

struct InspectionRequest {
  std::filesystem::path folder;
  bool strict = false;                 // a stream whose last line was cut off is an error
  bool decode = false;                 // read every picture whole, not only its header
  std::optional<double> display_hz{};  // of the frames whose ages are told; none: the session's own display
};

struct SessionInspection {
  std::filesystem::path folder;
  std::optional<SessionHeader> header;  // none where session.json cannot be read
  std::optional<SessionSpan> span;      // what replay would show; none where that is not known
  StreamSummary poses;
  std::optional<StreamSummary> gaze;                    // none where nothing was recorded
  std::array<std::optional<StreamSummary>, 2> cameras;  // none where the header names no such camera
  HeadMeter head;
  GazeMeter eyes;
  PlausibilityMeter plausibility;
  std::int64_t event_rows = 0;
  std::int64_t decoded_pictures = 0, sanitised_values = 0;  // decode
  bool truncated = false;
  FindingList findings;

  bool has_camera_feed() const { return cameras[0] && cameras[0]->rows > 0; }
};

// Throws nothing for bad input: that is what the findings are for.
SessionInspection inspect_session(const InspectionRequest& request);

}  // namespace herr
