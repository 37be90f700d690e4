// What `herr study` is asked to do. Before: study_flags fills it. After: study_command.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/render_settings.h"
#include "sessions/streams/session_options.h"

namespace herr {

struct StudyOptions {
  std::filesystem::path session;
  std::string scene;                               // empty: the scene that the session names
  std::vector<std::filesystem::path> asset_roots;  // folders below which a scene document finds models, too
  std::string profile = "xr1-half";                // built-in name or file
  double profile_scale = 1;                        // pixels of its viewports along each axis are times this
  RenderSettings render;                           // the default, around which everything is swept
  SessionOptions reading;
  std::filesystem::path out;         // empty: out_folder()'s
  std::filesystem::path references;  // folder of references that studies share; empty: OUT/references
  std::filesystem::path export_to;   // new folder of picture sequences; empty: none
  std::filesystem::path page;        // with `report`: where its page is written; empty: nowhere
  std::filesystem::path report;      // a study.json or stability.json to print again; nothing is measured
  std::vector<std::string> only;     // sweeps by their setting, groups of relations; empty: all
  int frames = 3;
  double minutes = 20;
  // The largest setting whose frames hold this rate, in place of error against time: 1 ... 1000.
  std::optional<double> hz;
  bool profile_given = false, light_given = false;  // `profile` and the light samples are not the defaults
  bool minutes_given = false;                       // without them the search for `hz` has no limit
  bool stability = false;  // relations that must hold, in place of error against time
  bool overwrite = false, resume = false;
  bool json = false;
  std::vector<std::string> sweep_flags;  // flags given that mean nothing to `stability` and `hz`

  std::filesystem::path out_folder() const {
    return !out.empty() ? out : std::filesystem::path(stability ? "stability" : "study");
  }
};

}  // namespace herr
