// Whether the eyes turn against the head while it turns, as people's do to keep looking at one thing
// (vestibulo-ocular reflex, gain near 1). Gaze that is mirrored turns with the head; gaze that knows nothing
// of the head does either equally often. In windows of 40 ms (or the gaze's interval, to 150 ms) the turn of
// the eyes is compared with the one that holds what they look at. A window votes for "against" or "with",
// horizontally and vertically, by the logarithm of how much better the one fits than the other; where the
// eyes jump, neither does. If neither were truer, votes would cancel out: their sum, by its standard
// deviation, is the evidence. Bounded memory: head orientations every 20 ms in segments of 4 s; when they
// fill 2.25 MiB every second segment goes and from then on only every second one is kept. Before: all poses
// in order, then all gaze in order. After: plausibility.h, which judges.
#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sessions/streams/stream_rows.h"

namespace herr {

class GazeCountering {
 public:
  void add(const PoseRow& row);
  void add(const GazeRow& row);

  // Of one axis: horizontal or vertical turns.
  struct Axis {
    std::int64_t against = 0, with = 0;  // windows that tell one from the other by two to one or better
    double sum = 0, squares = 0;         // of all votes
    std::int64_t votes = 0;
    std::int64_t seconds = 0;  // that hold windows which tell: one turn of the head is one observation
    TimeNs last_second = -1;

    std::int64_t telling() const { return against + with; }
    // Standard deviations from chance; positive: the eyes turn against the head. At most the root of the
    // votes.
    double evidence() const;
    // Beyond doubt: by 3 standard deviations where at least 5 seconds tell, by 4.5 where fewer do, since
    // people who follow a thing with eyes and head turn both alike for a while. Never on fewer than 12
    // windows, nor where fewer than a tenth of all tell: eyes that jump about.
    bool reversed() const;
  };
  // The same of both together, where neither is certain by itself.
  bool reversed_on_both() const;
  // Beyond doubt the turns fit better with the gaze's two axes exchanged, either way round.
  bool exchanged() const;
  double evidence_not_exchanged() const;  // the least of the four
  const Axis& horizontal() const { return axes_[0]; }
  const Axis& vertical() const { return axes_[1]; }

  // Windows in which the head turns by kTurningDegS or more, and those of them in which the eyes rest in the
  // head.
  std::int64_t turning_windows() const { return turning_; }
  std::int64_t resting_windows() const { return resting_; }
  static constexpr double kTurningDegS = 15;

  std::size_t bytes() const { return kept_.capacity() * sizeof(Kept); }

 private:
  struct Kept {
    TimeNs stamp_ns = 0;
    glm::quat world_from_head{1.0f, 0.0f, 0.0f, 0.0f};
  };
  struct Look {
    TimeNs stamp_ns = 0;
    glm::dvec3 direction{0.0};
    glm::dquat world_from_head{1.0, 0.0, 0.0, 0.0};
  };
  std::int64_t segment_of(TimeNs stamp_ns) const;
  void thin_out();
  std::optional<glm::dquat> head_at(TimeNs stamp_ns);
  void compare(const Look& from, const Look& to);
  void vote_on_exchange(double held_x, double held_y, double eye_x, double eye_y, TimeNs stamp_ns);

  std::vector<Kept> kept_;
  TimeNs first_ns_ = 0;
  std::int64_t stride_ = 1;  // of the segments
  std::size_t place_ = 0;    // of the last one asked for
  std::optional<Look> from_;
  std::array<Axis, 2> axes_;
  std::array<Axis, 4> exchanged_;  // (x, y) read as (y, x), (-y, -x), (-y, x), (y, -x)
  std::int64_t turning_ = 0, resting_ = 0;
};

}  // namespace herr
