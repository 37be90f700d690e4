#include "server/study/measure/paired_times.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/threads/cpu_use.h"
#include "renderer/timing.h"
#include "server/process/steady_time.h"

namespace herr {
namespace {

// Shorter than any frame: keeps logarithms finite where a clock says 0.
constexpr double kShortest_ms = 1e-3;
// Cold caches and pages cost some milliseconds.
constexpr double kLongFrame_ms = 300;

struct FrameTime {
  double frame_ms = 0, pixels_ms = 0;
  std::optional<double> cpu_ms;
  std::int64_t preemptions = 0;
  double work_ms() const { return std::max(frame_ms - pixels_ms, kShortest_ms); }
};

FrameTime time_frame(Renderer& renderer, const FrameInstant& instant, RenderedFrame& frame) {
  renderer.render_frame(*instant.sample, *instant.state, frame);
  return {std::max(frame.times.frame_ms, kShortest_ms), frame.times[Stage::viewports], frame.cpu_ms,
          frame.preemptions.value_or(0)};
}

void add_use(const FrameTime& time, int cores, bool& known, PairedTimes& out) {
  known = known && time.cpu_ms.has_value();
  out.cpu_ms += time.cpu_ms.value_or(0), out.cores_ms += cores * time.frame_ms;
  out.preemptions += time.preemptions;
}

}  // namespace

PairedTimes time_pairs(Renderer& tested, Renderer& unit, const FrameInstant& instant,
                       Calibration& calibration, const TimingRules& rules, RenderedFrame& frame) {
  PairedTimes out;
  RenderedFrame unit_frame, again;
  std::vector<double> frame_ms, pixels_ms, calibration_ms;
  const int cores = std::min(tested.settings().threads, available_threads());
  bool cpu_known = true;
  const auto calibrate = [&] { calibration_ms.push_back(calibration.time().rays_ms); };
  calibrate();
  const TimeNs start_ns = steady_now_ns();
  const FrameTime first_unit = time_frame(unit, instant, unit_frame);
  const FrameTime first = time_frame(tested, instant, frame);
  const bool counts = first.frame_ms > kLongFrame_ms;
  for (int block = 0; block < rules.blocks; ++block) {
    const double taken_s = static_cast<double>(steady_now_ns() - start_ns) * 1e-9;
    if (block >= rules.fewest_blocks && taken_s > rules.seconds) break;
    const bool begun = block == 0 && counts;
    if (block > 0) calibrate();
    FrameTime of_unit[2], of_tested[2];
    of_unit[0] = begun ? first_unit : time_frame(unit, instant, unit_frame);
    of_tested[0] = begun ? first : time_frame(tested, instant, again);
    of_tested[1] = time_frame(tested, instant, again);
    of_unit[1] = time_frame(unit, instant, unit_frame);
    for (int i = 0; i < 2; ++i) {
      out.log_ratios.push_back(std::log(of_tested[i].frame_ms / of_unit[i].frame_ms));
      out.work_log_ratios.push_back(std::log(of_tested[i].work_ms() / of_unit[i].work_ms()));
      frame_ms.push_back(of_tested[i].frame_ms);
      pixels_ms.push_back(of_tested[i].pixels_ms);
      for (const FrameTime& time : {of_unit[i], of_tested[i]}) add_use(time, cores, cpu_known, out);
    }
  }
  if (!cpu_known) out.cpu_ms = 0;
  out.frame_ms = median(frame_ms);
  out.pixels_ms = median(pixels_ms);
  out.calibration_ms = median(calibration_ms);
  return out;
}

}  // namespace herr
