#include "server/statistics/latency_json.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "server/statistics/load_json.h"
#include "server/statistics/quality_json.h"
#include "server/statistics/statistics_rows.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

const char* presentation_formula(ReplayClock clock) {
  switch (clock) {
    case ReplayClock::virtual_time:
      return "frame start + max(frame time, one display period)";
    case ReplayClock::realtime:
      return "the first display tick at or after the frame's completion, on the session's clock";
    case ReplayClock::max:
      return "frame start + frame time";
  }
  return "unknown";
}

}  // namespace

Json distribution_json(const LatencyHistogram& times) {
  Json json{{"count", times.count()}};
  const auto put = [&](const char* name, double ns) {
    json[name] = times.count() > 0 ? Json(ns * 1e-6) : Json(nullptr);
  };
  put("mean", times.mean_ns());
  put("min", static_cast<double>(times.min_ns()));
  put("max", static_cast<double>(times.max_ns()));
  put("p50", times.quantile_ns(0.50));
  put("p90", times.quantile_ns(0.90));
  put("p95", times.quantile_ns(0.95));
  put("p99", times.quantile_ns(0.99));
  put("p99.9", times.quantile_ns(0.999));
  return json;
}

Json latencies_json(const RunStatistics& statistics) {
  Json stages = Json::object();
  for (std::size_t i = 0; i < kStageCount; ++i) {
    stages[name_of(static_cast<Stage>(i))] = distribution_json(statistics.stages[i]);
  }
  Json json{{"unit", "ms"}, {"relative_error", LatencyHistogram::kRelativeError}};
  for (const DistributionRow& row : distribution_rows()) {
    if (row.group == DistributionGroup::latency) json[row.name] = distribution_json(statistics.*row.values);
    if (row.values == &RunStatistics::frame) json["stages"] = stages;
  }
  return json;
}

Json count_definitions_json(ReplayClock clock) {
  const bool realtime = clock == ReplayClock::realtime;
  Json json;
  json["rendered"] = "frames of the session that were rendered";
  json["missed"] = realtime ? "frames that were done later than their start + one display period"
                            : "frames whose frame time exceeds the display period";
  json["missed_by_machine"] =
      "missed frames that were kept off the cores (the scheduler took one from a thread of the process, and "
      "the threads were on a core for less than 80 % of the time) and whose CPU time, spread over the "
      "threads, fits into the period; with the clock realtime together with the CPU time of sampling and of "
      "further views (never their wall time, which waiting for a core lengthens)";
  json["missed_by_both"] =
      "missed frames that were kept off the cores and whose CPU time (likewise with the CPU time of sampling "
      "and of further views) would not have fit either";
  json["missed_by_work"] = "every other missed frame";
  json["over_target"] = "frames for which the same time exceeds --target-ms; without it as missed";
  json["dropped"] = realtime ? "frames of the session that were never rendered: a newer one was due"
                             : "always 0: this clock leaves no frame out";
  json["repeated"] = realtime ? "display ticks between two presentations that had no new frame"
                              : "always 0: this clock has no display ticks";
  return json;
}

Json definitions_json(ReplayClock clock) {
  Json json;
  for (const DistributionRow& row : distribution_rows()) json[row.name] = row.sentence;
  json.update(count_definitions_json(clock));
  json["clipped_pixels"] =
      "pixels of PNG files whose colour, times 2^exposure, is above 1 or below 0: PNG shows white or 0 "
      "there, "
      "EXR has the value; without PNG 0";
  json["presentation_time"] = presentation_formula(clock);
  json.update(load_definitions_json());
  json.update(pace_definitions_json());
  return json;
}

Json counters_json(const RunStatistics& statistics) {
  Json json;
  for_each_counter(statistics.counters,
                   [&](const std::string& name, std::int64_t count) { json[name] = count; });
  json["nonfinite_picture_values"] = statistics.nonfinite_pictures;
  json["clipped_pixels"] = statistics.clipped_pixels;
  return json;
}

Json frame_counts_json(const RunStatistics& statistics) {
  return {{"rendered", statistics.frames},
          {"missed", statistics.missed_frames},
          {"missed_by_machine", statistics.missed_by_machine},
          {"missed_by_work", statistics.missed_by_work},
          {"missed_by_both", statistics.missed_by_both},
          {"over_target", statistics.over_target},
          {"dropped", statistics.dropped_frames},
          {"repeated", statistics.repeated_ticks}};
}

}  // namespace herr
