#include "server/synth/synth_streams.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "server/output/new_session_folder.h"
#include "server/output/png_encoder.h"
#include "server/process/progress_bar.h"
#include "server/process/stop_signal.h"
#include "server/synth/camera_renderer.h"
#include "server/synth/gaze_motion.h"
#include "server/synth/irregular_events.h"
#include "server/synth/seeded_random.h"

namespace herr {
namespace {

constexpr std::uint64_t kPoseJitterStream = 64, kGazeJitterStream = 65, kCameraJitterStream = 66;
constexpr int kSmallPngLevel = 9;                 // written once, read often
constexpr std::int64_t kRowsBetweenLooks = 1024;  // at signals and the progress bar
// Trackers know no more; files with fewer digits are a third smaller.
constexpr double kPositionSteps = 1e6;   // a micrometre
constexpr double kDirectionSteps = 1e7;  // a fiftieth of an arc second
constexpr double kOpennessSteps = 1e3;

glm::dvec3 rounded(const glm::dvec3& v, double steps) {
  return {std::round(v.x * steps) / steps, std::round(v.y * steps) / steps, std::round(v.z * steps) / steps};
}

glm::dquat rounded(const glm::dquat& q) {
  const glm::dvec3 v = rounded({q.x, q.y, q.z}, kDirectionSteps);
  return {std::round(q.w * kDirectionSteps) / kDirectionSteps, v.x, v.y, v.z};
}

struct Rhythm {
  std::string name;  // of the stream, for the progress bar
  double hz = 0;
  std::uint64_t jitter_stream = 0;
  std::int64_t rows_between_looks = kRowsBetweenLooks;
};

// Calls take(stamp, seconds since the start) from 0 to the session's end, hitches left out.
template <class Take>
SynthCounts at_rate(const SynthOptions& options, const Rhythm& rhythm, const Take& take) {
  SynthCounts counts;
  SeededRandom jitter(options.seed, rhythm.jitter_stream);
  IrregularEvents pauses = hitches(options.seed, options.hitches_per_minute);
  const auto count = static_cast<std::int64_t>(std::floor(options.duration_s * rhythm.hz + 1e-9)) + 1;
  ProgressBar progress(rhythm.name, count);
  for (std::int64_t i = 0; i < count; ++i) {
    if (i % rhythm.rows_between_looks == 0) {
      if (stop_signal() != 0) return counts;
      progress.update(i);
    }
    const double late_ns = jitter.uniform(0, 1) * options.stamp_jitter_ms * 1e6;
    const TimeNs offset_ns = std::llround(static_cast<double>(i) * (1e9 / rhythm.hz) + late_ns);
    const double time_s = static_cast<double>(offset_ns) * kSecondsPerNs;
    if (pauses.share_at(time_s)) continue;
    take(options.start_ns + offset_ns, time_s);
    ++counts.rows;
  }
  counts.hitches = pauses.count();
  return counts;
}

}  // namespace

SynthCounts write_poses(const SynthOptions& options, const HeadMotion& head, SessionRecorder& recorder) {
  return at_rate(options, {"poses", options.pose_hz, kPoseJitterStream}, [&](TimeNs stamp_ns, double time_s) {
    Pose pose = head.at(time_s);
    pose.position = rounded(pose.position + options.origin, kPositionSteps);
    pose.orientation = rounded(pose.orientation);
    recorder.add_pose({stamp_ns, pose});
  });
}

SynthCounts write_gaze(const SynthOptions& options, const HeadMotion& head, const SessionHeader& header,
                       SessionRecorder& recorder) {
  GazeMotion gaze({options.seed, options.gaze, options.gaze_noise_deg}, head);
  IrregularEvents lids = blinks(options.seed, options.blinks_per_minute);
  std::int64_t lost_rows = 0;
  const auto take = [&](TimeNs stamp_ns, double time_s) {
    GazeRow row{stamp_ns, gaze.at(time_s, header.head_from_eye), {}};
    for (glm::dvec3& direction : row.head_direction) direction = rounded(direction, kDirectionSteps);
    const double openness = std::round(lid_openness(lids.share_at(time_s)) * kOpennessSteps) / kOpennessSteps;
    row.valid.fill(openness >= kLeastSeenOpenness);
    lost_rows += row.valid[0] ? 0 : 1;
    recorder.add_gaze(row, openness);
  };
  SynthCounts counts = at_rate(options, {"gaze", options.gaze_hz, kGazeJitterStream}, take);
  counts.saccades = gaze.saccades();
  counts.blinks = lids.count();
  counts.lost_rows = lost_rows;
  return counts;
}

SynthCounts write_camera(const SynthOptions& options, const HeadMotion& head, const SessionHeader& header,
                         const Scene& room, SessionRecorder& recorder) {
  const SessionHeader::Camera& camera = header.cameras.front();
  CameraRenderer renderer(room, camera.model, options.threads);
  Srgb8Image picture;
  std::vector<std::uint8_t> png;
  std::size_t pictures = 0;
  // Rendered before the origin is added: the room stands where the scene file has it.
  const auto take = [&](TimeNs stamp_ns, double time_s) {
    if (!renderer.render(head.at(time_s) * camera.head_from_camera, time_s, picture)) return;
    encode_png(picture, png, kSmallPngLevel);
    const std::string name = numbered_picture(pictures++, ".png");
    recorder.add_image(0, name, png);
    recorder.add_camera_frame(0, {stamp_ns, name});
  };
  return at_rate(options, {"camera", options.camera_hz, kCameraJitterStream, 1}, take);
}

}  // namespace herr
