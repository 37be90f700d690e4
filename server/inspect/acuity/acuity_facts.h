// How finely frames of full quality sample what the eyes see, against the acuity function and the display.
// Before: the settings' polar buffers, the display profile, the recorded gaze. After: acuity_text,
// inspect_json.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/foveation/reached_acuity.h"
#include "renderer/render_settings.h"
#include "server/settings/frame_range.h"
#include "server/statistics/latency_histogram.h"
#include "sessions/format/display_profile.h"
#include "sessions/inspect/session_inspection.h"

namespace herr {

// One eye that looks one way.
struct AcuityOfGaze {
  std::string gaze;  // "straight ahead"
  Eye eye = Eye::left;
  double theta_max_deg = 0;
  int columns = 0, rows = 0;  // of its polar buffer
  ReachedAcuity reached;
};

// Samples or pixels per degree at an eccentricity.
struct AcuityPoint {
  double theta_deg = 0;
  double asked = 0;  // 200 / (theta + 1)
  double radial = 0;
  std::optional<double> angular;  // around the circle; none at theta = 0
  double display = 0;             // of the finest viewport at that eccentricity, in any direction
};

// Of the frames that replay would render. Their "milliseconds" are degrees and samples per degree; per frame
// the eye that reaches less, and the larger theta_max.
struct AcuityOfFrames {
  LatencyHistogram theta_max, k_radial, k_angular;
};

struct AcuityFacts {
  std::vector<AcuityOfGaze> gazes;  // each eye straight ahead, and at the farthest corner of its viewports
  std::vector<AcuityPoint> ahead;   // of the first gaze, from theta = 0 to theta_max
  std::optional<AcuityOfFrames> frames;  // none without a recording, or where its gaze cannot be read
};

// None where there are no polar buffers: --foveation off.
std::optional<AcuityFacts> acuity_facts(const RenderSettings& settings, const DisplayProfile& profile);
// Adds `frames`.
void add_recorded_acuity(const RenderSettings& settings, const DisplayProfile& profile,
                         const SessionInspection& session, const FrameRange& frames, AcuityFacts& facts);

}  // namespace herr
