// What `herr bench` measured on: the head of its tables and the end of its JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "renderer/memory_use.h"
#include "renderer/render_settings.h"
#include "server/process/process_load.h"
#include "sessions/format/display_profile.h"

namespace herr {

struct BenchSubject {
  std::string session, scene, cpu_name;
  std::int64_t triangles = 0;
  DisplayProfile profile;    // scaled
  double profile_scale = 1;  // by this
  RenderSettings settings;   // threads and isa resolved
  bool session_has_camera = true;
  // After the measurement:
  MemoryUse memory;  // of scene, pictures and the renderer measured last
  ProcessLoad load;
};

// "model name" of /proc/cpuinfo, or "unknown".
std::string cpu_name();

// Two lines: session, scene, profile and `settings`; the machine.
std::string subject_text(const BenchSubject& subject, const std::string& settings);
// Adds the same to `json`.
void add_subject(const BenchSubject& subject, const std::string& settings, nlohmann::ordered_json& json);

// One line: what scene, renderer and pictures hold, and the most that was ever resident.
std::string memory_text(const BenchSubject& subject);
// {"cores", "peak_resident_bytes", "memory_bytes"} into `json`.
void add_memory(const BenchSubject& subject, nlohmann::ordered_json& json);

}  // namespace herr
