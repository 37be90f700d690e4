#include "renderer/bench_frame.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include "renderer/bench/bare_pixels.h"
#include "renderer/bench/bare_rays.h"
#include "renderer/frame/renderer_impl.h"
#include "renderer/timing.h"

namespace herr {
namespace {

// Of the jobs of 16 probes one in four is recorded: there are 128 of them in the default grid.
constexpr int kProbeJobStride = 4;

// i * spreading_stride(n) mod n visits each of n numbers once, and any few in a row lie far apart.
int spreading_stride(int n) {
  int stride = std::max(1, static_cast<int>(std::lround(0.6180339887 * n)));
  while (std::gcd(stride, n) != 1) ++stride;
  return stride;
}

// One frame's own rays and pixels, recorded from its last render.
class BareSide {
 public:
  BareSide(Renderer::Impl& impl, const FrameCounters& counters) : impl_(impl), totals_(counters.rays) {
    const int stride = impl.settings.light_samples >= 64 ? 256 : 16;
    // One tile of each run of `stride`, each time at another place in it: a fixed one would be the same
    // column of tiles where the buffer is a power of two wide, and all at the pole or none.
    for (int run = 0; run * stride < impl.tile_count(); ++run) {
      const int tile = run * stride + (stride / 2 + run * spreading_stride(stride)) % stride;
      if (tile < impl.tile_count()) impl.run_tile(tile, 0, &recorder_);
    }
    // Traced only: what the probes have gathered stays as it was.
    for (int job = 0; impl.plan.probes && job < impl.probe_job_count(); job += kProbeJobStride) {
      impl.probe_kernels.trace(impl.probe_job(job, 0, &recorder_));
    }
    for (std::size_t k = 0; k < kRayKinds; ++k) dense_[k] = recorder_.rays[k].dense();
    constexpr int kStripStride = 16;
    const PrecomputePixels precompute = precompute_pixels_for(impl.settings.isa);
    pixels_.resize(impl.viewport_jobs.size());
    for (std::size_t v = 0; v < impl.viewport_jobs.size(); ++v) {
      const ViewportJob& job = impl.viewport_jobs[v];
      for (int strip = kStripStride / 2; strip * kStripRows < job.viewport->height_px;
           strip += kStripStride) {
        const int bottom = std::min((strip + 1) * kStripRows, job.viewport->height_px);
        for (int y = strip * kStripRows; y < bottom; ++y) {
          for (int x = 0; x < job.viewport->width_px; x += kBlockColumns) precompute(job, x, y, pixels_[v]);
        }
      }
      recorded_pixels_ += pixels_[v].count();
      pixels_[v].out.resize(4 * pixels_[v].count());
    }
    all_pixels_ = counters.viewport_pixels;
  }

  // Milliseconds that all rays of kind k take bare, scaled from those recorded: packed densely or as the
  // frame packed them, whichever is faster (dense packets waste no lane, the frame's own keep blocks of
  // neighbours together).
  double rays_ms(std::size_t k) {
    if (dense_[k].size() == 0) return 0;
    double ms = packets_ms(k, dense_[k]);
    if (recorder_.rays[k].size() != dense_[k].size()) ms = std::min(ms, packets_ms(k, recorder_.rays[k]));
    return ms * static_cast<double>(totals_.of_kind[k]) / static_cast<double>(dense_[k].size());
  }

  double pixels_ms() {
    if (recorded_pixels_ == 0) return 0;
    const CompositePrecomputed composite = composite_precomputed_for(impl_.settings.isa);
    constexpr std::size_t kChunk = 4096;
    double ms = 0;
    for (std::size_t v = 0; v < pixels_.size(); ++v) {
      const int jobs = static_cast<int>((pixels_[v].count() + kChunk - 1) / kChunk);
      ms += wall_ms([&] {
        impl_.threads.run(jobs, [&](int job, int) {
          const std::size_t first = static_cast<std::size_t>(job) * kChunk;
          composite(impl_.viewport_jobs[v], pixels_[v], first, std::min(kChunk, pixels_[v].count() - first));
        });
      });
    }
    return ms * static_cast<double>(all_pixels_) / static_cast<double>(recorded_pixels_);
  }

 private:
  double packets_ms(std::size_t k, const RecordedRays& rays) {
    constexpr std::size_t kChunk = 512;
    const int jobs = static_cast<int>((rays.size() + kChunk - 1) / kChunk);
    std::atomic<std::size_t> hits{0};
    return wall_ms([&] {
      impl_.threads.run(jobs, [&](int job, int) {
        const std::size_t first = static_cast<std::size_t>(job) * kChunk;
        hits += trace_bare(impl_.settings.isa, impl_.geometry->top(), static_cast<RayKind>(k), rays, first,
                           std::min(kChunk, rays.size() - first));
      });
    });
  }

