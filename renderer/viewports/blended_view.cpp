#include "renderer/viewports/blended_view.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "renderer/simd/kernel_for.h"

namespace herr {

HERR_DECLARE_KERNEL(BlendStrip, blend_strip);

BlendStrip blend_strip_for(Isa isa) {
  return HERR_KERNEL_FOR(isa, blend_strip);
}

namespace {

constexpr int kWidestView_px = 16384;  // as a viewport's
// Of a pixel's width: what rounding alone makes two pixels overlap by is less.
constexpr double kLeastOverlap = 1e-6;

// One axis of a viewport, from the border where pixels are counted from.
struct AxisPlane {
  double begin = 0, end = 1;  // tangents
  int pixels = 1;
  double pixel() const { return (end - begin) / pixels; }
};

AxisPlane x_of(const Viewport& v) {
  return {v.tan_left, v.tan_right, v.width_px};
}
AxisPlane y_of(const Viewport& v) {  // rows from the top: tangents change their sign
  return {-v.tan_up, -v.tan_down, v.height_px};
}

bool lies_below(const Viewport& v, bool has_context) {
  return !v.focus || !has_context;
}

bool has_context(const DisplayProfile& profile, Eye eye) {
  return std::any_of(profile.viewports.begin(), profile.viewports.end(),
                     [&](const Viewport& v) { return v.eye == eye && !v.focus; });
}

// Around the lowest layers, as dense as asked for.
AxisPlane view_axis(const DisplayProfile& profile, Eye eye, Blend density,
                    AxisPlane (*axis)(const Viewport&)) {
  const bool context = has_context(profile, eye);
  AxisPlane view;
  double below = 0, all = 0;  // pixels per tangent
  bool first = true;
  for (const Viewport& v : profile.viewports) {
    if (v.eye != eye) continue;
    const AxisPlane plane = axis(v);
    all = std::max(all, 1 / plane.pixel());
    if (!lies_below(v, context)) continue;
    below = std::max(below, 1 / plane.pixel());
    view.begin = first ? plane.begin : std::min(view.begin, plane.begin);
    view.end = first ? plane.end : std::max(view.end, plane.end);
    first = false;
  }
  const double extent = view.end - view.begin;
  if (density == Blend::focus) below = std::max(below, std::min(all, kMostBlendedSide_px / extent));
  view.pixels = std::clamp(static_cast<int>(std::lround(std::min(extent * below, 1e9))), 1, kWidestView_px);
  return view;
}

// The mean over [centre - width / 2, centre + width / 2] of a row of pixels, each 1 wide.
void add_mean(double centre, double width, int pixels, std::vector<double>& overlaps, int& first) {
  const double begin = std::max(centre - width / 2, 0.0), end = std::min(centre + width / 2, double(pixels));
  overlaps.clear();
  first = 0;
  double sum = 0;
  for (int i = static_cast<int>(begin); i < pixels && i < end; ++i) {
    const double overlap = std::min(end, i + 1.0) - std::max(begin, double(i));
    if (overlap <= kLeastOverlap) continue;
    if (overlaps.empty()) first = i;
    overlaps.push_back(overlap);
    sum += overlap;
  }
  for (double& overlap : overlaps) overlap /= sum;
}

BlendAxis blend_axis(const AxisPlane& view, const AxisPlane& viewport, double blend_deg) {
  BlendAxis axis;
  const double scale = view.pixel() / viewport.pixel(), width = std::max(scale, 1.0);
  const double blend = glm::radians(blend_deg);
  const auto tangent = [&](int i) { return view.begin + (i + 0.5) * view.pixel(); };
  const auto within = [&](int i) { return tangent(i) >= viewport.begin && tangent(i) < viewport.end; };
  while (axis.begin < view.pixels && !within(axis.begin)) ++axis.begin;
  axis.end = axis.begin;
  while (axis.end < view.pixels && within(axis.end)) ++axis.end;
  axis.most = static_cast<std::size_t>(std::ceil(width)) + 1;
  std::vector<double> overlaps;
  for (int i = axis.begin; i < axis.end; ++i) {
    int first = 0;
    add_mean((tangent(i) - viewport.begin) / viewport.pixel(), width, viewport.pixels, overlaps, first);
    axis.first.push_back(first);
    axis.count.push_back(static_cast<int>(overlaps.size()));
    overlaps.resize(axis.most, 0.0);
    for (const double overlap : overlaps) axis.weights.push_back(static_cast<float>(overlap));
    const double angle = std::min(std::atan(tangent(i)) - std::atan(viewport.begin),
                                  std::atan(viewport.end) - std::atan(tangent(i)));
    axis.inside.push_back(angle >= blend ? 1.0f : static_cast<float>(angle / blend));
  }
  return axis;
}

}  // namespace

std::int64_t BlendAxis::bytes() const {
  return static_cast<std::int64_t>((first.capacity() + count.capacity()) * sizeof(int) +
                                   (weights.capacity() + inside.capacity()) * sizeof(float));
}

std::int64_t BlendedView::bytes() const {
  std::int64_t sum = 0;
  for (const BlendLayer& layer : layers) sum += layer.x.bytes() + layer.y.bytes();
  return sum;
}

std::optional<PictureOutline> blended_outline(const DisplayProfile& profile, Eye eye, Blend density) {
  const bool sees = std::any_of(profile.viewports.begin(), profile.viewports.end(),
                                [&](const Viewport& v) { return v.eye == eye; });
  if (density == Blend::off || !sees) return std::nullopt;
  const AxisPlane x = view_axis(profile, eye, density, x_of), y = view_axis(profile, eye, density, y_of);
  PictureOutline outline;
  outline.name = eye == Eye::left ? "blended-left" : "blended-right";
  outline.eye = eye;
  outline.kind = PictureKind::blended;
  outline.width_px = x.pixels;
  outline.height_px = y.pixels;
  outline.tan_left = x.begin;
  outline.tan_right = x.end;
  outline.tan_down = -y.end;
  outline.tan_up = -y.begin;
  return outline;
}

std::optional<BlendedView> blended_view(const DisplayProfile& profile, Eye eye, Blend density) {
  const std::optional<PictureOutline> outline = blended_outline(profile, eye, density);
  if (!outline) return std::nullopt;
  BlendedView view;
  view.outline = *outline;
  const AxisPlane x{outline->tan_left, outline->tan_right, outline->width_px},
      y{-outline->tan_up, -outline->tan_down, outline->height_px};
  const bool context = has_context(profile, eye);
  for (const bool below : {true, false}) {
    for (std::size_t i = 0; i < profile.viewports.size(); ++i) {
      const Viewport& v = profile.viewports[i];
      if (v.eye != eye || lies_below(v, context) != below) continue;
      const double blend_deg = below ? 0 : v.edge_blend_deg;
      view.layers.push_back({i, blend_axis(x, x_of(v), blend_deg), blend_axis(y, y_of(v), blend_deg)});
    }
  }
  return view;
}

BlendScratch::BlendScratch(int widest_view_px, std::size_t widest_row)
    : row(4 * static_cast<std::size_t>(widest_view_px) + 16), source(4 * widest_row) {}

std::int64_t BlendScratch::bytes() const {
  return static_cast<std::int64_t>(sizeof(BlendScratch) +
                                   (row.capacity() + source.capacity()) * sizeof(float));
}

}  // namespace herr
