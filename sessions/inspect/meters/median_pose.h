// Where a head is in the median, and where it looks. Constant memory: of long recordings evenly spaced rows
// count. Before: pose rows in order. After: the report of `herr inspect`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sessions/format/pose.h"

namespace herr {

class MedianPose {
 public:
  void add(const Pose& world_from_head, TimeNs stamp_ns = 0);
  std::int64_t rows() const { return rows_; }

  // Metres, the median of each coordinate: (0, 0, 0) without rows. Exact up to kMostKept rows.
  glm::dvec3 place_m() const;
  // Of the head's forward, -Z: the median of each coordinate, brought to length 1. (0, 0, 0) where these
  // cancel out, or without rows.
  glm::dvec3 forward() const;
  // Both: at place_m(), upright, turned about +Y and then up or down so that -Z is forward(), if there is
  // one.
  Pose pose() const;
  // Every row, or evenly spaced ones of more than kMostKept.
  const std::vector<Pose>& kept() const { return kept_; }
  const std::vector<TimeNs>& kept_ns() const { return kept_ns_; }  // their stamps

  static constexpr std::size_t kMostKept = 4096;

 private:
  std::vector<Pose> kept_;  // every stride_-th row
  std::vector<TimeNs> kept_ns_;
  std::int64_t rows_ = 0, stride_ = 1;
};

}  // namespace herr
