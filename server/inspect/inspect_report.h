// Everything that `herr inspect` found, before it becomes text or JSON.
// Before: inspect_session, load_scene, plan_frame. After: inspect_text, inspect_json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "renderer/frame_plan.h"
#include "server/inspect/acuity/acuity_facts.h"
#include "server/inspect/inspect_options.h"
#include "server/inspect/scene_facts.h"
#include "server/inspect/scene_in_view.h"
#include "server/settings/frame_range.h"
#include "sessions/format/display_profile.h"
#include "sessions/inspect/session_inspection.h"

namespace herr {

struct InspectReport {
  std::filesystem::path path;
  std::optional<SessionInspection> session;  // none: a scene was inspected
  DisplayProfile profile;                    // of the session, or the one asked for
  std::optional<FrameRange> frames;          // that replay would render; none where the span is not known
  std::filesystem::path scene_file;          // empty: none is named
  std::optional<SceneFacts> scene;           // none: not named, or it cannot be read
  std::optional<SceneInView> in_view;        // of the recording's poses, where there are both
  std::optional<FramePlan> plan;             // as soon as there is a scene
  RenderSettings settings;
  std::optional<AcuityFacts> acuity;  // none without foveation
  std::filesystem::path acuity_plot;  // that was written; empty: none
  std::optional<Scene> loaded;        // the scene, where its probes are asked for
  std::optional<ProbeDump> probes;    // what was written of them
  FindingList findings;               // of the session and of the scene

  bool has_camera_feed() const { return session && session->has_camera_feed(); }
  bool sound() const { return findings.first_error() == nullptr; }
};

InspectReport inspect(const InspectOptions& options);

}  // namespace herr
