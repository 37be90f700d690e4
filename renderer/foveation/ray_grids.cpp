#include "renderer/foveation/ray_grids.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

void store(float (&out)[3], const glm::dvec3& v) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = static_cast<float>(v[axis]);
}

bool contains(const Viewport& outer, const Viewport& inner) {
  return outer.tan_left <= inner.tan_left && outer.tan_right >= inner.tan_right &&
         outer.tan_down <= inner.tan_down && outer.tan_up >= inner.tan_up;
}

// The angle between pixels, or rays, in the middle of a viewport, as if they were square.
double spacing_rad(const Viewport& v, int columns, int rows) {
  return std::sqrt((v.tan_right - v.tan_left) / columns * (v.tan_up - v.tan_down) / rows);
}

// A viewport that lies within another of the same eye adds nothing to what the eye can see. Of
// equal ones the first counts.
bool is_covered(std::span<const Viewport> viewports, std::size_t index) {
  for (std::size_t other = 0; other < viewports.size(); ++other) {
    if (other == index || viewports[other].eye != viewports[index].eye) continue;
    if (!contains(viewports[other], viewports[index])) continue;
    if (!contains(viewports[index], viewports[other]) || other < index) return true;
  }
  return false;
}

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;  // odd: seeds stay apart, and 0 changes nothing

// The finaliser of MurmurHash3.
std::uint32_t mixed(std::uint64_t h) {
  h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdULL;
  h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return static_cast<std::uint32_t>(h ^ (h >> 33));
}

}  // namespace

std::uint32_t frame_key(TimeNs since_start_ns, int eye, std::uint32_t seed) {
  return mixed(static_cast<std::uint64_t>(since_start_ns) * 2 + static_cast<std::uint64_t>(eye) +
               seed * kGolden);
}

std::uint32_t outside_key(TimeNs since_start_ns, std::uint32_t seed) {
  return mixed(~(static_cast<std::uint64_t>(since_start_ns) * 2 + seed * kGolden));
}

void set_polar_grid(const EyeView& view, std::span<const Viewport> viewports, Eye eye,
                    const PolarSamples& samples, RadianceBuffer& buffer, std::uint32_t key, RayGrid& grid) {
  const glm::dquat& turn = view.anchored_from_eye.orientation;
  grid.polar = true;
  store(grid.origin, view.anchored_from_eye.position);
  store(grid.right, turn * view.gaze.right);
  store(grid.up, turn * view.gaze.up);
  store(grid.gaze, turn * view.gaze.gaze);
  grid.samples = &samples;
  grid.frustum_count = 0;
  double finest_rad = 1;
  for (const Viewport& viewport : viewports) {
    if (viewport.eye != eye) continue;
    finest_rad = std::min(finest_rad, spacing_rad(viewport, viewport.width_px, viewport.height_px));
  }
  grid.finest_pixel_rad = static_cast<float>(finest_rad);
  for (std::size_t i = 0; i < viewports.size(); ++i) {
    if (viewports[i].eye != eye || is_covered(viewports, i)) continue;
    const FrustumPlanes planes = frustum_planes(viewports[i]);
    FrustumNormals& normals = grid.frusta[static_cast<std::size_t>(grid.frustum_count++)];
    for (int side = 0; side < 4; ++side) store(normals.normal[side], turn * planes.normal[side]);
  }
  grid.sink = {buffer.texels(), buffer.ratios(),  buffer.row_stride(),
               samples.width(), samples.height(), true};
  grid.key = key;
}

int rays_along(int pixels, double scale) {
  constexpr double kRounding = 1e-9;  // 0.1 * 30 is a little more than 3
  return std::max(1, static_cast<int>(std::ceil(scale * pixels - kRounding)));
}

void set_planar_grid(const EyeView& view, const Viewport& v, double scale, RadianceBuffer& buffer,
                     std::uint32_t key, RayGrid& grid) {
  const int columns = rays_along(v.width_px, scale), rows = rays_along(v.height_px, scale);
  const glm::dquat& turn = view.anchored_from_eye.orientation;
  grid.polar = false;
  store(grid.origin, view.anchored_from_eye.position);
  store(grid.right, turn * glm::dvec3{1, 0, 0});
  store(grid.up, turn * glm::dvec3{0, 1, 0});
  store(grid.gaze, turn * glm::dvec3{0, 0, -1});
  grid.tan_left = static_cast<float>(v.tan_left);
  grid.tan_up = static_cast<float>(v.tan_up);
  grid.finest_pixel_rad = static_cast<float>(spacing_rad(v, columns, rows));
  grid.step_x = static_cast<float>((v.tan_right - v.tan_left) / columns);
  grid.step_y = static_cast<float>((v.tan_up - v.tan_down) / rows);
  grid.sink = {buffer.texels(), buffer.ratios(), buffer.row_stride(), columns, rows, false};
  grid.key = key;
}

void set_jitter(const PixelPass& pass, int viewport, RayGrid& grid) {
  // The R2 sequence: multiples of 1/g and 1/g^2, g^3 = g + 1.
  constexpr double kStepX = 0.75487766624669276, kStepY = 0.56984029099805327;
  const auto place = [&](double step) {
    const double at = 0.5 + step * pass.index;
    return static_cast<float>(at - std::floor(at));
  };
  grid.jitter = true;
  grid.jitter_x = place(kStepX);
  grid.jitter_y = place(kStepY);
  grid.jitter_key = mixed(static_cast<std::uint64_t>(viewport) + pass.sequence * kGolden);
}

}  // namespace herr
