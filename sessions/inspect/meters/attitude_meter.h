// Which way a head is up, where it looks, whether it moves at all and goes the way it looks. Constant memory.
// Before: pose rows in order. After: plausibility.h, which judges.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "sessions/inspect/meters/linear_histogram.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

class AttitudeMeter {
 public:
  void add(const PoseRow& row);

  std::int64_t rows() const { return rows_; }
  bool turns() const { return turns_; }  // at all, to the last digit; q and -q are one orientation
  bool moves() const { return moves_; }

  // Shares of all rows, 0 to 1; 0 without rows.
  double level_share() const { return share(level_); }        // up within kLevelDeg of the world's
  double upside_share() const { return share(upside_); }      // up within kLevelDeg of straight down
  double looks_up_share() const { return share(looks_up_); }  // pitch above kLevelDeg
  double looks_down_share() const { return share(looks_down_); }
  double side_share() const { return share(side_); }  // none of these: an ear is up
  static constexpr double kLevelDeg = 60;

  // Of rows at least 4 ms apart.
  const LinearHistogram& tilt_deg() const { return tilt_deg_; }  // between the head's up and the world's
  // Absolute; of the rows that look neither straight up nor straight down, where roll means something.
  const LinearHistogram& roll_deg() const { return roll_deg_; }
  double median_pitch_deg() const;  // positive up

  // An axis of the head in the world: its mean, whose length is 1 where it never turned, and how far it
  // strays from there, as the root mean square of the chord, in degrees: 0 where it never turned, at most 81.
  enum Axis : std::size_t { right_axis, up_axis, forward_axis };
  glm::dvec3 mean_of(Axis axis) const;
  double spread_deg(Axis axis) const;

  // Way walked within 45 degrees of where the head looks, and of straight backwards, seen from above, in
  // metres.
  double way_forwards_m() const { return way_forwards_m_; }
  double way_backwards_m() const { return way_backwards_m_; }

 private:
  double share(std::int64_t rows) const;
  void count_stance(const glm::dvec3& up, const glm::dvec3& forward);
  void measure(const glm::dvec3& up, const glm::dvec3& forward, double right_up);
  void walk(const PoseRow& row, const glm::dvec3& forward);

  std::int64_t rows_ = 0, level_ = 0, upside_ = 0, looks_up_ = 0, looks_down_ = 0, side_ = 0;
  bool turns_ = false, moves_ = false;
  Pose first_;
  TimeNs measured_ns_ = 0;
  std::array<glm::dvec3, 3> sums_{};
  LinearHistogram tilt_deg_{0.5, 361}, roll_deg_{0.5, 361}, pitch_above_down_deg_{0.5, 361};
  std::optional<PoseRow> step_start_;
  double way_forwards_m_ = 0, way_backwards_m_ = 0;
};

}  // namespace herr
