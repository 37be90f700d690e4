#include "server/study/measure/measure_setting.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "server/process/steady_time.h"
#include "server/study/error/picture_errors.h"
#include "server/study/reference/reference_spec.h"

namespace herr {
namespace {

constexpr float kNearWhite = 0.9f;

double squared_error(const std::vector<ViewportMap>& maps, const std::vector<LinearPicture>& a,
                     const std::vector<LinearPicture>& b) {
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < maps.size(); ++v) {
    for (std::size_t i = 0; i < maps[v].band.size(); ++i) {
      if (maps[v].band[i] == kNotSeen) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        // Limiting to white before or after the mean is not the same: what is near white tells nothing.
        if (b[v].plane[c][i] > kNearWhite) continue;
        const double d = double{a[v].plane[c][i]} - double{b[v].plane[c][i]};
        sum += d * d;
        count += 1;
      }
    }
  }
  return count > 0 ? sum / count : 0;
}

// The picture's mean over seeds lies off by the bias and a share of the noise: with MSE_1 = bias^2 + noise
// and MSE_K = bias^2 + noise / K, bias^2 = (K MSE_K - MSE_1) / (K - 1). Of what the reference itself is off,
// a quarter of the squared difference of its halves is taken out.
double bias_of(Renderer& renderer, const MeasuringBench& bench, const ReferencePicture& reference) {
  const int seeds = bench.rules.bias_seeds;
  const FrameInstant& instant = bench.instant;
  const ParallelFor threads = threads_of(renderer);
  RenderedFrame frame;
  std::vector<LinearPicture> picture, sum;
  double single = 0;
  for (int k = 0; k < seeds; ++k) {
    PixelPass pass;
    pass.seed = 1000003u + static_cast<std::uint32_t>(k);  // of no reference
    renderer.render_pass(*instant.sample, *instant.state, pass, frame);
    read_viewports(frame, instant, threads, picture);
    single += squared_error(instant.maps, picture, reference.picture) / seeds;
    if (sum.empty()) {
      sum = picture;
      continue;
    }
    for (std::size_t v = 0; v < sum.size(); ++v) {
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < sum[v].plane[c].size(); ++i) sum[v].plane[c][i] += picture[v].plane[c][i];
      }
    }
  }
  for (LinearPicture& viewport : sum) {
    for (auto& plane : viewport.plane) {
      for (float& value : plane) value /= static_cast<float>(seeds);
    }
  }
  const double mean = squared_error(instant.maps, sum, reference.picture);
  const double own = reference.error.at(Metric::rmse);
  return std::sqrt(std::max(0.0, (seeds * mean - single) / (seeds - 1) - own * own));
}

}  // namespace

StudyRow measure_setting(const StudySetting& setting, const MeasuringBench& bench,
                         std::vector<LinearPicture>* picture) {
  const TimeNs start_ns = steady_now_ns();
  const FrameInstant& instant = bench.instant;
  StudyRow row;
  row.name = setting.name, row.knob = setting.knob, row.base = setting.base, row.value = setting.value;
  row.n = setting.n;
  row.flags = flags_text(setting.changes);
  row.frame = instant.number;

  const std::unique_ptr<Renderer> renderer =
      renderer_at(instant, with_changes(bench.defaults, setting.changes));
  RenderedFrame frame;
  const PairedTimes times =
      time_pairs(*renderer, bench.unit, instant, bench.calibration, bench.rules.timing, frame);
  row.counters = frame.counters;
  row.log_ratios = times.log_ratios, row.work_log_ratios = times.work_log_ratios;
  row.frame_ms = times.frame_ms, row.pixels_ms = times.pixels_ms, row.calibration_ms = times.calibration_ms;
  row.cpu_ms = times.cpu_ms, row.cores_ms = times.cores_ms;
  row.preemptions = static_cast<double>(times.preemptions);

  std::vector<LinearPicture> test;
  const ParallelFor threads = threads_of(*renderer);
  read_viewports(frame, instant, threads, test);
  for (LinearPicture& viewport : test) limit_to_white(viewport);
  const ReferencePicture& truth = bench.references.get(endless_effort(bench.defaults, setting.model));
  row.reference = truth.spec.name;
  row.error = picture_errors(instant.maps, test, truth.picture, threads);
  if (setting.own != OwnReference::none) {
    const ReferencePicture& own = bench.references.get(own_reference(bench.defaults, setting));
    row.own_reference = own.spec.name;
    row.own_error = picture_errors(instant.maps, test, own.picture, threads);
    const bool quick = row.frame_ms < bench.rules.bias_frame_ms;
    const bool same_probes = own.spec.same_probes || !renderer->plan().probes;
    if (setting.own == OwnReference::seeds && quick && same_probes) {
      row.bias = bias_of(*renderer, bench, own);
    }
  }
  if (picture != nullptr) *picture = std::move(test);
  row.seconds = static_cast<double>(steady_now_ns() - start_ns) * 1e-9;
  return row;
}

}  // namespace herr
