// How the replay of one session went: everything that summary.json, the table and the
// exit code are made from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/frame_plan.h"
#include "renderer/further_view.h"
#include "renderer/memory_use.h"
#include "renderer/render_settings.h"
#include "server/process/exit_code.h"
#include "server/process/process_load.h"
#include "server/settings/frame_range.h"
#include "server/settings/replay_options.h"
#include "server/statistics/run_statistics.h"
#include "sessions/session.h"

namespace herr {

enum class ReplayState { done, interrupted, failed };
const char* name_of(ReplayState state);

// A frame whose plan was another than that of the frame before it.
struct PlanChange {
  std::int64_t frame = 0;
  std::vector<PlanEntry> changed;
  FramePlan plan;
};

struct SessionReport {
  // All pictures of a frame: the headset's viewports, then what --blended-view and the like ask for.
  std::vector<PictureOutline> pictures() const { return pictures_of_frame(profile, settings); }

  std::string name;  // of the session's folder
  std::filesystem::path session_folder, scene_file, out_folder;
  ReplayState state = ReplayState::done;
  int exit_code = kExitDone;
  std::string error;      // one line; empty unless failed
  bool unopened = false;  // failed before the first frame: session, scene or settings were refused

  SessionHeader header;
  SessionFindings findings;
  DisplayProfile profile;
  std::string scene_name;
  std::int64_t scene_triangles = 0;
  FrameRange range;         // what was to be rendered
  RenderSettings settings;  // threads and isa resolved to what ran
  FramePlan plan;           // of the scene as it was loaded
  MemoryUse memory;         // of renderer, scene and pictures: after opening; at the end of a replay, then
  ProcessLoad load;         // likewise
  std::vector<PlanChange> plan_changes;  // of this run, the first 100
  std::vector<std::string> warnings;     // of session, scene and run

  RunStatistics statistics;                  // of all frames, those of earlier runs included
  std::int64_t kept_frames = 0;              // of earlier runs: --resume found them finished
  std::string remark;                        // why --resume did not keep more, one line; mostly empty
  bool nothing_to_do = false;                // --resume found everything finished
  std::int64_t sanitised_camera_values = 0;  // of all camera images shown: NaN, Inf, negative or too large
  std::int64_t files_written = 0, bytes_written = 0;  // pictures
  std::int64_t writer_waits = 0;                      // frames that waited for the writer
  std::vector<std::string> contact_sheets;            // file names in out_folder
};

}  // namespace herr
