#include "server/check/measure/measure_run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/check/measure/allocation_counter.h"
#include "server/check/measure/calibration.h"
#include "server/check/measure/check_fingerprint.h"
#include "server/frames/opened_session.h"
#include "server/output/png_encoder.h"
#include "server/process/exit_code.h"
#include "server/process/steady_time.h"
#include "server/process/version.h"

namespace herr {
namespace {

constexpr std::int64_t kMostWarmUpFrames = 10;

// Also what a slower build would do: nothing else runs on this thread.
void wait_busily(TimeNs duration_ns) {
  for (const TimeNs end_ns = steady_now_ns() + duration_ns; steady_now_ns() < end_ns;) {
  }
}

class MeasuredRun {
 public:
  MeasuredRun(const MeasureOptions& options, OpenedSession& opened, const FrameRange& range)
      : options_(options), opened_(opened), range_(range), calibration_(*opened.renderer) {
    const auto frames = static_cast<std::size_t>(range.count);
    result_.frame_ms.reserve(frames);
    result_.calibration_rays_ms.reserve(frames + 1);
    result_.calibration_memory_ms.reserve(frames + 1);
  }

  Measurement run(bool with_camera);
  std::string library_versions() const { return calibration_.library_versions(); }

 private:
  void render(std::int64_t frame);
  void calibrate();
  void count(bool with_camera);
  std::int64_t picture_bytes(bool with_camera);

  const MeasureOptions& options_;
  OpenedSession& opened_;
  const FrameRange& range_;
  Calibration calibration_;
  SceneState state_;
  RenderedFrame rendered_;
  FrameCounters counters_;
  double frame_ms_ = 0;  // of the last frame
  Measurement result_;
};

Measurement MeasuredRun::run(bool with_camera) {
  const std::int64_t warm_up = warm_up_frames(range_.count);
  for (std::int64_t i = 0; i < warm_up; ++i) {
    calibrate();
    render(range_.first + i);
  }
  result_.calibration_rays_ms.clear(), result_.calibration_memory_ms.clear();
  counters_ = {};
  const std::optional<CpuTicks> before = read_cpu_ticks();
  const std::optional<std::int64_t> allocations_before = allocations_counted();
  for (std::int64_t i = warm_up; i < range_.count; ++i) {
    calibrate();
    render(range_.first + i);
    result_.frame_ms.push_back(frame_ms_);
  }
  calibrate();
  const std::optional<CpuTicks> after = read_cpu_ticks();
  if (before && after) result_.cpu = CpuTicks{after->used - before->used, after->stolen - before->stolen};
  const std::optional<std::int64_t> allocations_after = allocations_counted();
  count(with_camera);
  std::optional<double> allocations;
  if (allocations_before && allocations_after) {
    allocations = static_cast<double>(*allocations_after - *allocations_before) /
                  static_cast<double>(result_.frame_ms.size());
  }
  result_.counters.emplace_back("allocations", allocations);
  return std::move(result_);
}

void MeasuredRun::calibrate() {
  const CalibrationTimes times = calibration_.time();
  result_.calibration_rays_ms.push_back(times.rays_ms);
  result_.calibration_memory_ms.push_back(times.memory_ms);
}

void MeasuredRun::render(std::int64_t frame) {
  const TimeNs t_ns = range_.time_ns(frame);
  const FrameSample sample = opened_.session->sample(t_ns);
  scene_state_at(opened_.scene, static_cast<double>(t_ns - opened_.session->start_ns()) * kSecondsPerNs,
                 state_);
  count_allocations(true);
  const TimeNs start_ns = steady_now_ns();
  opened_.renderer->render_frame(sample, state_, rendered_);
  if (options_.slow_down_percent > 0) {
    const auto own_ns = static_cast<double>(steady_now_ns() - start_ns);
    wait_busily(static_cast<TimeNs>(own_ns * options_.slow_down_percent / 100));
  }
  frame_ms_ = static_cast<double>(steady_now_ns() - start_ns) * 1e-6;
  count_allocations(false);
  counters_ += rendered_.counters;
}

void MeasuredRun::count(bool with_camera) {
  const auto frames = static_cast<double>(result_.frame_ms.size());
  const auto add = [&](const std::string& name, std::int64_t count) {
    result_.counters.emplace_back(name, static_cast<double>(count) / frames);
  };
  // Kinds that are not traced are left out: programs that know fewer kinds compare all the same.
  for (std::size_t k = 0; k < kRayKinds; ++k) {
    if (counters_.rays.of_kind[k] == 0) continue;
    add(std::string("rays.") + name_of(static_cast<RayKind>(k)), counters_.rays.of_kind[k]);
  }
  add("polar_samples", counters_.polar_samples);
  add("viewport_pixels", counters_.viewport_pixels);
  add("commits", counters_.commits);
  add("invalid_rays", counters_.invalid_rays);
  add("nonfinite_values", counters_.nonfinite_values);
  result_.counters.emplace_back("bytes_written", static_cast<double>(picture_bytes(with_camera)));
}

// What `replay --format png` would write of the last frame.
std::int64_t MeasuredRun::picture_bytes(bool with_camera) {
  const std::size_t count = rendered_.viewports.size();
  std::vector<Srgb8Image> pictures(count);
  std::vector<std::vector<std::uint8_t>> files(count);
  opened_.renderer->parallel_for(static_cast<int>(count), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    srgb8_from_viewport(rendered_.viewports[index], !with_camera, pictures[index]);
    encode_png(pictures[index], files[index]);
  });
  std::int64_t bytes = 0;
  for (const auto& file : files) bytes += static_cast<std::int64_t>(file.size());
  return bytes;
}

}  // namespace

std::int64_t warm_up_frames(std::int64_t frames) {
  return std::min(kMostWarmUpFrames, frames / 2);
}

Measurement measure_run(const MeasureOptions& options) {
  SessionReport report;
  report.session_folder = options.replay.sessions.front();
  report.name = report.session_folder.filename().string();
  OpenedSession opened;
  open_session(options.replay, report, opened);
  if (report.range.count < 2) {
    throw UsageError("--frames: a run has at least 2 frames; give more of the session");
  }
  MeasuredRun run(options, opened, report.range);
  Measurement measurement = run.run(report.plan.camera);
  measurement.program = program_with_version();
  measurement.fingerprint = check_fingerprint(report, options.replay, opened.scene, run.library_versions());
  return measurement;
}

}  // namespace herr
