#include "renderer/outside/outside_work.h"

#include <array>

#include "renderer/outside/half_values.h"
#include "sessions/camera/half_from_samples.h"

namespace herr {

OutsideWork::OutsideWork(const OutsideView& asked, std::size_t viewports, int workers) : view(asked) {
  const PictureCamera camera = picture_camera(view, {});
  plane.name = view.name;
  plane.width_px = view.width_px * view.samples;
  plane.height_px = view.height_px * view.samples;
  plane.tan_right = camera.tan_right, plane.tan_left = -camera.tan_right;
  plane.tan_up = camera.tan_up, plane.tan_down = -camera.tan_up;
  buffer.allocate(padded_columns(plane.width_px), padded_rows(plane.height_px), false);
  lines.reserve(most_overlay_lines(viewports));
  screen_lines.reserve(most_overlay_lines(viewports));
  gaze_distance.reserve(1);
  counters.resize(static_cast<std::size_t>(workers));
  cycles.resize(static_cast<std::size_t>(workers));
  line_scratch.assign(static_cast<std::size_t>(workers), LineScratch(view.width_px));
  for (LineScratch& scratch : line_scratch) scratch = LineScratch(view.width_px);  // a copy reserves nothing
}

std::int64_t OutsideWork::bytes() const {
  std::size_t bytes = sizeof(OutsideWork) + lines.capacity() * sizeof(OverlayLine) +
                      screen_lines.capacity() * sizeof(ScreenLine) + counters.size() * sizeof(TileCounters) +
                      cycles.size() * sizeof(StageCycles);
  for (const LineScratch& scratch : line_scratch) {
    bytes += scratch.touched.capacity() * sizeof(LineScratch::Touched) +
             scratch.directions.capacity() * sizeof(glm::vec3) + scratch.distances.capacity() * sizeof(float);
  }
  return static_cast<std::int64_t>(bytes) + buffer.bytes();
}

void average_rays(const OutsideWork& work, int y0, int y1, ViewportImage& out) {
  const int samples = work.view.samples;
  const float share = 1.0f / static_cast<float>(samples * samples);
  const std::size_t stride = work.buffer.row_stride();
  std::int64_t sanitised = 0;  // texels are finite
  for (int y = y0; y < y1; ++y) {
    for (int x = 0; x < out.width_px; ++x) {
      std::array<float, 3> sum{};
      for (int row = y * samples; row < (y + 1) * samples; ++row) {
        const std::uint16_t* texel = work.buffer.texels() + 4 * texel_index(stride, x * samples, row);
        for (int i = 0; i < samples; ++i, texel += 4) {
          for (std::size_t c = 0; c < 3; ++c) sum[c] += value_of_half(texel[c]);
        }
      }
      std::uint16_t* pixel = out.row(y) + 4 * x;
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = half_from_linear(share * sum[c], sanitised);
      pixel[3] = kHalfOne;
    }
  }
}

}  // namespace herr
