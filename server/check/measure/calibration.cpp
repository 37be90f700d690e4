#include "server/check/measure/calibration.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "renderer/timing.h"

namespace herr {
namespace {

constexpr int kSweepsPerThread = 4;
constexpr std::size_t kFloats = std::size_t{1} << 22;  // 16 MB: more than a core's own caches hold
constexpr int kReadsPerSweep = 49152;

// Reads in an order that no cache foresees, as rays do in a large scene.
float sweep(const std::vector<float>& memory, int job) {
  std::uint32_t at = static_cast<std::uint32_t>(job) * 0x9E3779B9u;
  float sum = 0;
  for (int i = 0; i < kReadsPerSweep; ++i) {
    at = at * 1664525u + 1013904223u;  // Numerical Recipes, chapter 7.1
    sum += memory[at >> 10];           // its upper 22 bits
  }
  return sum;
}

}  // namespace

Calibration::Calibration(Renderer& renderer)
    : renderer_(renderer),
      memory_(kFloats, 1.0f),
      sums_(static_cast<std::size_t>(kSweepsPerThread) * static_cast<std::size_t>(renderer.threads())) {
  const RenderSettings& settings = renderer.settings();
  // One job: it runs in the arena, where Embree builds.
  renderer_.parallel_for(
      1, [&](int) { rays_ = std::make_unique<CalibrationRays>(settings.isa, settings.threads); });
}

CalibrationTimes Calibration::time() {
  CalibrationTimes times;
  std::atomic<std::size_t> hits{0};
  times.rays_ms = wall_ms([&] {
    renderer_.parallel_for(rays_->jobs(),
                           [&](int job) { hits.fetch_add(rays_->trace(job), std::memory_order_relaxed); });
  });
  times.memory_ms = wall_ms([&] {
    renderer_.parallel_for(static_cast<int>(sums_.size()),
                           [&](int job) { sums_[static_cast<std::size_t>(job)] = sweep(memory_, job); });
  });
  // Looked at, so that no compiler leaves the work out.
  if (hits == 0 || sums_[0] == 0) throw std::logic_error("the calibration did nothing");
  return times;
}

}  // namespace herr
