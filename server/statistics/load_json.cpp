#include "server/statistics/load_json.h"

#include <nlohmann/json.hpp>

#include "server/statistics/latency_json.h"
#include "server/statistics/statistics_rows.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

template <typename Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::optional<double> mean_cpu_ms(const RunStatistics& statistics) {
  if (statistics.cpu.count() == 0) return std::nullopt;
  return statistics.cpu.mean_ns() * 1e-6;
}

}  // namespace

std::optional<double> cpu_share(double cpu_ms, double wall_ms, int cores) {
  if (!(wall_ms > 0) || cores < 1) return std::nullopt;
  return cpu_ms / (wall_ms * cores);
}

Json load_json(const RunStatistics& statistics, const ProcessLoad& load) {
  const std::optional<double> cpu_ms = mean_cpu_ms(statistics);
  std::optional<double> share;
  if (cpu_ms) share = cpu_share(*cpu_ms, statistics.frame.mean_ns() * 1e-6, load.cores);
  Json json{{"cores", load.cores}};
  for (const DistributionRow& row : distribution_rows()) {
    if (row.group != DistributionGroup::load) continue;
    Json values{{"unit", row.unit}};
    values.update(distribution_json(statistics.*row.values));
    json[row.name] = values;
  }
  json["cpu_share"] = or_null(share);
  json["preemptions"] = statistics.preemptions;
  json["peak_resident_bytes"] = or_null(load.peak_resident_bytes);
  return json;
}

Json load_definitions_json() {
  return {{"cores", "that the process may use: its CPU affinity, narrowed by a cgroup quota"},
          {"cpu_share", "mean cpu / (mean frame time x cores)"},
          {"preemptions",
           "times that the scheduler took a core from a thread of the process that wanted to go on, during "
           "frames (getrusage, ru_nivcsw): for other programs, for threads of its own, or at the end of a "
           "cgroup's quota; how long each lasted is not told"},
          {"peak_resident_bytes",
           "the most memory that was ever resident (VmHWM), of the whole process since it began: loading, "
           "earlier sessions and libraries are in it"},
          {"memory_bytes",
           "what renderer, loaded scene and pictures hold, by what it is for; a part of what is resident"}};
}

std::string cpu_text(std::optional<double> cpu_ms, double wall_ms, int cores) {
  if (!cpu_ms) return "CPU time of a frame n/a";
  const std::optional<double> share = cpu_share(*cpu_ms, wall_ms, cores);
  return fixed_text(*cpu_ms, 1) + " ms of CPU for each frame, " +
         (share ? fixed_text(100 * *share, 1) : "n/a") + " % of " + std::to_string(cores) +
         (cores == 1 ? " core" : " cores");
}

std::string cpu_text(const RunStatistics& statistics, int cores) {
  return cpu_text(mean_cpu_ms(statistics), statistics.frame.mean_ns() * 1e-6, cores);
}

std::string peak_text(const ProcessLoad& load) {
  if (!load.peak_resident_bytes) return "n/a";
  return fixed_text(static_cast<double>(*load.peak_resident_bytes) * 1e-6, 1) + " MB";
}

}  // namespace herr
