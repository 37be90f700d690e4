// What `herr synth` is asked to make.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace herr {

struct SynthOptions {
  std::filesystem::path out;   // the session's folder; must not exist or be empty
  std::filesystem::path room;  // scene file that the camera sees
  std::string scene;           // written into session.json, relative to the session's folder; may be empty
  std::uint64_t seed = 1;      // same seed, same session
  double duration_s = 2;       // from the first pose to the last
  double pose_hz = 90, gaze_hz = 120, camera_hz = 10;
  int camera_width_px = 480, camera_height_px = 360;
  double camera_hfov_deg = 90;
};

}  // namespace herr
