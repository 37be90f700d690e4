#include "server/statistics/quality_json.h"

#include <cstddef>
#include <nlohmann/json.hpp>

#include "server/statistics/latency_json.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json quality_json(const RunStatistics& statistics) {
  Json reasons = Json::object();
  for (std::size_t i = 0; i < kQualityReasons; ++i) {
    if (statistics.reasons[i] == 0) continue;
    reasons[name_of(static_cast<QualityReason>(i))] = statistics.reasons[i];
  }
  return {{"polar_width", distribution_json(statistics.polar_width)},
          {"light_samples", distribution_json(statistics.light_samples)},
          {"head_deg_s", distribution_json(statistics.head_deg_s)},
          {"reasons", reasons}};
}

Json feed_json(const RunStatistics& statistics) {
  return {{"unit", "arcmin"},
          {"misregistration", distribution_json(statistics.misregistration)},
          {"feed_turn", distribution_json(statistics.feed_turn)},
          {"feed_shift", distribution_json(statistics.feed_shift)}};
}

Json pace_json(const RunStatistics& statistics) {
  const OnePercentLows lows = one_percent_lows(statistics.frame);
  const auto fps = [&](double value) { return statistics.frames > 0 ? Json(value) : Json(nullptr); };
  return {{"stutter_frames", statistics.stutter.frames()},
          {"stutter_share_of_time", statistics.stutter.share_of_time()},
          {"low_1_percent_rank_fps", fps(lows.rank_fps)},
          {"low_1_percent_mean_fps", fps(lows.mean_fps)},
          {"low_1_percent_time_fps", fps(lows.time_fps)}};
}

Json quality_definitions_json() {
  return {
      {"polar_width", "radial samples per eye that a frame traced; light_samples: for each light and hit"},
      {"head_deg_s",
       "recorded turn of the head plus its way seen from 2 m, smoothed over 20 ms, falling off with 0.25 s"},
      {"misregistration",
       "angle between where a pixel of the feed is shown and where its surface truly is, for a far surface: "
       "asin(b / D), b = distance from the eye, by the pose used, to the camera at exposure, D = the feed's "
       "distance; at distance d it is |asin(b / D) - asin(b / d)|; the worse eye"},
      {"feed_turn",
       "angle that the camera turned between exposure and the pose used; re-projection undoes it"},
      {"feed_shift", "asin(m / D), m = distance that the camera moved between exposure and the pose used"},
      {"stutter_frames", "frames whose frame time exceeds " + fixed_text(Stutter::kFactor, 1) +
                             " times the mean of those before: mean' = t + (mean - t) exp(-t / 1 s)"},
      {"stutter_share_of_time", "sum of their frame times / sum of all frame times"},
      {"low_1_percent_rank_fps", "1 / p99 of the frame time"},
      {"low_1_percent_mean_fps", "1 / mean frame time of the slowest 1 % of the frames"},
      {"low_1_percent_time_fps",
       "1 / frame time of the fastest among the slowest frames that together took 1 % of the time"}};
}

}  // namespace herr
