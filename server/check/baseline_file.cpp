#include "server/check/baseline_file.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "renderer/bench/calibration_rays.h"
#include "server/check/measure/not_comparable.h"
#include "server/results/summary_json.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kBaselineVersion = 1;
constexpr std::size_t kMostRuns = 26;  // that the rank-sum test takes

// Of the file, in the order in which they are written.
constexpr std::pair<const char*, double RunValues::*> kValues[] = {
    {"median", &RunValues::median},
    {"p95", &RunValues::p95},
    {"worst_5_percent", &RunValues::worst_twentieth},
    {"frame_ms", &RunValues::frame_ms},
    {"calibration_rays_ms", &RunValues::rays_ms},
};

void check_version(const JsonObject& file, const char* key, int wanted) {
  const std::int64_t found = file.integer(key, 0, 1 << 30);
  if (found == wanted) return;
  throw NotComparable(printable(file.file().string()) + " has " + key + " " + std::to_string(found) +
                      ", this program " + std::to_string(wanted));
}

}  // namespace

std::string baseline_text(const Baseline& baseline) {
  Json runs = Json::array(), counters = Json::object();
  for (const RunValues& run : baseline.runs) {
    Json json;
    for (const auto& [name, value] : kValues) json[name] = run.*value;
    runs.push_back(json);
  }
  for (const CounterRange& counter : baseline.counters) {
    counters[counter.name] = {counter.lowest, counter.highest};
  }
  return json_text({{"baseline_version", kBaselineVersion},
                    {"measurement_version", kMeasurementVersion},
                    {"calibration_version", kCalibrationVersion},
                    {"program", baseline.program},
                    {"frames", baseline.frames},
                    {"fingerprint", fingerprint_json(baseline.fingerprint)},
                    {"runs", runs},
                    {"counters_per_frame", counters},
                    {"definitions",
                     {{"median", "of each frame's time over the quicker of the calibrations beside it"},
                      {"p95", "95th percentile of the same"},
                      {"worst_5_percent", "mean of the slowest 5 % of the same"},
                      {"frame_ms", "median frame time as it was"},
                      {"calibration_rays_ms", "median time of the calibration's rays"},
                      {"counters_per_frame", "lowest and highest of all runs"}}}});
}

Baseline read_baseline(const std::filesystem::path& file) {
  const nlohmann::json document = parse_json_file(file);
  const JsonObject object(document, file, "");
  check_version(object, "baseline_version", kBaselineVersion);
  check_version(object, "measurement_version", kMeasurementVersion);
  check_version(object, "calibration_version", kCalibrationVersion);
  Baseline baseline;
  baseline.program = object.text("program");
  baseline.frames = object.integer("frames", 2, 1 << 30);
  baseline.fingerprint = read_fingerprint(object.value("fingerprint"), file.string());
  for (const JsonObject& run : object.objects("runs")) {
    RunValues values;
    for (const auto& [name, value] : kValues) values.*value = run.number(name, 1e-12, 1e12);
    baseline.runs.push_back(values);
  }
  if (baseline.runs.empty() || baseline.runs.size() > kMostRuns) {
    object.fail("runs", "holds no runs, or more than 26", "store them again with herr check --save");
  }
  const JsonObject counters = object.object("counters_per_frame");
  for (const auto& [name, unused_here] : object.value("counters_per_frame").items()) {
    const std::vector<double> range = counters.numbers(name.c_str(), 2, 0, 1e18);
    baseline.counters.push_back({name, range[0], range[1]});
  }
  return baseline;
}

}  // namespace herr
