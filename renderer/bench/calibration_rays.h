// A yardstick for the speed of a machine: the same rays into the same 20,000 triangles, for ever. It shares
// no code with what it is held against: whatever makes the renderer faster or slower leaves it as it is. A
// change here makes earlier measurements incomparable and raises kCalibrationVersion. Before: the renderer's
// threads. After: server/check divides the time of each frame by that of these rays.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderer/embree/embree_device.h"
#include "renderer/render_settings.h"

namespace herr {

inline constexpr int kCalibrationVersion = 1;

class CalibrationRays {
 public:
  // Construct inside the arena of the render threads (Embree builds there). `isa` is
  // resolved. Throws as EmbreeDevice.
  CalibrationRays(Isa isa, int threads);

  // About a fifth of a millisecond each; as much work for every thread, however many there are.
  int jobs() const { return jobs_; }
  // Traces the rays of one job; returns how many hit. Thread-safe.
  std::size_t trace(int job) const;

  // "Embree 3.13.5, oneTBB 2021.8": what runs, not what was compiled against.
  std::string library_versions() const;

 private:
  Isa isa_;
  int jobs_;
  EmbreeDevice device_;
  EmbreeSceneHandle scene_;
};

}  // namespace herr
