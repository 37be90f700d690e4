// Whether the eyes stop as abruptly as eyes do. A jump of the eyes (saccade) of 20 to 60 ms ends within a row
// or two of a 60-150 Hz log; a low-pass filter lets it fade out over many. Constant memory. Before: the
// velocity at each gaze row. After: plausibility.h, which judges.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "sessions/format/pose.h"

namespace herr {

class GazeJumps {
 public:
  // Of the unit direction, per second, from the row before to this one, `interval_ns` later.
  void add(const glm::dvec3& velocity, TimeNs interval_ns);

  // Of the steps at 100 degrees a second or more between rows 6 to 25 ms apart, those after which the eyes
  // have less than 0.4 of that speed; none where there were fewer than 60 such steps. Rows that repeat the
  // one before are passed over.
  std::optional<double> stop_share() const;

  // Beyond doubt fewer than 6 %, where 20 to 50 % are usual, and 8 % where the head turns or the eyes pursue
  // fast.
  bool dulled() const;

 private:
  std::optional<double> last_speed_;
  std::int64_t fast_ = 0, stops_ = 0;
};

}  // namespace herr
