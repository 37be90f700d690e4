// Reads session.json, format version 1 (the schema is in this folder's README.md).
// Before: a file. After: Session::open, which checks the streams against what the header says.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sessions/camera/camera_model.h"
#include "sessions/files/input_error.h"
#include "sessions/format/display_profile.h"
#include "sessions/format/pose.h"

namespace herr {

inline constexpr int kSessionFormatVersion = 1;
// Later stamps are refused, so that the difference of any two fits into 64 bits (4e18 ns = 126 years).
inline constexpr TimeNs kLastStampNs = 4'000'000'000'000'000'000;

// What a conversion left out of a stream, and what it had to assume.
struct SessionConversion {
  struct LeftOut {
    std::string stream;  // "pose", "gaze", "cam0"
    std::int64_t rows = 0, of = 0;
    std::string reason;  // a sentence
  };
  // Of each list, and of each sentence; longer ones are refused.
  static constexpr std::size_t kMostEntries = 64, kMostBytes = 1000;

  std::vector<LeftOut> left_out;
  std::vector<std::string> assumed;  // sentences: "camera stamps were not recorded: 15 pictures a second"
  std::vector<std::string> remarks;  // sentences: how the format was recognised, what the clock did
  bool still_head = false, still_gaze = false;  // not recorded: they stand still on the user's word

  bool empty() const {
    return left_out.empty() && assumed.empty() && remarks.empty() && !still_head && !still_gaze;
  }
};

// What session.json says.
struct SessionHeader {
  struct Camera {
    CameraModel model;
    Pose head_from_camera;
    double nominal_hz = 0;
  };
  std::string name;
  std::string provenance, licence;
  DisplayProfile profile;
  std::array<Pose, 2> head_from_eye;      // default: +-31.5 mm along x
  bool gaze_combined = false;             // gaze_kind "combined"
  std::optional<double> vergence_m;       // combined gaze: distance at which the eyes converge
  double pose_hz = 0, gaze_hz = 0;        // nominal; 0 = not stated
  std::vector<Camera> cameras;            // 0, 1 or 2: [0] is the left or only one
  std::optional<double> feed_distance_m;  // of the camera feed's sphere about the displayed eye
  SessionConversion conversion;           // of a session that was converted
  std::string scene;  // path of a scene file relative to the session's folder; may be empty
};

struct ParsedSessionHeader {
  SessionHeader header;
  std::optional<TimeNs> start_ns, end_ns;  // narrow the span that can be replayed
  std::vector<InputError> warnings;        // legal but unlikely values, e.g. eyes 10 m apart
};

// Throws InputError that names the field.
ParsedSessionHeader read_session_header(const std::filesystem::path& session_json);

}  // namespace herr
