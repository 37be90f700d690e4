// A recorded session, opened and checked, and what the headset knew at a frame's time.
// Before: a folder in format version 1 (README.md of this folder). After: renderer/ and server/.
// Streams are read as they are needed: memory does not grow with the length of the recording.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sessions/camera/camera_image.h"
#include "sessions/camera/camera_model.h"
#include "sessions/format/display_profile.h"
#include "sessions/format/pose.h"

namespace herr {

enum class SamplingMode { latest, predict, interpolate };

struct SessionOptions {
  SamplingMode sampling = SamplingMode::latest;  // latest: the newest sample at or before the time (causal)
  double predict_cap_s = 0.1;                    // predict: never extrapolate further than this
  bool keep_going = false;                       // skip and count bad rows and images instead of throwing
  bool strict = false;  // a stream whose last line was cut off is an error, not a warning
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
  std::array<Pose, 2> head_from_eye;  // default: +-31.5 mm along x
  bool gaze_combined = false;         // gaze_kind "combined"
  std::optional<double> vergence_m;   // combined gaze: distance at which the eyes converge
  double pose_hz = 0, gaze_hz = 0;    // nominal; 0 = not stated
  std::vector<Camera> cameras;        // 0, 1 or 2: [0] is the left or only one
  std::string scene;                  // path of a scene file relative to the session's folder; may be empty
};

// Gaze at a time: one unit direction per eye in head space (combined gaze is aimed at the vergence point).
struct SampledGaze {
  std::array<glm::dvec3, 2> head_direction{glm::dvec3{0, 0, -1}, glm::dvec3{0, 0, -1}};
  std::array<SampleSource, 2> source{SampleSource::centred, SampleSource::centred};
  TimeNs stamp_ns = 0;
  TimeNs age_ns = 0;  // of the newest row used; -1 when not meaningful
};

// A camera frame with the pose at which it was exposed.
struct SampledCamera {
  std::shared_ptr<const CameraImage> image;
  const CameraModel* model = nullptr;  // lives as long as the session
  Pose world_from_camera;              // at the frame's own stamp
  TimeNs stamp_ns = 0;
  TimeNs age_ns = 0;
};

// Everything that the headset would have known when a frame began at t_ns.
struct FrameSample {
  TimeNs t_ns = 0;
  SampledPose head;
  HeadSpeed head_speed;  // from poses recorded at or before t_ns, whatever the sampling mode
  SampledGaze gaze;
  std::array<Pose, 2> head_from_eye;
  std::array<std::optional<SampledCamera>, 2>
      cameras;  // per eye; both refer to the same frame when there is one camera
};

// One line of events.jsonl, not interpreted here.
struct SceneEvent {
  TimeNs t_ns = 0;
  std::string json;       // the whole line
  std::int64_t line = 0;  // 1-based line in events.jsonl
};

// What opening found, beyond errors.
struct SessionFindings {
  std::vector<std::string> warnings;  // one line each, "FILE:LINE: ...; ..."
  std::int64_t skipped_rows = 0;      // keep_going: bad rows left out
  std::int64_t skipped_images = 0;    // keep_going: camera rows whose file is missing or unusable
  bool truncated = false;             // a stream's last line was cut off and dropped
  std::int64_t pose_rows = 0, gaze_rows = 0, event_rows = 0;
  std::array<std::int64_t, 2> camera_rows{};
};

// Not thread-safe: one caller samples, with times that never decrease.
class Session {
 public:
  // Opens a folder and checks every row of every stream and every camera file's header. Throws InputError.
  static Session open(const std::filesystem::path& folder, const SessionOptions& options = {});
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  const SessionHeader& header() const;
  const SessionFindings& findings() const;
  const std::filesystem::path& folder() const;
  // The span that can be replayed: from the first pose to the last (or as the header narrows it). end >=
  // start.
  TimeNs start_ns() const;
  TimeNs end_ns() const;

  // State at t_ns (start_ns() <= t_ns). Throws InputError when a camera frame does not decode (unless
  // keep_going: then the previous frame is held) and std::logic_error when time runs backwards.
  FrameSample sample(TimeNs t_ns);
  // Events with stamps in (previous call's t_ns, t_ns].
  std::vector<SceneEvent> events_until(TimeNs t_ns);
  // The next one of them, or none up to t_ns: many may precede a late start.
  std::optional<SceneEvent> next_event(TimeNs t_ns);
  // All events from the first, read anew; this session's own reading is not moved. Throws InputError.
  void visit_events(const std::function<void(const SceneEvent&)>& visit) const;
  // Where lines of events come from, for messages.
  std::filesystem::path events_file() const;

 private:
  struct State;
  explicit Session(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace herr
