// What is known of a run, one row each: sums, merges and JSON go over these rows. A new distribution or count
// is one member of RunStatistics and one row (and a member of FrameRecord where it is new there).
// The stages, the reasons of quality and the counters of a frame have lists of their own: Stage,
// QualityReason, renderer/frame_counters.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "server/statistics/run_statistics.h"

namespace herr {

// Where a distribution is reported.
enum class DistributionGroup : std::uint8_t { latency, load, quality, feed };

// Frames add the values that they have; runs merge by adding the counts of the buckets.
struct DistributionRow {
  const char* name;  // key in JSON
  const char* unit;
  DistributionGroup group;
  const char* sentence;
  LatencyHistogram RunStatistics::*values;
  std::optional<double> (*of)(const FrameRecord&);
};
std::span<const DistributionRow> distribution_rows();

// Frames add up, and so do runs.
struct CountRow {
  const char* name;    // key in JSON
  const char* metric;  // of Prometheus, without "herr_" and "_total"; null: none
  const char* unit;
  const char* sentence;  // ends with a full stop
  std::int64_t RunStatistics::*total;
  std::int64_t (*of)(const FrameRecord&);
};
std::span<const CountRow> count_rows();

}  // namespace herr
