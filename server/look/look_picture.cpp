#include "server/look/look_picture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "server/frames/resting_probes.h"
#include "server/output/srgb_table.h"
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

// Adds what `frame` shows to sums of `image`'s size.
void add(const ViewportImage& image, std::vector<float>& sum) {
  float* out = sum.data();
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint16_t* texel = image.row(y);
    const std::uint16_t* end = texel + 4 * image.width_px;
    for (; texel < end; ++texel, ++out) *out += float_from_half(*texel);
  }
}

// The mean of `count` passes. False: a signal asked for the end.
bool average(Renderer& renderer, const FrameSample& sample, const SceneState& state, int count,
             ViewportImage& mean) {
  RenderedFrame frame;
  std::vector<float> sum;
  for (int i = 0; i < count; ++i) {
    if (stop_signal() != 0) return false;
    PixelPass pass;
    pass.seed = renderer.settings().seed + static_cast<std::uint32_t>(i);
    pass.jitter = count > 1;  // one ray goes through the middle
    pass.index = i;
    renderer.render_pass(sample, state, pass, frame);
    if (count == 1) break;
    const ViewportImage& image = frame.viewports.front();
    sum.resize(4 * static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px));
    add(image, sum);
  }
  mean = std::move(frame.viewports.front());
  if (count == 1) return true;
  const float share = 1.0f / static_cast<float>(count);
  const float* from = sum.data();
  for (int y = 0; y < mean.height_px; ++y) {
    std::uint16_t* texel = mean.row(y);
    for (std::uint16_t* end = texel + 4 * mean.width_px; texel < end; ++texel)
      *texel = half_from_float(share * *from++);
  }
  return true;
}

// Puts the light of `behind(x, y)` where the model leaves it; every alpha is 1 then.
template <typename Behind>
void put_behind(ViewportImage& picture, const Behind& behind) {
  const std::uint16_t one = half_from_float(1.0f);
  for (int y = 0; y < picture.height_px; ++y) {
    std::uint16_t* texel = picture.row(y);
    for (int x = 0; x < picture.width_px; ++x, texel += 4) {
      if (texel[3] == one) continue;
      const float left = 1.0f - float_from_half(texel[3]);
      const glm::vec3 light = behind(x, y);
      for (std::size_t c = 0; c < 3; ++c)
        texel[c] = half_from_float(float_from_half(texel[c]) + left * light[static_cast<int>(c)]);
      texel[3] = one;
    }
  }
}

}  // namespace

LookRenderer::LookRenderer(const Scene& scene, const LookOptions& options, const LookCamera& first)
    : scene_(scene),
      options_(options),
      profile_(first.profile),
      renderer_(std::make_unique<Renderer>(scene, profile_, settings_of_look(options), false)) {}

FrameSample LookRenderer::sample(const LookCamera& camera) const {
  FrameSample sample;
  sample.t_ns = static_cast<TimeNs>(std::llround(options_.time_s * 1e9));
  sample.head.world_from_head = inverse(scene_.world_from_session) * camera.world_from_camera;
  return sample;
}

bool LookRenderer::render(const LookCamera& camera, const SceneState& state,
                          const std::optional<glm::vec3>& backdrop, Look& look) {
  const FrameSample at = sample(camera);
  let_probes_rest(*renderer_, at, state, profile_.display_hz);
  if (!average(*renderer_, at, state, options_.samples, look.model)) return false;
  look.picture = look.model;
  if (!options_.background) return true;
  if (!backdrop && !scene_.environment_map.rgba.empty()) {
    ViewportImage outside;
    if (!render_outside(at, outside)) return false;
    put_behind(look.picture, [&](int x, int y) {
      const std::uint16_t* texel = outside.row(y) + 4 * x;
      return glm::vec3(float_from_half(texel[0]), float_from_half(texel[1]), float_from_half(texel[2]));
    });
    return true;
  }
  put_behind(look.picture, [light = backdrop.value_or(scene_.environment)](int, int) { return light; });
  return true;
}

bool LookRenderer::render_outside(const FrameSample& sample, ViewportImage& out) {
  if (!outside_renderer_) {
    outside_.environment_map = scene_.environment_map;
    outside_.world_from_session = scene_.world_from_session;
    RenderSettings settings = settings_of_look(options_);
    settings.camera = true;  // and none is there: the environment is drawn
    settings.probes.on = false;
    outside_renderer_ = std::make_unique<Renderer>(outside_, profile_, settings, false);
  }
  return average(*outside_renderer_, sample, SceneState(), 1, out);
}

}  // namespace herr
