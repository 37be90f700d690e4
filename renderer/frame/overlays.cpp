// What is drawn into the finished viewports of a frame: lines of sample density, the gaze marker. Before: the
// composite. After: the frame is whole.
#include <algorithm>
#include <chrono>

#include "renderer/frame/renderer_impl.h"
#include "renderer/viewports/density_overlay.h"
#include "renderer/viewports/gaze_marker.h"

namespace herr {

bool Renderer::Impl::draw_overlays(RenderedFrame& out, const std::atomic<bool>* abandon) {
  if (plan.density_overlay && !draw_density(out, abandon)) return false;
  if (!plan.gaze_marker) return true;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < profile.viewports.size(); ++i) {
    const auto eye = static_cast<std::size_t>(profile.viewports[i].eye);
    draw_gaze_marker(profile.viewports[i], eyes[eye].gaze.gaze, out.viewports[i]);
  }
  out.times[Stage::overlays] +=
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return true;
}

// Density beneath degrees; of each first the lines, in strips, then the numbers.
bool Renderer::Impl::draw_density(RenderedFrame& out, const std::atomic<bool>* abandon) {
  const PhaseClock clock(cycles);
  const auto circles_of = [this](std::size_t viewport, OverlayLineKind kind) {
    const auto eye = static_cast<std::size_t>(profile.viewports[viewport].eye);
    if (kind == OverlayLineKind::degrees) return degree_circles(eyes[eye].gaze);
    if (!plan.polar) {
      const auto& sink = grids[viewport].sink;
      return density_circles(profile.viewports[viewport], sink.width, sink.height);
    }
    const PolarSamples& polar = *samples[eye];
    return density_circles(eyes[eye].gaze, polar.map(), polar.width(), polar.height());
  };
  const auto draw_lines_of = [&](int job, int worker) {
    cycles[static_cast<std::size_t>(worker)].start();
    const auto viewport = static_cast<std::size_t>(
        std::upper_bound(first_strip.begin(), first_strip.end(), job) - first_strip.begin() - 1);
    const Viewport& seen = profile.viewports[viewport];
    const int y0 = (job - first_strip[viewport]) * kStripRows;
    for (const OverlayLineKind kind : {OverlayLineKind::density, OverlayLineKind::degrees}) {
      draw_overlay_lines(seen, circles_of(viewport, kind), y0, std::min(y0 + kStripRows, seen.height_px),
                         out.viewports[viewport]);
    }
    cycles[static_cast<std::size_t>(worker)].lap(Stage::overlays);
  };
  const bool whole = threads.run(first_strip.back(), std::cref(draw_lines_of), abandon);
  if (whole) {
    cycles[0].start();
    for (std::size_t i = 0; i < profile.viewports.size(); ++i) {
      for (const OverlayLineKind kind : {OverlayLineKind::density, OverlayLineKind::degrees})
        draw_overlay_numbers(profile.viewports[i], circles_of(i, kind), out.viewports[i]);
    }
    cycles[0].lap(Stage::overlays);
  }
  clock.finish(out.times);
  return whole;
}

}  // namespace herr