  Renderer::Impl& impl_;
  RayCounts totals_;
  RayRecorder recorder_;
  std::array<RecordedRays, kRayKinds> dense_;
  std::vector<PrecomputedPixels> pixels_;
  std::size_t recorded_pixels_ = 0;
  std::int64_t all_pixels_ = 0;
};

// Samples of one quantity: of each frame the median over repeats, of all the median over frames.
struct Series {
  std::vector<std::vector<double>> of_frame;
  void add(std::size_t frame, double x) {
    if (frame >= of_frame.size()) of_frame.resize(frame + 1);
    of_frame[frame].push_back(x);
  }
  double value() const {
    std::vector<double> medians;
    for (const std::vector<double>& samples : of_frame) medians.push_back(median(samples));
    return median(std::move(medians));
  }
};

struct Measurements {
  Series frame, cpu, bare, ratio, rays_frame, rays_bare, rays_ratio, pixels_frame, pixels_bare;
  std::array<Series, kRayKinds> kind_bare;
  std::array<Series, kStageCount> stages;

  void add(std::size_t i, const StageTimes& times, const std::array<double, kRayKinds>& kinds_ms,
           double bare_pixels_ms) {
    const double bare_rays = std::accumulate(kinds_ms.begin(), kinds_ms.end(), 0.0);
    const double pixels = times[Stage::viewports];
    const double rays = times.frame_ms - pixels - times[Stage::overlays];
    frame.add(i, times.frame_ms), bare.add(i, bare_rays + bare_pixels_ms);
    ratio.add(i, times.frame_ms / (bare_rays + bare_pixels_ms));
    rays_frame.add(i, rays), rays_bare.add(i, bare_rays),
        rays_ratio.add(i, bare_rays > 0 ? rays / bare_rays : 0);
    pixels_frame.add(i, pixels), pixels_bare.add(i, bare_pixels_ms);
    for (std::size_t k = 0; k < kRayKinds; ++k) kind_bare[k].add(i, kinds_ms[k]);
    for (std::size_t s = 0; s < kStageCount; ++s) stages[s].add(i, times.ms[s]);
  }
};

std::array<double, kRayKinds> bare_kinds_ms(BareSide& bare) {
  std::array<double, kRayKinds> ms{};
  for (std::size_t k = 0; k < kRayKinds; ++k) ms[k] = bare.rays_ms(k);
  return ms;
}

std::int64_t bytes_of_pictures(const RenderedFrame& frame) {
  std::int64_t sum = 0;
  for (const ViewportImage& viewport : frame.viewports) sum += bytes_of(viewport.rgba_half);
  for (const FurtherView& view : frame.further) sum += bytes_of(view.image.rgba_half);
  return sum;
}

double millions_per_second(double items, double ms) {
  return ms > 0 ? items / ms * 1e-3 : 0;
}

Stage stage_of(std::size_t kind) {
  switch (static_cast<RayKind>(kind)) {
    case RayKind::primary:
      return Stage::first_hits;
    case RayKind::edge:
    case RayKind::edge_shadow:
      return Stage::edges;
    case RayKind::mirror:
    case RayKind::refraction:
      return Stage::second_hits;
    case RayKind::mirror_shadow:
    case RayKind::refraction_shadow:
      return Stage::second_light;
    case RayKind::probe:
    case RayKind::probe_shadow:
    case RayKind::catcher_probe:
    case RayKind::catcher_probe_shadow:
      return Stage::probe_rays;
    case RayKind::occlusion:
    case RayKind::catcher_occlusion:
      return Stage::occlusion;
    default:
      return Stage::light_rays;
  }
}

// What a frame's plan has becomes what some frame's plan had: limits of a sequence follow from that.
void widen(FramePlan& plan, const FramePlan& by) {
  for (bool FramePlan::*trait :
       {&FramePlan::alpha_blend, &FramePlan::catchers_occlude, &FramePlan::mirror_rays,
        &FramePlan::refraction, &FramePlan::occlusion, &FramePlan::probes, &FramePlan::catcher_probes}) {
    plan.*trait = plan.*trait || by.*trait;
  }
  plan.edge_samples = std::max(plan.edge_samples, by.edge_samples);
}

// Rates and shares of kinds of rays that were traced at all.
std::vector<BenchResult::Kind> kinds_of(const BenchResult& result, const Measurements& measured) {
  const auto frames = static_cast<double>(std::max(result.measured_frames, 1));
  const auto samples = static_cast<double>(result.counters.polar_samples);
  std::vector<BenchResult::Kind> kinds;
  for (std::size_t k = 0; k < kRayKinds; ++k) {
    const auto rays = static_cast<double>(result.counters.rays.of_kind[k]);
    if (rays == 0) continue;
    kinds.push_back({name_of(static_cast<RayKind>(k)), static_cast<std::int64_t>(rays / frames),
                     samples > 0 ? rays / samples : 0,
                     millions_per_second(rays / frames, measured.kind_bare[k].value()),
                     millions_per_second(rays / frames, result.median_times[stage_of(k)])});
  }
  return kinds;
}

}  // namespace

BenchRun bench_run(Renderer& renderer, BenchSequence& sequence, double seconds) {
  Renderer::Impl& impl = renderer.internals();
  BenchRun run;
  double frames_ms = 0, bare_ms = 0, probes_ms = 0, cpu_ms = 0;
  bool cpu_told = true;
  RenderedFrame out;
  sequence.render(0, out);
  while (frames_ms < 1e3 * seconds) {
    sequence.rewind();
    for (int i = 0; i < sequence.frames(); ++i, ++run.frames) {
      sequence.render(i, out);
      frames_ms += out.times.frame_ms;
      cpu_ms += out.cpu_ms.value_or(0);
      cpu_told = cpu_told && out.cpu_ms;
      probes_ms += out.times[Stage::probe_rays] + out.times[Stage::probe_update];
      BareSide bare(impl, out.counters);
      const std::array<double, kRayKinds> kinds_ms = bare_kinds_ms(bare);
      bare_ms += std::accumulate(kinds_ms.begin(), kinds_ms.end(), bare.pixels_ms());
    }
  }
  const double count = std::max(run.frames, 1);
  run.frame_ms = frames_ms / count, run.bare_ms = bare_ms / count, run.probe_ms = probes_ms / count;
  if (cpu_told) run.cpu_ms = cpu_ms / count;
  run.picture_bytes = bytes_of_pictures(out);
  return run;
}

BenchResult bench_frames(Renderer& renderer, BenchSequence& sequence, int repeats) {
  Renderer::Impl& impl = renderer.internals();
  Measurements measured;
  RenderedFrame out;
  BenchResult result;
  result.frames = sequence.frames();
  for (int pass = 0; pass <= repeats; ++pass) {
    if (pass > 0) sequence.rewind();
    for (int i = 0; i < result.frames; ++i) {
      sequence.render(i, out);
      widen(result.plan, renderer.plan());
      if (pass == 0) continue;  // warms up
      BareSide bare(impl, out.counters);
      const std::array<double, kRayKinds> kinds_ms = bare_kinds_ms(bare);
      const double pixels_ms = bare.pixels_ms();
      measured.add(static_cast<std::size_t>(i), out.times, kinds_ms, pixels_ms);
      if (out.cpu_ms) measured.cpu.add(static_cast<std::size_t>(i), *out.cpu_ms);
      result.counters += out.counters;
      ++result.measured_frames;
    }
  }

  const double pixels = static_cast<double>(result.counters.viewport_pixels) /
                        static_cast<double>(std::max(result.measured_frames, 1));
  result.frame_ms = measured.frame.value(), result.bare_ms = measured.bare.value();
  if (!measured.cpu.of_frame.empty()) result.cpu_ms = measured.cpu.value();
  result.picture_bytes = bytes_of_pictures(out);
  result.ratio = measured.ratio.value();
  result.rays_frame_ms = measured.rays_frame.value(), result.rays_bare_ms = measured.rays_bare.value();
  result.rays_ratio = measured.rays_ratio.value();
  result.pixels_frame_ms = measured.pixels_frame.value(),
  result.pixels_bare_ms = measured.pixels_bare.value();
  result.ns_per_pixel = pixels > 0 ? result.pixels_frame_ms * 1e6 / pixels : 0;
  result.bare_ns_per_pixel = pixels > 0 ? result.pixels_bare_ms * 1e6 / pixels : 0;
  for (std::size_t s = 0; s < kStageCount; ++s) result.median_times.ms[s] = measured.stages[s].value();
  result.median_times.frame_ms = result.frame_ms;
  result.kinds = kinds_of(result, measured);
  if (impl.probes) result.most_probe_rays = impl.probes->most_rays();
  return result;
}

}  // namespace herr
