#include "server/statistics/run_statistics.h"

#include <cstddef>

#include "server/statistics/statistics_rows.h"

namespace herr {

void RunStatistics::add(const FrameRecord& record) {
  for (std::size_t i = 0; i < kStageCount; ++i) stages[i].add_ms(record.times.ms[i]);
  for (const DistributionRow& row : distribution_rows()) {
    if (const std::optional<double> value = row.of(record)) (this->*row.values).add_ms(*value);
  }
  for (const CountRow& row : count_rows()) this->*row.total += row.of(record);
  ++reasons[static_cast<std::size_t>(record.decision.reason)];
  counters += record.counters;
  probes = record.probes;
}

void RunStatistics::merge(const RunStatistics& other) {
  // Of one run alone: whose newest frame would it be?
  if (other.frames > 0) probes = frames > 0 ? std::nullopt : other.probes;
  for (std::size_t i = 0; i < kStageCount; ++i) stages[i].merge(other.stages[i]);
  for (const DistributionRow& row : distribution_rows()) (this->*row.values).merge(other.*row.values);
  for (const CountRow& row : count_rows()) this->*row.total += other.*row.total;
  for (std::size_t i = 0; i < kQualityReasons; ++i) reasons[i] += other.reasons[i];
  counters += other.counters;
}

double RunStatistics::stutter_share_of_time() const {
  return frame.sum_ns() > 0 ? static_cast<double>(stutter_ns) / static_cast<double>(frame.sum_ns()) : 0;
}

}  // namespace herr
