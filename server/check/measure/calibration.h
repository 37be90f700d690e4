// How fast the machine is at this moment: bare Embree rays and a sweep over memory, on the render threads,
// the same work each time. Timed beside each frame, it tells a slow program from a slow machine. Before: the
// renderer's threads. After: measure_run divides by it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/bench/calibration_rays.h"
#include "renderer/renderer.h"

namespace herr {

struct CalibrationTimes {
  double rays_ms = 0, memory_ms = 0;  // wall time
};

// Thread safety: as Renderer, which must outlive this.
class Calibration {
 public:
  explicit Calibration(Renderer& renderer);
  CalibrationTimes time();
  std::string library_versions() const { return rays_->library_versions(); }

 private:
  Renderer& renderer_;
  std::unique_ptr<CalibrationRays> rays_;
  std::vector<float> memory_, sums_;  // what is read; a sum for each job
};

}  // namespace herr
