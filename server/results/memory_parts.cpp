#include "server/results/memory_parts.h"

#include <string>

#include "scenes/model/scene_memory.h"

namespace herr {
namespace {

constexpr const char *kFrames = "frame pictures", *kCamera = "camera pictures",
                     *kEncoders = "encoder buffers";

void set_part(const char* name, std::int64_t bytes, MemoryUse& parts) {
  for (MemoryEntry& part : parts) {
    if (part.name != name) continue;
    part.bytes = bytes;
    return;
  }
  parts.push_back({name, bytes});
}

}  // namespace

std::int64_t frame_bytes(const RenderedFrame& frame) {
  std::int64_t sum = 0;
  for (const ViewportImage& viewport : frame.viewports) sum += bytes_of(viewport.rgba_half);
  for (const FurtherView& view : frame.further) sum += bytes_of(view.image.rgba_half);
  return sum;
}

std::int64_t camera_bytes(const FrameSample& sample) {
  std::int64_t sum = 0;
  const CameraImage* counted = nullptr;
  for (const auto& camera : sample.cameras) {
    if (!camera || camera->image.get() == counted) continue;
    counted = camera->image.get();
    sum += bytes_of(counted->rgba_half);
  }
  return sum;
}

MemoryUse memory_parts(const Renderer& renderer, const Scene& scene, const PictureMemory& pictures) {
  MemoryUse parts = renderer.memory();
  const SceneMemory loaded = memory_of(scene);
  parts.insert(parts.end(), {{"loaded meshes", loaded.meshes},
                             {"loaded textures", loaded.textures},
                             {"loaded voxels", loaded.voxels},
                             {"loaded environment", loaded.environment},
                             {"loaded objects", loaded.objects}});
  set_pictures(pictures, parts);
  return parts;
}

void set_pictures(const PictureMemory& pictures, MemoryUse& parts) {
  set_part(kFrames, pictures.frames, parts);
  set_part(kCamera, pictures.camera, parts);
  set_encoder_bytes(pictures.encoders, parts);
}

void set_encoder_bytes(std::int64_t bytes, MemoryUse& parts) {
  set_part(kEncoders, bytes, parts);
}

}  // namespace herr
