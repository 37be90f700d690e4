// What `herr bench` measured on: the head of its tables and the end of its JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "renderer/render_settings.h"
#include "sessions/format/display_profile.h"

namespace herr {

struct BenchSubject {
  std::string session, scene, cpu_name;
  std::int64_t triangles = 0;
  DisplayProfile profile;
  RenderSettings settings;  // threads and isa resolved
};

// "model name" of /proc/cpuinfo, or "unknown".
std::string cpu_name();

// Two lines: session, scene, profile and `settings`; the machine.
std::string subject_text(const BenchSubject& subject, const std::string& settings);
// Adds the same to `json`.
void add_subject(const BenchSubject& subject, const std::string& settings, nlohmann::ordered_json& json);

}  // namespace herr
