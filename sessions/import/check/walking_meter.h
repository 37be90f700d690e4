// Whether a head that travels looks where it goes, as walking people do: tells forward from back and from
// sideways, which level and horizon cannot. Constant memory. Before: pose rows in order. After: proposal.
#pragma once

#include <optional>

#include "sessions/streams/stream_rows.h"

namespace herr {

class WalkingMeter {
 public:
  void add(const PoseRow& row);
  // Mean cosine between the way over ground and the head's forward, weighted by the way; none below
  // kShortestWayM.
  std::optional<double> ahead() const;

  static constexpr double kShortestWayM = 3;

 private:
  std::optional<PoseRow> from_;
  double way_m_ = 0, ahead_m_ = 0;
};

}  // namespace herr
