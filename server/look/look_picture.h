// One picture of a model: passes through many places of each pixel, averaged in linear light. Before: a scene
// at a time, a camera. After: exposure and the file.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "renderer/renderer.h"
#include "server/look/look_camera.h"

namespace herr {

// The model alone (its alpha is its coverage), and with what lies behind it.
struct Look {
  ViewportImage model, picture;  // the same where no background is wanted
};

// Renders a scene that stands still from several sides. Not thread-safe.
class LookRenderer {
 public:
  // `scene` outlives it, with lights as many as any picture has.
  LookRenderer(const Scene& scene, const LookOptions& options, const LookCamera& first);

  // `backdrop`: radiance behind the model in place of the environment; none: the environment.
  // False: a signal asked for the end.
  bool render(const LookCamera& camera, const SceneState& state, const std::optional<glm::vec3>& backdrop,
              Look& look);
  // Of the camera's frame, for metadata.
  FrameSample sample(const LookCamera& camera) const;
  Renderer& renderer() { return *renderer_; }
  const Scene& scene() const { return scene_; }

 private:
  bool render_outside(const FrameSample& sample, ViewportImage& out);

  const Scene& scene_;
  const LookOptions& options_;
  DisplayProfile profile_;
  std::unique_ptr<Renderer> renderer_;
  // For a picture of the environment: the same outside, with nothing in it.
  Scene outside_;
  std::unique_ptr<Renderer> outside_renderer_;
};

}  // namespace herr
