#include "server/bench/bench_subject.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <sstream>

#include "server/results/summary_json.h"
#include "server/settings/run_settings.h"
#include "server/statistics/load_json.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/inspect/number_words.h"

namespace herr {

std::string cpu_name() {
  std::istringstream file(read_kernel_text("/proc/cpuinfo"));
  for (std::string row; std::getline(file, row);) {
    const std::size_t colon = row.find(": ");
    if (row.starts_with("model name") && colon != std::string::npos) return printable(row.substr(colon + 2));
  }
  return "unknown";
}

std::string subject_text(const BenchSubject& subject, const std::string& settings) {
  return printable(subject.session) + ", " + printable(subject.scene) + " (" +
         counted(subject.triangles, "triangle", "triangles") + "), " +
         profile_words(printable(subject.profile.name), subject.profile_scale) + ", " + settings + "\n" +
         subject.cpu_name + ", " + counted(subject.settings.threads, "thread", "threads") + ", " +
         name_of(subject.settings.isa);
}

void add_subject(const BenchSubject& subject, const std::string& settings, nlohmann::ordered_json& json) {
  json["session"] = subject.session;
  json["scene"] = subject.scene;
  json["triangles"] = subject.triangles;
  json["profile"] = subject.profile.name;
  json["profile_scale"] = subject.profile_scale;
  json["settings"] = settings;
  json["isa"] = name_of(subject.settings.isa);
  json["threads"] = subject.settings.threads;
  json["cpu"] = subject.cpu_name;
}

std::string memory_text(const BenchSubject& subject) {
  return fixed_text(static_cast<double>(total_bytes(subject.memory)) * 1e-6, 1) +
         " MB in renderer, scene and pictures; at most " + peak_text(subject.load) +
         " resident in the whole process so far\n";
}

void add_memory(const BenchSubject& subject, nlohmann::ordered_json& json) {
  json["cores"] = subject.load.cores;
  json["peak_resident_bytes"] = nullptr;
  if (subject.load.peak_resident_bytes) json["peak_resident_bytes"] = *subject.load.peak_resident_bytes;
  json["memory_bytes"] = memory_json(subject.memory);
}

}  // namespace herr
