// The result of `herr bench` as a table for people and as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "renderer/bench_frame.h"

namespace herr {

// What was measured, on what.
struct BenchSubject {
  std::string session, scene, cpu_name;
  std::int64_t triangles = 0;
  DisplayProfile profile;
  RenderSettings settings;  // threads and isa resolved
};

nlohmann::ordered_json bench_json(const BenchResult& result, const BenchSubject& subject);
std::string bench_table(const BenchResult& result, const BenchSubject& subject);

// "model name" of /proc/cpuinfo, or "unknown".
std::string cpu_name();

}  // namespace herr
