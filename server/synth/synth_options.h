// What `herr synth` is asked to make.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "server/synth/gaze_targets.h"
#include "server/synth/head_motion.h"
#include "sessions/format/pose.h"

namespace herr {

struct SynthOptions {
  std::filesystem::path out;   // the session's folder
  std::filesystem::path room;  // scene file that the camera sees and that bounds a walk; may be empty
  std::vector<std::filesystem::path> asset_roots;  // folders below which a scene document finds models, too
  std::string scene;            // written into session.json, relative to the session's folder; may be empty
  std::string profile = "xr1";  // display profile, built in or a file
  std::uint64_t seed = 1;       // same seed, same session

  double duration_s = 2;            // from the first pose to the last
  TimeNs start_ns = 1'000'000'000;  // first stamp; not 0: a program that takes stamps for times since the
                                    // start shows
  double pose_hz = 90, gaze_hz = 120, camera_hz = 10;
  double stamp_jitter_ms = 0;  // samples come up to this much late
  double hitches_per_minute = 0;

  MotionKind motion = MotionKind::desk;
  glm::dvec3 place{0.0, 1.5,
                   3.7};   // where the head stays, or the middle of a walk: before the sample's table
  double radius_m = 2.0;   // how far a walk leaves it along x and z, inside the room
  glm::dvec3 origin{0.0};  // added to every recorded position

  GazeKind gaze = GazeKind::fixations;
  double gaze_noise_deg = 0.1;
  double blinks_per_minute = 15;

  bool camera = true;                     // given a room
  std::optional<glm::ivec2> camera_size;  // asked for by the user
  double camera_hfov_deg = 90;
  int threads = 0;  // of the camera's renderer; 0: all that this process may use
  bool overwrite = false, json = false;

  bool has_camera() const { return camera && !room.empty(); }
  glm::ivec2 camera_px() const { return camera_size.value_or(glm::ivec2{480, 360}); }
};

}  // namespace herr
