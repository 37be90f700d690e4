#include "server/synth/synth_command.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "server/cli/exit_code.h"
#include "server/cli/progress_bar.h"
#include "server/cli/stop_signal.h"
#include "server/cli/terminal.h"
#include "server/cli/version.h"
#include "server/output/png_encoder.h"
#include "server/synth/camera_renderer.h"
#include "server/synth/gaze_motion.h"
#include "server/synth/head_motion.h"
#include "server/synth/session_writer.h"
#include "sessions/input_error.h"

namespace herr {
namespace {

constexpr TimeNs kFirstStampNs =
    1'000'000'000;  // not 0: a program that takes stamps for times since the start shows
constexpr double kHalfIpdM = 0.0315;
constexpr int kSmallPngLevel = 9;  // written once, read often
// Between the eyes, a little above and in front of them: where a headset has its cameras.
constexpr glm::dvec3 kCameraInHeadM{0.0, 0.025, -0.06};

// Calls take(stamp, seconds since the start) at `hz`, from 0 to `duration_s`.
template <class Take>
void at_rate(double hz, double duration_s, const Take& take) {
  const auto count = static_cast<std::int64_t>(std::floor(duration_s * hz + 1e-9)) + 1;
  for (std::int64_t i = 0; i < count; ++i) {
    const TimeNs offset_ns = std::llround(static_cast<double>(i) * (1e9 / hz));
    take(kFirstStampNs + offset_ns, static_cast<double>(offset_ns) * kSecondsPerNs);
  }
}

SessionWriter::Header header_for(const SynthOptions& options) {
  SessionWriter::Header header;
  const std::filesystem::path name =
      options.out.has_filename() ? options.out.filename() : options.out.parent_path().filename();
  header.name = name.string();
  header.provenance = std::string("made by ") + program_with_version() + " synth, seed " +
                      std::to_string(options.seed) + ", room " + printable(options.room.filename().string());
  header.licence = "CC0-1.0";
  header.profile = "xr1";
  header.scene = options.scene;
  header.pose_hz = options.pose_hz;
  header.gaze_hz = options.gaze_hz;
  header.camera_hz = options.camera_hz;
  header.head_from_eye[0].position = {-kHalfIpdM, 0, 0};
  header.head_from_eye[1].position = {kHalfIpdM, 0, 0};
  header.camera = pinhole_camera(options.camera_width_px, options.camera_height_px, options.camera_hfov_deg);
  header.head_from_camera.position = kCameraInHeadM;
  return header;
}

// Poses in the session's own frame, camera frames seen from where that stands in the room.
bool write_camera(const SynthOptions& options, const SessionWriter::Header& header, const HeadMotion& head,
                  SessionWriter& writer) {
  const Scene room = load_scene(options.room);
  CameraRenderer renderer(room, header.camera);
  ProgressBar progress("camera", static_cast<std::int64_t>(options.duration_s * options.camera_hz) + 1);
  std::int64_t done = 0;
  Srgb8Image picture;
  std::vector<std::uint8_t> png;
  at_rate(options.camera_hz, options.duration_s, [&](TimeNs stamp_ns, double time_s) {
    if (stop_signal() != 0) return;
    renderer.render(head.at(time_s) * header.head_from_camera, time_s, picture);
    encode_png(picture, png, kSmallPngLevel);
    writer.add_camera_frame(stamp_ns, png);
    progress.update(++done);
  });
  return stop_signal() == 0;
}

}  // namespace

int run_synth(const SynthOptions& options) {
  const SessionWriter::Header header = header_for(options);
  const HeadMotion head(options.seed);
  const GazeMotion gaze(options.seed, options.duration_s, head);
  SessionWriter writer(options.out);
  if (!write_camera(options, header, head, writer)) {
    print_message("stopped: " + printable(options.out.string()) +
                  " has no session.json yet and is no session");
    return kExitSignalBase + stop_signal();
  }
  at_rate(options.pose_hz, options.duration_s,
          [&](TimeNs stamp_ns, double time_s) { writer.add_pose(stamp_ns, head.at(time_s)); });
  at_rate(options.gaze_hz, options.duration_s, [&](TimeNs stamp_ns, double time_s) {
    writer.add_gaze(stamp_ns, gaze.at(time_s, header.head_from_eye));
  });
  writer.finish(header);
  print_result("session: " + printable(options.out.string()) + "\n");
  return kExitDone;
}

}  // namespace herr
