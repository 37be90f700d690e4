// What a run holds in memory, part by part: the renderer, the scene as it was loaded, and pictures. What is
// left of the process's own resident memory is the program with its libraries, statistics and streams.
// Before: renderer, scene and who has pictures. After: memory_bytes of summary.json, bench and HTTP.
#pragma once

#include <cstdint>

#include "renderer/renderer.h"
#include "scenes/model/scene.h"

namespace herr {

struct PictureMemory {
  std::int64_t frames = 0;    // viewports and further views, half floats
  std::int64_t camera = 0;    // decoded images of the feed
  std::int64_t encoders = 0;  // 8-bit copies, and files that wait to be written or asked for
};

std::int64_t frame_bytes(const RenderedFrame& frame);
// Images that both eyes see count once.
std::int64_t camera_bytes(const FrameSample& sample);

// The renderer's parts, then those of scene and pictures; no name twice.
MemoryUse memory_parts(const Renderer& renderer, const Scene& scene, const PictureMemory& pictures);
// The same with other pictures, in place.
void set_pictures(const PictureMemory& pictures, MemoryUse& parts);
void set_encoder_bytes(std::int64_t bytes, MemoryUse& parts);

}  // namespace herr
