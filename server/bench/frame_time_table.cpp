#include "server/bench/frame_time_table.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>

#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "server/results/summary_json.h"
#include "server/statistics/load_json.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSizeWidth = 14, kCellWidth = 22;

std::string size_text(const FrameTimeRow& row) {
  if (row.acuity) return "acuity";
  return std::to_string(2 * row.polar_width) + "x" + std::to_string(row.polar_height);
}

// One line of the table: its name, then one cell for each number of light samples.
template <typename Cell>
std::string line(const std::string& name, Cell&& cell) {
  std::string text = left_aligned(name, kSizeWidth);
  for (std::size_t i = 0; i < kTableLightSamples.size(); ++i) text += right_aligned(cell(i), kCellWidth);
  return text + "\n";
}

std::optional<double> share_of(const BenchRun& run, const BenchSubject& subject) {
  if (!run.cpu_ms) return std::nullopt;
  return cpu_share(*run.cpu_ms, run.frame_ms, subject.load.cores);
}

// "152.3 (97.8 %)", or "n/a".
std::string cpu_cell(const BenchRun& run, const BenchSubject& subject) {
  if (!run.cpu_ms) return "n/a";
  const std::optional<double> share = share_of(run, subject);
  return fixed_text(*run.cpu_ms, 1) + (share ? " (" + fixed_text(100 * *share, 1) + " %)" : "");
}

}  // namespace

std::vector<FrameTimeRow> empty_table(const RenderSettings& settings, bool one_size) {
  if (one_size) return {{settings.polar_width, settings.polar_height, {}, {}, settings.polar_acuity}};
  return {{1576 / 2, 768, {}, {}}, {2048 / 2, 1024, {}, {}}};
}

Json frame_times_json(const std::vector<FrameTimeRow>& rows, const BenchSubject& subject, double seconds) {
  Json cells = Json::array();
  for (const FrameTimeRow& row : rows) {
    for (std::size_t i = 0; i < kTableLightSamples.size(); ++i) {
      const BenchRun& run = row.cells[i];
      const std::optional<double> share = share_of(run, subject);
      cells.push_back({{"polar", size_text(row)},
                       {"light_samples", kTableLightSamples[i]},
                       {"frame_ms", run.frame_ms},
                       {"raw_ms", run.bare_ms},
                       {"ratio", run.ratio()},
                       {"probe_ms", run.probe_ms},
                       {"cpu_ms", run.cpu_ms ? Json(*run.cpu_ms) : Json(nullptr)},
                       {"cpu_share", share ? Json(*share) : Json(nullptr)},
                       {"memory_bytes", row.memory_bytes[i]},
                       {"frames", run.frames}});
    }
  }
  Json json{
      {"format_version", 1}, {"program", program_with_version()}, {"table", cells}, {"seconds", seconds}};
  add_subject(subject, features_text(subject.settings, subject.session_has_camera), json);
  add_memory(subject, json);
  json["definitions"] = {
      {"frame_ms", "mean wall time of a run's frames, which sum up to `seconds` at least"},
      {"raw_ms",
       "mean time of the same rays through bare Embree packets and the same pixels through a bare "
       "fetch-blend-store kernel, timed after each frame"},
      {"ratio", "frame_ms / raw_ms"},
      {"probe_ms", "mean time of the stages probe_rays and probe_update, a part of frame_ms"},
      {"cpu_ms", "mean CPU time of the whole process during a frame"}};
  json["definitions"].update(load_definitions_json());
  json["definitions"]["cpu_share"] = "cpu_ms / (frame_ms x cores)";
  json["definitions"]["memory_bytes"] =
      "what renderer, scene and pictures hold: of a cell together, of the last one by what it is for";
  return json;
}

std::string frame_times_table(const std::vector<FrameTimeRow>& rows, const BenchSubject& subject,
                              double seconds) {
  std::string text = subject_text(subject, features_text(subject.settings, subject.session_has_camera)) +
                     "\n\naverage frame time in ms (frame / raw), each over " + shortest_text(seconds) +
                     " s of frames\n";
  text += line("polar buffer", [](std::size_t i) {
    return std::to_string(kTableLightSamples[i]) + (i == 0 ? " light sample" : " light samples");
  });
  for (const FrameTimeRow& row : rows) {
    text += line(size_text(row), [&](std::size_t i) {
      return fixed_text(row.cells[i].frame_ms, 1) + " (" + fixed_text(row.cells[i].ratio(), 2) + ")";
    });
    if (subject.settings.probes.on)
      text += line("  probe update", [&](std::size_t i) { return fixed_text(row.cells[i].probe_ms, 1); });
    text += line("  CPU", [&](std::size_t i) { return cpu_cell(row.cells[i], subject); });
    text += line("  memory, MB", [&](std::size_t i) {
      return fixed_text(static_cast<double>(row.memory_bytes[i]) * 1e-6, 1);
    });
  }
  return text + "CPU: ms of all threads in a frame, and as a share of " + std::to_string(subject.load.cores) +
         (subject.load.cores == 1 ? " core" : " cores") +
         "; memory: renderer, scene and pictures\nthe whole process so far: at most " +
         peak_text(subject.load) + " resident\n";
}

}  // namespace herr
