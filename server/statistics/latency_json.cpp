#include "server/statistics/latency_json.h"

#include <cstddef>
#include <nlohmann/json.hpp>

#include "server/statistics/quality_json.h"

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
  return {{"unit", "ms"},
          {"relative_error", LatencyHistogram::kRelativeError},
          {"frame", distribution_json(statistics.frame)},
          {"stages", stages},
          {"sample", distribution_json(statistics.sample)},
          {"write", distribution_json(statistics.write)},
          {"wait", distribution_json(statistics.wait)},
          {"motion_to_photon", distribution_json(statistics.motion_to_photon)},
          {"pose_age", distribution_json(statistics.pose_age)},
          {"gaze_age", distribution_json(statistics.gaze_age)},
          {"camera_age", distribution_json(statistics.camera_age)}};
}

Json definitions_json(ReplayClock clock) {
  const bool realtime = clock == ReplayClock::realtime;
  Json json{
      {"frame", "wall time of rendering one frame, encoding and writing excluded; the sum of its stages"},
      {"sample", "time spent sampling the session, camera images decoded, before the frame"},
      {"write", "wall time of encoding one frame's pictures on the render threads, after the frame"},
      {"wait", "time spent waiting for room in the writer's queue, after the frame"},
      {"missed", realtime ? "frames that were done later than their start + one display period"
                          : "frames whose frame time exceeds the display period"},
      {"dropped", realtime ? "frames of the session that were never rendered: a newer one was due"
                           : "always 0: this clock leaves no frame out"},
      {"repeated", realtime ? "display ticks between two presentations that had no new frame"
                            : "always 0: this clock has no display ticks"},
      {"presentation_time", presentation_formula(clock)},
      {"motion_to_photon", "presentation time - stamp of the newest pose used"},
      {"pose_age", "frame start - stamp of the newest pose used; likewise gaze_age, camera_age"}};
  json.update(quality_definitions_json());
  return json;
}

}  // namespace herr
