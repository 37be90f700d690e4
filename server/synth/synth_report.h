// What a synthetic session has, as text for people and as JSON. Before: run_synth. After: stdout.
#pragma once

#include <filesystem>
#include <string>

#include "server/synth/synth_options.h"
#include "server/synth/synth_streams.h"
#include "sessions/session.h"

namespace herr {

struct SynthReport {
  std::filesystem::path out;
  SynthCounts poses, gaze, camera;
  SessionFindings findings;  // of opening the result
};

// "head walking, gaze fixations, room room.scene.json": for the session's provenance.
std::string synth_motion_text(const SynthOptions& options);

std::string synth_text(const SynthOptions& options, const SynthReport& report);
std::string synth_json(const SynthOptions& options, const SynthReport& report);

}  // namespace herr
