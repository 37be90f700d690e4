#include "renderer/embree/embree_device.h"

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace herr {
namespace {

const char* embree_isa(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return "avx512";
    case Isa::avx2:
      return "avx2";
    default:
      return "sse4.2";
  }
}

// Called by Embree from any thread: more bytes, or fewer.
bool count_bytes(void* sum, ssize_t change, bool /*already_done*/) {
  static_cast<std::atomic<std::int64_t>*>(sum)->fetch_add(change, std::memory_order_relaxed);
  return true;
}

}  // namespace

void check_embree(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error("Embree reports error " + std::to_string(static_cast<int>(error)));
}

EmbreeDevice::EmbreeDevice(Isa isa, int threads) {
  const std::string config = "threads=" + std::to_string(threads) + ",isa=" + embree_isa(isa);
  device_ = rtcNewDevice(config.c_str());
  if (!device_) {
    check_embree(nullptr);
    throw std::runtime_error("Embree cannot start with '" + config + "'");
  }
  rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
}

EmbreeDevice::~EmbreeDevice() {
  rtcReleaseDevice(device_);
}

EmbreeSceneHandle::EmbreeSceneHandle(const EmbreeDevice& device)
    : device_(device.get()), scene_(rtcNewScene(device.get())) {
  if (!scene_) check_embree(device_);
}

EmbreeSceneHandle::~EmbreeSceneHandle() {
  if (scene_) rtcReleaseScene(scene_);
}

EmbreeSceneHandle::EmbreeSceneHandle(EmbreeSceneHandle&& other) noexcept
    : device_(other.device_), scene_(std::exchange(other.scene_, nullptr)) {}

EmbreeSceneHandle& EmbreeSceneHandle::operator=(EmbreeSceneHandle&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(scene_, other.scene_);
  return *this;
}

void EmbreeSceneHandle::commit() const {
  rtcCommitScene(scene_);
  check_embree(device_);
}

}  // namespace herr
