// What `herr inspect` is asked to look at.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/render_settings.h"
#include "server/inspect/probes/probe_dump.h"

namespace herr {

struct InspectOptions {
  std::filesystem::path path;                      // a session's folder (or its session.json), or a scene
  std::string scene;                               // empty: the scene that the session names
  std::vector<std::filesystem::path> asset_roots;  // folders below which a scene document finds models, too
  std::string profile;                             // built-in name or file; empty: the profile of the session
  double profile_scale = 1;                        // pixels of its viewports along each axis are times this
  RenderSettings render;                           // what the frame plan is made for
  bool strict = false;                             // a stream whose last line was cut off is an error
  bool decode = false;                             // read every picture whole, not only its header
  bool json = false;                               // results on stdout as JSON
  ProbeDumpRequest probes;                         // its folder empty: no pictures of probes
  std::filesystem::path acuity_plot;               // an SVG file; empty: none
  bool overwrite = false;                          // what an earlier run left there, of both
};

}  // namespace herr
