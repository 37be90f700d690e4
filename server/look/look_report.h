// What `herr look` says that it made. Before: look_command. After: stdout.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/look/look_options.h"

namespace herr {

struct LookReport {
  std::filesystem::path out;
  int width_px = 0, height_px = 0, pictures = 1;
  LookDirection from;  // of the first picture
  double distance_m = 0, fov_deg = 0;
  double ev = 0;
  bool automatic_ev = true;
  std::int64_t triangles = 0, nonfinite_values = 0;
  bool studio = false;  // the model has no light of its own
  std::vector<std::string> warnings;
};

// One line.
std::string look_text(const LookReport& report);
std::string look_json(const LookReport& report);

}  // namespace herr
