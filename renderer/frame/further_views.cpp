// Pictures beside the headset's viewports: their list, and how a frame makes them. Before: all viewports are
// finished, and frame_ms is taken. After: RenderedFrame::further.
#include "renderer/further_view.h"

#include <algorithm>

#include "renderer/frame/renderer_impl.h"
#include "renderer/timing.h"

namespace herr {
namespace {

PictureOutline outline_of(const Viewport& v) {
  PictureOutline outline;
  outline.name = v.name;
  outline.eye = v.eye;
  outline.kind = v.focus ? PictureKind::focus : PictureKind::context;
  outline.width_px = v.width_px;
  outline.height_px = v.height_px;
  outline.tan_left = v.tan_left;
  outline.tan_right = v.tan_right;
  outline.tan_down = v.tan_down;
  outline.tan_up = v.tan_up;
  outline.edge_blend_deg = v.edge_blend_deg;
  return outline;
}

PictureOutline outline_of(const OutsideView& view) {
  const PictureCamera camera = picture_camera(view, {});
  PictureOutline outline;
  outline.name = view.name;
  outline.kind = PictureKind::outside;
  outline.width_px = view.width_px;
  outline.height_px = view.height_px;
  outline.tan_left = -camera.tan_right, outline.tan_right = camera.tan_right;
  outline.tan_down = -camera.tan_up, outline.tan_up = camera.tan_up;
  return outline;
}

}  // namespace

const char* name_of(PictureKind kind) {
  switch (kind) {
    case PictureKind::context:
      return "context";
    case PictureKind::focus:
      return "focus";
    case PictureKind::blended:
      return "blended";
    case PictureKind::outside:
      return "outside";
  }
  return "unknown";
}

std::vector<PictureOutline> further_views(const DisplayProfile& profile, const RenderSettings& settings) {
  std::vector<PictureOutline> views;
  for (const Eye eye : kEyes) {
    if (auto outline = blended_outline(profile, eye, settings.blended_view)) views.push_back(*outline);
  }
  if (settings.outside) views.push_back(outline_of(*settings.outside));
  return views;
}

std::vector<PictureOutline> pictures_of_frame(const DisplayProfile& profile, const RenderSettings& settings) {
  std::vector<PictureOutline> pictures;
  for (const Viewport& viewport : profile.viewports) pictures.push_back(outline_of(viewport));
  for (PictureOutline& view : further_views(profile, settings)) pictures.push_back(std::move(view));
  return pictures;
}

std::vector<const ViewportImage*> RenderedFrame::pictures() const {
  std::vector<const ViewportImage*> all;
  for (const ViewportImage& viewport : viewports) all.push_back(&viewport);
  for (const FurtherView& view : further) all.push_back(&view.image);
  return all;
}

void Renderer::Impl::build_further_views() {
  further = further_views(profile, settings);
  if (settings.outside) {
    outside_work =
        std::make_unique<OutsideWork>(*settings.outside, profile.viewports.size(), threads.count());
  }
  int widest_view = 1;
  for (const Eye eye : kEyes) {
    auto view = blended_view(profile, eye, settings.blended_view);
    if (!view) continue;
    widest_view = std::max(widest_view, view->outline.width_px);
    blended_views.push_back(std::move(*view));
  }
  if (blended_views.empty()) return;
  std::size_t widest_row = 1;
  for (const Viewport& v : profile.viewports) widest_row = std::max(widest_row, padded_row(v.width_px));
  for (int w = 0; w < threads.count(); ++w) blend_scratch.emplace_back(widest_view, widest_row);
}

void Renderer::Impl::set_up_further_views(RenderedFrame& out) const {
  out.further.resize(further.size());
  for (std::size_t i = 0; i < further.size(); ++i) {
    FurtherView& view = out.further[i];
    if (view.name != further[i].name) view.name = further[i].name;
    if (view.image.width_px != further[i].width_px || view.image.height_px != further[i].height_px) {
      view.image.resize(further[i].width_px, further[i].height_px);
    }
    view.image.exposure = shown_scale();
  }
}

// Blended views stand first in the list, the one from outside last.
bool Renderer::Impl::blend_views(RenderedFrame& out, const std::atomic<bool>* abandon) {
  for (std::size_t i = 0; i < blended_views.size(); ++i) {
    const BlendJob job{&blended_views[i], out.viewports, &out.further[i].image};
    const auto blend = [&](int strip, int worker) {
      blend_strip(job, strip, blend_scratch[static_cast<std::size_t>(worker)]);
    };
    if (!threads.run(blended_views[i].strips(), std::cref(blend), abandon)) return false;
  }
  return true;
}

bool Renderer::Impl::make_further_views(const FrameSample& sample, RenderedFrame& out,
                                        const std::atomic<bool>* abandon) {
  set_up_further_views(out);
  if (!blend_views(out, abandon)) return false;
  if (!outside_work) return true;
  bool whole = false;
  out.times.outside_ms = wall_ms([&] { whole = render_outside(sample, out, abandon); });
  return whole;
}

}  // namespace herr
