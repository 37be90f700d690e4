#include "server/synth/synth_command.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "scenes/load_scene.h"
#include "server/output/new_session_folder.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/process/version.h"
#include "server/synth/synth_report.h"
#include "server/synth/synth_streams.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/format/session_header.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

// Between the eyes, a little above and in front of them: where a headset has its cameras.
constexpr glm::dvec3 kCameraInHeadM{0.0, 0.025, -0.06};
constexpr double kLeastFocalPx = 1.0;       // as session_header demands
constexpr int kMostCameraPixels = 1 << 22;  // 16 rays a pixel and half floats: half a gigabyte
constexpr double kWallMarginM = 0.4;        // a body's half width, and the sway
constexpr double kLeastHalfWalkM = 0.25;
// Spacing of two rows that jitter moves together; the reader refuses streams with less than 0.1 ms.
constexpr double kLeastSpacingMs = 0.2;

CameraModel camera_model(const SynthOptions& options) {
  return pinhole_camera(options.camera_px().x, options.camera_px().y, options.camera_hfov_deg);
}

void check_camera(const SynthOptions& options) {
  if (options.room.empty() && options.camera_size)
    throw UsageError("--camera: there is nothing to see; give --scene FILE, the room");
  if (!options.has_camera()) return;
  const glm::ivec2 size = options.camera_px();
  const std::string shown = std::to_string(size.x) + "x" + std::to_string(size.y);
  if (size.x * size.y > kMostCameraPixels)
    throw UsageError("--camera: " + shown + " has too many pixels; 4194304 at most, for example 2048x2048");
  if (camera_model(options).fx < kLeastFocalPx)
    throw UsageError("--camera: " + shown + " over --camera-hfov is less than a pixel of focal length; " +
                     "give more pixels or a narrower view");
}

void check_times(const SynthOptions& options) {
  double fastest_hz = std::max(options.pose_hz, options.gaze_hz);
  if (options.has_camera()) fastest_hz = std::max(fastest_hz, options.camera_hz);
  if (options.stamp_jitter_ms > 0 && options.stamp_jitter_ms > 1e3 / fastest_hz - kLeastSpacingMs)
    throw UsageError("--stamp-jitter-ms: rows would change places; less than the shortest interval of a " +
                     std::string("stream by 0.2 ms or more"));
  const double length_ns = (options.duration_s + options.stamp_jitter_ms * 1e-3) * 1e9;
  if (static_cast<double>(kLastStampNs - options.start_ns) < length_ns)
    throw UsageError("--start-ns: the session would end after the last stamp, " +
                     std::to_string(kLastStampNs) + "; start earlier");
}

void check_replay_scene_name(const SynthOptions& options) {
  if (options.scene.empty()) return;
  check_scene_name("--replay-scene", options.scene);
  if (options.origin != glm::dvec3(0.0))
    throw UsageError(
        "--replay-scene: --origin moves the session away from it; replay with a --scene whose "
        "world_from_session undoes that");
}

// Somebody walks around `place`, inside the room's outer walls.
WalkArea walk_area(const SynthOptions& options, const std::optional<Scene>& room) {
  WalkArea area{options.place, {options.radius_m, options.radius_m}};
  if (!room || options.motion != MotionKind::walking) return area;
  const Bounds bounds = scene_bounds(*room);
  const Pose session_from_world = inverse(room->world_from_session);
  const glm::dvec3 a = session_from_world(bounds.lower), b = session_from_world(bounds.upper);
  for (const int axis : {0, 2}) {
    const double low =
        std::max(std::min(a[axis], b[axis]) + kWallMarginM, options.place[axis] - options.radius_m);
    const double high =
        std::min(std::max(a[axis], b[axis]) - kWallMarginM, options.place[axis] + options.radius_m);
    area.centre[axis] = 0.5 * (low + high);
    area.half_extent[axis == 0 ? 0 : 1] = 0.5 * (high - low);
  }
  if (std::min(area.half_extent.x, area.half_extent.y) < kLeastHalfWalkM)
    throw UsageError("--at: leaves no half metre to walk inside the room; choose a place in " +
                     printable(options.room.string()) + " or a larger --radius");
  return area;
}

SessionHeader header_for(const SynthOptions& options, const NewSessionFolder& folder,
                         DisplayProfile profile) {
  SessionHeader header = new_session_header(folder);
  header.provenance = std::string("made by ") + program_with_version() + " synth, seed " +
                      std::to_string(options.seed) + ", " + synth_motion_text(options);
  header.licence = "CC0-1.0";
  header.profile = std::move(profile);
  header.scene = options.scene;
  header.pose_hz = options.pose_hz;
  header.gaze_hz = options.gaze_hz;
  if (options.has_camera()) {
    SessionHeader::Camera camera;
    camera.model = camera_model(options);
    camera.head_from_camera.position = kCameraInHeadM;
    camera.nominal_hz = options.camera_hz;
    header.cameras.push_back(camera);
  }
  return header;
}

// Seen from the session's folder, as replay will look for it.
void check_replay_scene(const SynthOptions& options, const NewSessionFolder& folder) {
  if (options.scene.empty()) return;
  const fs::path file = scene_beside(folder, "--replay-scene", options.scene);
  try {
    (void)load_scene(file, options.asset_roots);
  } catch (const InputError& problem) {
    throw InputError(options.scene, 0, folder.with_final_name(problem.what()),
                     "choose another --replay-scene");
  }
}

SessionFindings check_result(const NewSessionFolder& folder) {
  try {
    return folder.findings();
  } catch (const InputError& error) {
    // Whatever can be wrong was refused before.
    throw std::logic_error("synth made a session that replay refuses: " +
                           folder.with_final_name(error.what()));
  }
}

}  // namespace

void check_synth_options(const SynthOptions& options) {
  check_camera(options);
  check_times(options);
  check_replay_scene_name(options);
}

int run_synth(const SynthOptions& options) {
  DisplayProfile profile = load_display_profile(options.profile);
  std::optional<Scene> room;
  if (!options.room.empty()) room = load_scene(options.room, options.asset_roots);
  const HeadMotion head({options.seed, options.motion, walk_area(options, room)});

  NewSessionFolder folder(options.out, options.overwrite);
  check_replay_scene(options, folder);
  const SessionHeader header = header_for(options, folder, std::move(profile));
  SessionRecorder recorder(folder.path());
  recorder.write_header(header);
  SynthReport report{options.out, {}, {}, {}, {}};
  report.poses = write_poses(options, head, recorder);
  report.gaze = write_gaze(options, head, header, recorder);
  if (options.has_camera()) report.camera = write_camera(options, head, header, *room, recorder);
  if (stop_signal() != 0) {
    print_message("stopped: nothing was written");
    return kExitSignalBase + stop_signal();
  }
  recorder.finish();
  report.findings = check_result(folder);
  folder.keep();
  print_result(options.json ? synth_json(options, report) : synth_text(options, report));
  return kExitDone;
}

}  // namespace herr
