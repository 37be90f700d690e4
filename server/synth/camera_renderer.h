// The headset's camera in a synthetic session: the room, ray-traced with our own renderer from the camera's
// pose. Before: HeadMotion. After: cam0/data/*.png.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/renderer.h"
#include "server/output/srgb_table.h"

namespace herr {

class CameraRenderer {
 public:
  // `room` must outlive this object. `threads`: 0 for all that this process may use; the picture is the same.
  CameraRenderer(const Scene& room, const CameraModel& camera, int threads);
  // RGB, 16 rays per pixel. `time_s`: since the session's start. False when a signal asked for the end
  // meanwhile; `out` is then not whole.
  bool render(const Pose& world_from_camera, double time_s, Srgb8Image& out);

 private:
  const Scene& room_;
  CameraModel camera_;
  DisplayProfile profile_;
  std::unique_ptr<Renderer> renderer_;
  RenderedFrame frame_;
  SceneState state_;
};

}  // namespace herr
