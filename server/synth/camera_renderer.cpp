#include "server/synth/camera_renderer.h"

#include <cstddef>

#include "renderer/settings_presets.h"
#include "server/process/stop_signal.h"

namespace herr {
namespace {

constexpr int kRaysPerAxis = 4;    // per pixel: smooth edges, as a lens and a sensor give them
constexpr int kLightSamples = 16;  // soft shadows with little noise, which makes for small files

// One viewport with the camera's field of view, at kRaysPerAxis times its size.
DisplayProfile profile_of(const CameraModel& camera) {
  Viewport viewport;
  viewport.name = "camera";
  viewport.width_px = camera.width_px * kRaysPerAxis;
  viewport.height_px = camera.height_px * kRaysPerAxis;
  // Pixel centres are whole numbers: the picture reaches from -0.5 to size - 0.5.
  viewport.tan_left = (-0.5 - camera.cx) / camera.fx;
  viewport.tan_right = (camera.width_px - 0.5 - camera.cx) / camera.fx;
  viewport.tan_up = (camera.cy + 0.5) / camera.fy;
  viewport.tan_down = (camera.cy - (camera.height_px - 0.5)) / camera.fy;
  DisplayProfile profile;
  profile.name = "camera";
  profile.viewports = {viewport};
  return profile;
}

RenderSettings settings_of_camera(int threads) {
  RenderSettings settings = direct_light_settings();
  settings.threads = threads;
  settings.foveation = Foveation::off;
  settings.light_samples = kLightSamples;
  settings.camera = false;
  settings.isa = Isa::sse4;  // the same bytes on every machine
  return settings;
}

}  // namespace

CameraRenderer::CameraRenderer(const Scene& room, const CameraModel& camera, int threads)
    : room_(room),
      camera_(camera),
      profile_(profile_of(camera)),
      renderer_(std::make_unique<Renderer>(room_, profile_, settings_of_camera(threads), false)) {}

bool CameraRenderer::render(const Pose& world_from_camera, double time_s, Srgb8Image& out) {
  FrameSample sample;
  sample.head.world_from_head = world_from_camera;  // the eye is the camera
  scene_state_at(room_, time_s, state_);
  if (!renderer_->render_frame(sample, state_, frame_, &stop_flag())) return false;

  // Mean of kRaysPerAxis squared rays, in linear light.
  const ViewportImage& image = frame_.viewports.front();
  out.width_px = camera_.width_px;
  out.height_px = camera_.height_px;
  out.channels = 3;
  out.values.resize(3 * static_cast<std::size_t>(out.width_px) * static_cast<std::size_t>(out.height_px));
  const Srgb8Table& table = srgb8_of_half(image.exposure);
  renderer_->parallel_for(out.height_px, [&](int y) {
    std::uint8_t* pixel =
        out.values.data() + 3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width_px);
    for (int x = 0; x < out.width_px; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (int j = 0; j < kRaysPerAxis; ++j) {
          const std::uint16_t* texel =
              image.row(y * kRaysPerAxis + j) + 4 * static_cast<std::size_t>(x * kRaysPerAxis);
          for (std::size_t i = 0; i < kRaysPerAxis; ++i) sum += float_from_half(texel[4 * i + c]);
        }
        *pixel++ = table[half_from_float(sum / (kRaysPerAxis * kRaysPerAxis))];
      }
    }
  });
  return true;
}

}  // namespace herr
