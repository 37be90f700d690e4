// One picture of a model: passes through many places of each pixel, averaged in linear light. Before: a scene
// at a time, a camera. After: exposure and the file.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/renderer.h"
#include "server/look/look_camera.h"
#include "server/output/exposure.h"

namespace herr {

// The model alone (premultiplied, alpha its coverage), and what lies behind it.
struct Look {
  LightPicture model;
  LightPicture background;  // empty: none is wanted
};

// Renders a scene that stands still from several sides. Not thread-safe.
class LookRenderer {
 public:
  // `scene` outlives it, with lights as many as any picture has.
  LookRenderer(const Scene& scene, const LookOptions& options, const LookCamera& first);

  // False: a signal asked for the end.
  bool render(const LookCamera& camera, const SceneState& state, Look& look);

 private:
  bool render_background(const FrameSample& sample, LightPicture& out);

  const Scene& scene_;
  const LookOptions& options_;
  DisplayProfile profile_;
  std::unique_ptr<Renderer> renderer_;
  RenderedFrame frame_;
  // For a picture of the environment: the same outside, with nothing in it.
  Scene outside_;
  std::unique_ptr<Renderer> outside_renderer_;
};

// The model over its background, if it has one; then every alpha is 1.
LightPicture composed(const Look& look);
// One byte for each pixel that the model covers at least half of.
std::vector<std::uint8_t> covered(const LightPicture& model);

}  // namespace herr
