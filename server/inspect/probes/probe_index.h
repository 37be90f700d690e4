// probes.json: how to read the pictures of `herr inspect --probe-pictures`, and what is known of each probe.
#pragma once

#include <string>

#include "server/inspect/probes/probe_atlas.h"
#include "server/inspect/probes/probe_dump.h"

namespace herr {

// One atlas as float values and as a picture for the eye.
struct AtlasFiles {
  std::string set, quantity;  // "all" or "catchers", "irradiance" or "distance"
  std::string exr, png;
  double png_white = 1;
  int png_enlarge = 1;
};

// Head and atlases indented, one line for each probe.
std::string probe_index_text(const ProbeReader& probes, const AtlasLayout& layout,
                             const std::vector<AtlasFiles>& atlases, const ProbeScene& from,
                             const ProbeDump& dump);

}  // namespace herr
