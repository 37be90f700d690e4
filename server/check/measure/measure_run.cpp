#include "server/check/measure/measure_run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/frame_counters.h"
#include "server/check/measure/allocation_counter.h"
#include "server/check/measure/calibration.h"
#include "server/check/measure/check_fingerprint.h"
#include "server/frames/frame_step.h"
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
  MeasuredRun(const MeasureOptions& options, const SessionReport& report, OpenedSession& opened)
      : options_(options),
        report_(report),
        renderer_(*opened.renderer),
        step_(options.replay, report, opened),
        calibration_(*opened.renderer) {
    const auto frames = static_cast<std::size_t>(report.range.count);
    result_.frame_ms.reserve(frames);
    result_.calibration_rays_ms.reserve(frames + 1);
    result_.calibration_memory_ms.reserve(frames + 1);
  }

  Measurement run();
  std::string library_versions() const { return calibration_.library_versions(); }

 private:
  void render(std::int64_t frame);
  void calibrate();
  void count();
  std::int64_t picture_bytes();

  const MeasureOptions& options_;
  const SessionReport& report_;
  Renderer& renderer_;
  FrameStep step_;
  Calibration calibration_;
  RenderedFrame rendered_;
  FrameCounters counters_;
  double frame_ms_ = 0;  // of the last frame
  Measurement result_;
};

Measurement MeasuredRun::run() {
  const FrameRange& range = report_.range;
  const std::int64_t warm_up = warm_up_frames(range.count);
  for (std::int64_t i = 0; i < warm_up; ++i) {
    calibrate();
    render(range.first + i);
  }
  result_.calibration_rays_ms.clear(), result_.calibration_memory_ms.clear();
  counters_ = {};
  const std::optional<CpuTicks> before = read_cpu_ticks();
  const std::optional<std::int64_t> allocations_before = allocations_counted();
  for (std::int64_t i = warm_up; i < range.count; ++i) {
    calibrate();
    render(range.first + i);
    result_.frame_ms.push_back(frame_ms_);
  }
  calibrate();
  const std::optional<CpuTicks> after = read_cpu_ticks();
  if (before && after) result_.cpu = CpuTicks{after->used - before->used, after->stolen - before->stolen};
  const std::optional<std::int64_t> allocations_after = allocations_counted();
  count();
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
  step_.prepare(frame);
  count_allocations(true);
  const TimeNs start_ns = steady_now_ns();
  step_.render(rendered_);
  if (options_.slow_down_percent > 0) {
    const auto own_ns = static_cast<double>(steady_now_ns() - start_ns);
    wait_busily(static_cast<TimeNs>(own_ns * options_.slow_down_percent / 100));
  }
  frame_ms_ = static_cast<double>(steady_now_ns() - start_ns) * 1e-6;
  count_allocations(false);
  counters_ += rendered_.counters;
}

void MeasuredRun::count() {
  const auto frames = static_cast<double>(result_.frame_ms.size());
  const auto add = [&](const std::string& name, std::int64_t count) {
    result_.counters.emplace_back(name, static_cast<double>(count) / frames);
  };
  // Kinds that are not traced are left out: programs that know fewer kinds compare all the same.
  for (std::size_t k = 0; k < kRayKinds; ++k) {
    if (counters_.rays.of_kind[k] == 0) continue;
    add(std::string("rays.") + name_of(static_cast<RayKind>(k)), counters_.rays.of_kind[k]);
  }
  for (const CounterRow& row : counter_rows()) add(row.name, counters_.*row.value);
  result_.counters.emplace_back("bytes_written", static_cast<double>(picture_bytes()));
}

// What `replay --format png` would write of the last frame.
std::int64_t MeasuredRun::picture_bytes() {
  const std::size_t count = rendered_.viewports.size();
  std::vector<Srgb8Image> pictures(count);
  std::vector<std::vector<std::uint8_t>> files(count);
  renderer_.parallel_for(static_cast<int>(count), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    srgb8_from_viewport(rendered_.viewports[index], !report_.plan.camera, pictures[index]);
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
  MeasuredRun run(options, report, opened);
  Measurement measurement = run.run();
  measurement.program = program_with_version();
  measurement.fingerprint = check_fingerprint(report, options.replay, opened.scene, run.library_versions());
  return measurement;
}

}  // namespace herr
