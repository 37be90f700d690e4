// Writes a session folder in format version 1 (README.md of sessions/), file by file, session.json last: a
// folder without it is no session. Before: motion and pictures. After: Session::open.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/synth/gaze_motion.h"
#include "sessions/session.h"

namespace herr {

class SessionWriter {
 public:
  // Makes the folder. Throws UsageError when it exists and is not empty or cannot be made.
  explicit SessionWriter(std::filesystem::path folder);

  void add_pose(TimeNs stamp_ns, const Pose& world_from_head);
  void add_gaze(TimeNs stamp_ns, const GazeMotion::Sample& gaze);
  // Writes the picture at once; `png` are the bytes of the file.
  void add_camera_frame(TimeNs stamp_ns, const std::vector<std::uint8_t>& png);

  struct Header {
    std::string name, provenance, licence, profile, scene;
    double pose_hz = 0, gaze_hz = 0, camera_hz = 0;
    std::array<Pose, 2> head_from_eye;
    CameraModel camera;
    Pose head_from_camera;
  };
  // Writes the streams and session.json. Throws WriteError.
  void finish(const Header& header);

 private:
  std::filesystem::path folder_;
  std::string poses_, gazes_, frames_;
  int frame_count_ = 0;
};

}  // namespace herr
