// Embree's device, and its errors as exceptions. Before: the renderer's instruction set and threads. After:
// mesh_geometry, shape_geometry and embree_scene build on it.
#pragma once

#include <atomic>
#include <cstdint>

#include "renderer/embree/embree_api.h"
#include "renderer/render_settings.h"

namespace herr {

// Throws std::bad_alloc when Embree ran out of memory, std::runtime_error with its code for any other error
// since the last call.
void check_embree(RTCDevice device);

class EmbreeDevice {
 public:
  // `isa` is resolved. The number of threads holds for the whole process (TRUST: one device at a time).
  EmbreeDevice(Isa isa, int threads);
  ~EmbreeDevice();
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  RTCDevice get() const { return device_; }
  // What Embree holds now: trees, vertices and what it needs around them.
  std::int64_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::int64_t> bytes_{0};
  RTCDevice device_ = nullptr;
};

// A scene of Embree's, released with its owner.
class EmbreeSceneHandle {
 public:
  explicit EmbreeSceneHandle(const EmbreeDevice& device);
  ~EmbreeSceneHandle();
  EmbreeSceneHandle(EmbreeSceneHandle&& other) noexcept;
  EmbreeSceneHandle& operator=(EmbreeSceneHandle&& other) noexcept;

  RTCScene get() const { return scene_; }
  // Throws as check_embree.
  void commit() const;

 private:
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace herr
