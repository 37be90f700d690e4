// What `herr bench` is asked to measure.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/render_settings.h"

namespace herr {

struct BenchOptions {
  std::filesystem::path session;                   // empty: the shipped sample session
  std::string scene;                               // empty: the scene that the session names
  std::vector<std::filesystem::path> asset_roots;  // folders below which a scene document finds models, too
  std::string profile;                             // empty: the profile of the session
  double profile_scale = 1;                        // pixels of its viewports along each axis are times this
  RenderSettings render;
  int frames = 8;            // of the session, spread evenly over it
  int repeats = 5;           // the whole sequence is measured this often
  bool table = false;        // the paper's Table 1 instead: averages over runs
  bool left_out = false;     // what the frame plan leaves out, and what that saves
  double seconds = 10;       // of frame time that each of its cells is averaged over
  bool polar_given = false;  // one row, for render's polar buffer; else one for each of the paper's two
  bool json = false;
};

}  // namespace herr
