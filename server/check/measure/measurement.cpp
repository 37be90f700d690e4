#include "server/check/measure/measurement.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "renderer/bench/calibration_rays.h"
#include "server/check/measure/not_comparable.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLongest_ms = 1e9;
constexpr const char* kRemedy = "measure again";

Json entries_json(const Fingerprint::Entries& entries) {
  Json json = Json::array();
  for (const auto& [name, value] : entries) json.push_back({name, value});
  return json;
}

Fingerprint::Entries read_entries(const JsonObject& object, const char* key) {
  Fingerprint::Entries entries;
  const nlohmann::json& list = object.value(key);
  if (!list.is_array()) object.fail(key, "is no list", kRemedy);
  for (const nlohmann::json& entry : list) {
    if (!entry.is_array() || entry.size() != 2 || !entry[0].is_string() || !entry[1].is_string()) {
      object.fail(key, "is no list of pairs of texts", kRemedy);
    }
    entries.emplace_back(entry[0].get<std::string>(), entry[1].get<std::string>());
  }
  return entries;
}

Fingerprint::Entries known_to(const CheckFingerprint& other, const Fingerprint::Entries& settings) {
  Fingerprint::Entries known;
  for (const auto& entry : settings) {
    const auto& others = other.work.settings;
    const bool is_known = std::any_of(others.begin(), others.end(),
                                      [&](const auto& setting) { return setting.first == entry.first; });
    if (is_known) known.push_back(entry);
  }
  return known;
}

std::vector<double> read_times(const JsonObject& object, const char* key) {
  const nlohmann::json& list = object.value(key);
  if (!list.is_array()) object.fail(key, "is no list", kRemedy);
  // A time of 0 has no logarithm.
  std::vector<double> times = object.numbers(key, list.size(), 0, kLongest_ms);
  for (const double time : times) {
    if (!(time > 0)) object.fail(key, "holds a time of 0", kRemedy);
  }
  return times;
}

}  // namespace

std::vector<FingerprintDifference> work_differences(const CheckFingerprint& earlier,
                                                    const CheckFingerprint& now) {
  return differences({known_to(now, earlier.work.settings), earlier.work.inputs},
                     {known_to(earlier, now.work.settings), now.work.inputs});
}

std::string work_difference(const CheckFingerprint& earlier, const CheckFingerprint& now) {
  const std::vector<FingerprintDifference> found = work_differences(earlier, now);
  return found.empty() ? std::string() : found.front().text;
}

std::string machine_difference(const CheckFingerprint& earlier, const CheckFingerprint& now) {
  return difference({earlier.machine, {}}, {now.machine, {}});
}

Json fingerprint_json(const CheckFingerprint& fingerprint) {
  return {{"settings", entries_json(fingerprint.work.settings)},
          {"inputs", entries_json(fingerprint.work.inputs)},
          {"machine", entries_json(fingerprint.machine)}};
}

CheckFingerprint read_fingerprint(const nlohmann::json& value, const std::string& source) {
  const JsonObject object(value, source, "fingerprint");
  CheckFingerprint fingerprint;
  fingerprint.work.settings = read_entries(object, "settings");
  fingerprint.work.inputs = read_entries(object, "inputs");
  fingerprint.machine = read_entries(object, "machine");
  return fingerprint;
}

Json measurement_json(const Measurement& measurement) {
  Json counters = Json::object();
  for (const auto& [name, value] : measurement.counters) {
    counters[name] = value ? Json(*value) : Json(nullptr);
  }
  Json json{{"measurement_version", kMeasurementVersion},
            {"calibration_version", kCalibrationVersion},
            {"program", measurement.program},
            {"fingerprint", fingerprint_json(measurement.fingerprint)},
            {"frame_ms", measurement.frame_ms},
            {"calibration_rays_ms", measurement.calibration_rays_ms},
            {"calibration_memory_ms", measurement.calibration_memory_ms},
            {"counters", counters}};
  json["cpu_ticks"] = measurement.cpu
                          ? Json{{"used", measurement.cpu->used}, {"stolen", measurement.cpu->stolen}}
                          : Json(nullptr);
  return json;
}

Measurement read_measurement(const nlohmann::json& record, const std::string& source) {
  const JsonObject object(record, source, "");
  const auto version_of = [&](const char* key) { return object.integer(key, 0, 1 << 30); };
  if (version_of("measurement_version") != kMeasurementVersion) {
    throw NotComparable(printable(source) + " measures in format " +
                        std::to_string(version_of("measurement_version")) + ", this program in format " +
                        std::to_string(kMeasurementVersion));
  }
  if (version_of("calibration_version") != kCalibrationVersion) {
    throw NotComparable(printable(source) + " has calibration " +
                        std::to_string(version_of("calibration_version")) + ", this program calibration " +
                        std::to_string(kCalibrationVersion));
  }
  Measurement measurement;
  measurement.program = object.text("program");
  measurement.fingerprint = read_fingerprint(object.value("fingerprint"), source);
  measurement.frame_ms = read_times(object, "frame_ms");
  measurement.calibration_rays_ms = read_times(object, "calibration_rays_ms");
  measurement.calibration_memory_ms = read_times(object, "calibration_memory_ms");
  const std::size_t frames = measurement.frame_ms.size();
  if (frames == 0) object.fail("frame_ms", "is empty", kRemedy);
  if (measurement.calibration_rays_ms.size() != frames + 1 ||
      measurement.calibration_memory_ms.size() != frames + 1) {
    object.fail("frame_ms", "has not one entry less than the calibration", kRemedy);
  }
  const JsonObject counters = object.object("counters");
  for (const auto& [name, value] : object.value("counters").items()) {
    std::optional<double> count;
    if (!value.is_null()) count = counters.number(name.c_str(), 0, 1e18);
    measurement.counters.emplace_back(name, count);
  }
  if (!object.value("cpu_ticks").is_null()) {
    const JsonObject ticks = object.object("cpu_ticks");
    constexpr std::int64_t kMost = std::int64_t{1} << 60;
    measurement.cpu = CpuTicks{ticks.integer("used", 0, kMost), ticks.integer("stolen", 0, kMost)};
  }
  return measurement;
}

}  // namespace herr
