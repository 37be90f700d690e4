// The picture of an outside camera: uniform rays through the tile kernels of this frame, with its lights,
// probes and plan, then the headset drawn in. It changes nothing that a later frame depends on.
// Before: the frame's own viewports are whole. After: the server writes it beside them.
#include <algorithm>
#include <cmath>
#include <functional>

#include "renderer/frame/renderer_impl.h"
#include "renderer/outside/outside_work.h"
#include "renderer/probes/probe_distances.h"

namespace herr {
namespace {

constexpr int kRowsOfJob = 16;

double gaze_length_m(RTCScene scene, const EyeView& eye, std::vector<float>& distance) {
  const glm::vec3 direction(eye.anchored_from_eye.orientation * eye.gaze.gaze);
  trace_distances(scene, eye.anchored_from_eye.position, kAllMask, std::span(&direction, 1), distance);
  return std::isfinite(distance.front()) ? double{distance.front()} : kEndlessGaze_m;
}

}  // namespace

void Renderer::Impl::paint_see_through(const ShownColour& colour, ShadingInputs& inputs) const {
  const glm::vec3 radiance = radiance_of(colour, 1.0f / shown_scale());
  for (int c = 0; c < 3; ++c) inputs.see_through[c] = radiance[c];
}

// Misses show the environment, catchers the see-through colour: no feed was taken from here.
void Renderer::Impl::set_up_outside(const FrameSample& sample, const Pose& anchored_from_camera) {
  OutsideWork& work = *outside_work;
  EyeView camera;
  camera.anchored_from_eye = anchored_from_camera;
  set_planar_grid(camera, work.plane, 1.0, work.buffer,
                  outside_key(sample.t_ns - sample.start_ns, settings.seed), work.grid);
  work.grid.ray_width = static_cast<float>(settings.ray_width);
  work.shading = shading;
  work.shading.debug_tiles = work.shading.paints_see_through = false;
  work.shading.background_is_environment = work.shading.paints_catchers = true;
  work.shading.largest_ratio = kLargestRatio;
  const ShownColour usual = settings.see_through_colour.value_or(kPink);
  paint_see_through(work.view.see_through.value_or(usual), work.shading);
  std::fill(work.counters.begin(), work.counters.end(), TileCounters{});
}

void Renderer::Impl::set_up_overlay(const FrameSample& sample, const PictureCamera& camera) {
  OutsideWork& work = *outside_work;
  OverlaySubject subject;
  subject.anchored_from_head = scene.world_from_session * sample.head.world_from_head;
  subject.anchored_from_head.position -= geometry->anchor();
  subject.eyes = eyes;
  subject.viewports = profile.viewports;
  subject.frusta_m = work.view.frusta_m;
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    subject.gaze_m[e] = gaze_length_m(geometry->top(), eyes[e], work.gaze_distance);
  }
  overlay_lines(subject, work.lines);
  work.screen_lines.clear();
  for (const OverlayLine& line : work.lines) {
    if (const auto shown = screen_line(camera, line)) work.screen_lines.push_back(*shown);
  }
}

bool Renderer::Impl::render_outside(const FrameSample& sample, RenderedFrame& out,
                                    const std::atomic<bool>* abandon) {
  OutsideWork& work = *outside_work;
  const OutsideView& view = work.view;
  Pose camera_pose = view.space_from_camera;
  if (view.space == OutsideSpace::session) camera_pose = scene.world_from_session * camera_pose;
  camera_pose.position -= geometry->anchor();
  set_up_outside(sample, camera_pose);
  const int tiles_x = (work.plane.width_px + kTileSide - 1) / kTileSide,
            tiles_y = (work.plane.height_px + kTileSide - 1) / kTileSide;
  const auto trace = [&](int tile, int worker) {
    const auto w = static_cast<std::size_t>(worker);
    trace_tile({&work.grid, &work.shading, tile % tiles_x * kTileSide, tile / tiles_x * kTileSide,
                tile_scratch[w].get(), &work.counters[w], &work.cycles[w], nullptr});
  };
  if (!threads.run(tiles_x * tiles_y, std::cref(trace), abandon)) return false;

  ViewportImage& picture = out.further.back().image;
  const PictureCamera camera = picture_camera(view, camera_pose);
  work.screen_lines.clear();
  if (view.overlay) set_up_overlay(sample, camera);
  const auto finish = [&](int job, int worker) {
    const int y0 = job * kRowsOfJob, y1 = std::min(y0 + kRowsOfJob, picture.height_px);
    average_rays(work, y0, y1, picture);
    draw_lines(camera, geometry->top(), work.screen_lines, y0, y1,
               work.line_scratch[static_cast<std::size_t>(worker)], picture);
  };
  const int jobs = (picture.height_px + kRowsOfJob - 1) / kRowsOfJob;
  if (!threads.run(jobs, std::cref(finish), abandon)) return false;
  // Its rays are not the frame's, but nothing that is not finite goes unsaid.
  for (const TileCounters& worker : work.counters) out.counters.nonfinite_values += worker.nonfinite_values;
  return true;
}

}  // namespace herr
