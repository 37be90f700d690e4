#include "server/look/look_picture.h"

#include <algorithm>
#include <cmath>

#include "server/frames/resting_probes.h"
#include "server/process/stop_signal.h"

namespace herr {
namespace {

RenderSettings settings_of_look(const LookOptions& options) {
  RenderSettings settings = options.render;
  settings.foveation = Foveation::off;
  settings.scale = 1;
  settings.camera = false;  // what lies behind comes later: the exposure is that of the model
  return settings;
}

FrameSample sample_of(const Scene& scene, const LookCamera& camera, double time_s) {
  FrameSample sample;
  sample.t_ns = static_cast<TimeNs>(std::llround(time_s * 1e9));
  sample.head.world_from_head = inverse(scene.world_from_session) * camera.world_from_camera;
  return sample;
}

void add(const ViewportImage& image, float share, LightPicture& sum) {
  float* out = sum.rgba.data();
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint16_t* texel = image.row(y);
    const std::uint16_t* end = texel + 4 * image.width_px;
    for (; texel < end; ++texel, ++out) *out += share * float_from_half(*texel);
  }
}

// The mean of `count` passes.
bool average(Renderer& renderer, const FrameSample& sample, const SceneState& state, int count,
             RenderedFrame& frame, LightPicture& mean) {
  mean.rgba.assign(4 * mean.pixels(), 0.0f);
  for (int i = 0; i < count; ++i) {
    if (stop_signal() != 0) return false;
    PixelPass pass;
    pass.seed = renderer.settings().seed + static_cast<std::uint32_t>(i);
    pass.jitter = true;
    pass.index = i;
    renderer.render_pass(sample, state, pass, frame);
    add(frame.viewports.front(), 1.0f / static_cast<float>(count), mean);
  }
  return true;
}

}  // namespace

LookRenderer::LookRenderer(const Scene& scene, const LookOptions& options, const LookCamera& first)
    : scene_(scene),
      options_(options),
      profile_(first.profile),
      renderer_(std::make_unique<Renderer>(scene, profile_, settings_of_look(options), false)) {
  if (!options.background || scene.environment_map.rgba.empty()) return;
  outside_.environment_map = scene.environment_map;
  RenderSettings settings = settings_of_look(options);
  settings.camera = true;  // and none is there: the environment is drawn
  settings.probes.on = false;
  outside_renderer_ = std::make_unique<Renderer>(outside_, profile_, settings, false);
}

bool LookRenderer::render(const LookCamera& camera, const SceneState& state, Look& look) {
  const FrameSample sample = sample_of(scene_, camera, options_.time_s);
  let_probes_rest(*renderer_, sample, state, profile_.display_hz);
  look.model.width_px = options_.width_px;
  look.model.height_px = options_.height_px;
  look.background = {};
  if (!average(*renderer_, sample, state, options_.samples, frame_, look.model)) return false;
  return !options_.background || render_background(sample, look.background);
}

bool LookRenderer::render_background(const FrameSample& sample, LightPicture& out) {
  out.width_px = options_.width_px;
  out.height_px = options_.height_px;
  if (outside_renderer_) {
    RenderedFrame frame;
    FrameSample outside = sample;
    outside.head.world_from_head = scene_.world_from_session * sample.head.world_from_head;
    return average(*outside_renderer_, outside, SceneState(), 1, frame, out);
  }
  out.rgba.reserve(4 * out.pixels());
  for (std::size_t i = 0; i < out.pixels(); ++i)
    out.rgba.insert(out.rgba.end(), {scene_.environment.x, scene_.environment.y, scene_.environment.z, 1.0f});
  return true;
}

LightPicture composed(const Look& look) {
  LightPicture picture = look.model;
  if (look.background.rgba.empty()) return picture;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    const float left = 1.0f - picture.rgba[i + 3];
    for (std::size_t c = 0; c < 4; ++c) picture.rgba[i + c] += left * look.background.rgba[i + c];
  }
  return picture;
}

std::vector<std::uint8_t> covered(const LightPicture& model) {
  std::vector<std::uint8_t> covers(model.pixels());
  for (std::size_t i = 0; i < covers.size(); ++i) covers[i] = model.rgba[4 * i + 3] >= 0.5f ? 1 : 0;
  return covers;
}

}  // namespace herr
