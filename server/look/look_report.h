// What `herr look` says that it made. Before: look_command. After: stdout.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/model/exposure.h"
#include "server/look/look_options.h"

namespace herr {

struct LookReport {
  std::filesystem::path out;                // a file, or the folder of a turntable
  std::vector<std::filesystem::path> also;  // the same picture in further formats
  int width_px = 0, height_px = 0, pictures = 1;
  LookDirection from;               // of the first picture
  std::vector<std::string> beyond;  // floors and walls that are not framed
  double distance_m = 0, fov_deg = 0;
  Exposure exposure;
  std::int64_t triangles = 0;
  std::string light;  // whose it is
  std::vector<std::string> warnings;
};

// One line.
std::string look_text(const LookReport& report);
std::string look_json(const LookReport& report);

}  // namespace herr
