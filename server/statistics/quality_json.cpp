#include "server/statistics/quality_json.h"

#include <cstddef>
#include <nlohmann/json.hpp>

#include "server/statistics/frame_pace.h"
#include "server/statistics/latency_json.h"
#include "server/statistics/statistics_rows.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

void add_distributions(const RunStatistics& statistics, DistributionGroup group, Json& json) {
  for (const DistributionRow& row : distribution_rows()) {
    if (row.group == group) json[row.name] = distribution_json(statistics.*row.values);
  }
}

}  // namespace

Json quality_json(const RunStatistics& statistics) {
  Json json;
  add_distributions(statistics, DistributionGroup::quality, json);
  json["reasons"] = Json::object();
  for (std::size_t i = 0; i < kQualityReasons; ++i) {
    if (statistics.reasons[i] == 0) continue;
    json["reasons"][name_of(static_cast<QualityReason>(i))] = statistics.reasons[i];
  }
  return json;
}

Json feed_json(const RunStatistics& statistics) {
  Json json{{"unit", "arcmin"}};
  add_distributions(statistics, DistributionGroup::feed, json);
  return json;
}

Json pace_json(const RunStatistics& statistics) {
  const OnePercentLows lows = one_percent_lows(statistics.frame);
  const auto fps = [&](double value) { return statistics.frames > 0 ? Json(value) : Json(nullptr); };
  return {{"stutter_frames", statistics.stutter_frames},
          {"stutter_share_of_time", statistics.stutter_share_of_time()},
          {"low_1_percent_rank_fps", fps(lows.rank_fps)},
          {"low_1_percent_mean_fps", fps(lows.mean_fps)},
          {"low_1_percent_time_fps", fps(lows.time_fps)}};
}

Json pace_definitions_json() {
  return {{"stutter_frames",
           "frames whose frame time exceeds " + fixed_text(StutterWatch::kFactor, 1) +
               " times the mean of those before in their run: mean' = t + (mean - t) exp(-t / 1 s)"},
          {"stutter_share_of_time", "sum of their frame times / sum of all frame times"},
          {"low_1_percent_rank_fps", "1 / p99 of the frame time"},
          {"low_1_percent_mean_fps", "1 / mean frame time of the slowest 1 % of the frames"},
          {"low_1_percent_time_fps",
           "1 / frame time of the fastest among the slowest frames that together took 1 % of the time"}};
}

}  // namespace herr
