// Whether the values of a stream were measured row by row, or made up between rarer ones: exact straight
// lines between every n-th row (a resampled log), and steps so smooth that no sensor writes them (a low-pass
// filter). Rows that repeat the one before are passed over here: StreamSummary counts them. Constant memory.
// Before: the velocity at each row of a stream, in any unit. After: plausibility.h, which judges.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "sessions/format/pose.h"

namespace herr {

class StreamSteadiness {
 public:
  // `velocity` from the row before to this one, `interval_ns` later. Zero: the row repeats the one before.
  void add(const glm::dvec3& velocity, TimeNs interval_ns);

  // Where the rows lie on straight lines between every n-th row: how many such rows a second; else none.
  // A line ends where the velocity changes; the lines must be alike, within one row, at least 12 of them, and
  // hold 40 % of the rows. Velocities of a head that moves freely differ by 1e-2 and more of their size even
  // at 1 kHz.
  std::optional<double> knots_hz() const;

 private:
  static constexpr std::size_t kLongest = 256;
  std::optional<glm::dvec3> last_;
  std::int64_t straight_ = 0, bends_ = 0, run_ = 0, runs_ = 0;
  bool inside_ = false;  // a line whose beginning was seen
  TimeNs span_ns_ = 0;   // of the rows that could be judged
  std::array<std::int32_t, kLongest> runs_of_{};
};

}  // namespace herr
