// What opening a session found, beyond errors.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace herr {

struct SessionFindings {
  std::vector<std::string> warnings;  // one line each, "FILE:LINE: ...; ..."
  std::int64_t skipped_rows = 0;      // keep_going: bad rows left out
  std::int64_t skipped_images = 0;    // keep_going: camera rows whose file is missing or unusable
  bool truncated = false;             // a stream's last line was cut off and dropped
  std::int64_t pose_rows = 0, gaze_rows = 0, event_rows = 0;
  std::array<std::int64_t, 2> camera_rows{};
};

}  // namespace herr
