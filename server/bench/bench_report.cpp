#include "server/bench/bench_report.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "renderer/frame_counters.h"
#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "server/results/summary_json.h"
#include "server/statistics/load_json.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kNameWidth = 26;
constexpr int kNumberWidth = 12;

// What a stage works through, and how much of it a frame has on average, as the stage's median time is that
// of all frames; 0 where a stage has no item of its own.
struct StageItems {
  const char* name = "";
  double count = 0;
};

double rays_of(const BenchResult& result, const std::string& name) {
  for (const BenchResult::Kind& kind : result.kinds) {
    if (kind.name == name) return static_cast<double>(kind.rays);
  }
  return 0;
}

// The mean over the measured frames.
double per_frame(std::int64_t count, const BenchResult& result) {
  return static_cast<double>(count) / std::max(result.measured_frames, 1);
}

double polar_samples_of(const BenchResult& result) {
  for (const BenchResult::Kind& kind : result.kinds) {
    if (kind.rays_per_sample > 0) return static_cast<double>(kind.rays) / kind.rays_per_sample;
  }
  return 0;
}

StageItems items_of(Stage stage, const BenchResult& result) {
  switch (stage) {
    case Stage::probe_rays:
      return {"probe ray", rays_of(result, "probe") + rays_of(result, "catcher_probe")};
    case Stage::indirect_light:
    case Stage::polar_rays:
    case Stage::first_hits:
    case Stage::surfaces:
      return {"ray", rays_of(result, "primary")};
    case Stage::light_rays:
      return {"shadow ray", rays_of(result, "shadow") + rays_of(result, "catcher_shadow")};
    case Stage::occlusion:
      return {"short ray", rays_of(result, "occlusion") + rays_of(result, "catcher_occlusion")};
    case Stage::second_hits:
      return {"second ray", rays_of(result, "mirror") + rays_of(result, "refraction")};
    case Stage::second_light:
      return {"shadow ray", rays_of(result, "mirror_shadow") + rays_of(result, "refraction_shadow")};
    case Stage::edges:
      return {"edge ray", rays_of(result, "edge") + rays_of(result, "edge_shadow")};
    case Stage::resolve:
      return {"polar sample", polar_samples_of(result)};
    case Stage::viewports:
      return {"pixel", per_frame(result.counters.viewport_pixels, result)};
    default:
      return {};
  }
}

// 0 where the stage has no items.
double ns_per_item(Stage stage, const BenchResult& result) {
  const StageItems items = items_of(stage, result);
  return items.count > 0 ? result.median_times[stage] * 1e6 / items.count : 0.0;
}

std::string line(const std::string& name, std::initializer_list<std::string> cells) {
  std::string text = left_aligned(name, kNameWidth);
  for (const std::string& cell : cells) text += right_aligned(cell, kNumberWidth);
  return text + "\n";
}

std::string readable(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string merit_rows(const BenchResult& result) {
  const auto row = [](const std::string& name, double frame, double bare, double ratio, int decimals) {
    return line(name, {fixed_text(frame, decimals), fixed_text(bare, decimals), fixed_text(ratio, 3)});
  };
  const auto over = [](double a, double b) { return b > 0 ? a / b : 0.0; };
  return line("", {"frame", "raw", "frame / raw"}) +
         row("whole frame, ms", result.frame_ms, result.bare_ms, result.ratio, 2) +
         row("rays and light, ms", result.rays_frame_ms, result.rays_bare_ms, result.rays_ratio, 2) +
         row("pixels, ms", result.pixels_frame_ms, result.pixels_bare_ms,
             over(result.pixels_frame_ms, result.pixels_bare_ms), 2) +
         row("pixels, ns per pixel", result.ns_per_pixel, result.bare_ns_per_pixel,
             over(result.ns_per_pixel, result.bare_ns_per_pixel), 3);
}

std::string ray_rows(const BenchResult& result) {
  std::string text = line("rays", {"per frame", "per sample", "Mray/s", "raw Mray/s"});
  for (const BenchResult::Kind& kind : result.kinds) {
    if (kind.rays == 0) continue;
    text += line(kind.name, {std::to_string(kind.rays), fixed_text(kind.rays_per_sample, 3),
                             fixed_text(kind.frame_mrays_per_s, 1), fixed_text(kind.bare_mrays_per_s, 1)});
  }
  return text;
}

std::string stage_rows(const BenchResult& result) {
  std::string text = line("stage", {"ms", "share", "ns / item", "  item"});
  for (std::size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    const double ms = result.median_times.ms[i];
    if (ms == 0) continue;
    const double ns = ns_per_item(stage, result);
    const double share = result.median_times.frame_ms > 0 ? 100 * ms / result.median_times.frame_ms : 0;
    text += line(readable(name_of(stage)),
                 {fixed_text(ms, 3), fixed_text(share, 1) + " %", ns > 0 ? fixed_text(ns, 2) : "",
                  std::string("  ") + items_of(stage, result).name});
  }
  return text;
}

// What was counted at all.
std::string counter_rows_text(const BenchResult& result) {
  std::string text = line("counter", {"per frame"});
  for (const CounterRow& row : counter_rows()) {
    const std::int64_t count = result.counters.*row.value;
    if (count != 0) text += line(readable(row.name), {fixed_text(per_frame(count, result), 2)});
  }
  return text;
}

Json counters_json(const BenchResult& result) {
  Json json = Json::object();
  for (const CounterRow& row : counter_rows()) {
    json[row.name] = per_frame(result.counters.*row.value, result);
  }
  return json;
}

}  // namespace

Json bench_json(const BenchResult& result, const BenchSubject& subject) {
  Json kinds = Json::object();
  for (const BenchResult::Kind& kind : result.kinds) {
    kinds[kind.name] = {{"rays", kind.rays},
                        {"rays_per_sample", kind.rays_per_sample},
                        {"mrays_per_s", kind.frame_mrays_per_s},
                        {"raw_mrays_per_s", kind.bare_mrays_per_s}};
  }
  Json stages = Json::object();
  for (std::size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    Json entry{{"ms", result.median_times.ms[i]}};
    if (const double ns = ns_per_item(stage, result); ns > 0) {
      entry["ns_per_item"] = ns;
      entry["item"] = items_of(stage, result).name;
    }
    stages[name_of(stage)] = entry;
  }
  const std::optional<double> cpu_ms = result.cpu_ms;
  std::optional<double> share;
  if (cpu_ms) share = cpu_share(*cpu_ms, result.frame_ms, subject.load.cores);
  Json json{{"format_version", 1},
            {"program", program_with_version()},
            {"frame_ms", result.frame_ms},
            {"raw_ms", result.bare_ms},
            {"ratio", result.ratio},
            {"cpu_ms", cpu_ms ? Json(*cpu_ms) : Json(nullptr)},
            {"cpu_share", share ? Json(*share) : Json(nullptr)},
            {"rays_frame_ms", result.rays_frame_ms},
            {"rays_raw_ms", result.rays_bare_ms},
            {"rays_ratio", result.rays_ratio},
            {"pixels_frame_ms", result.pixels_frame_ms},
            {"pixels_raw_ms", result.pixels_bare_ms},
            {"ns_per_pixel", result.ns_per_pixel},
            {"raw_ns_per_pixel", result.bare_ns_per_pixel},
            {"rays", kinds},
            {"stages", stages},
            {"polar_samples", std::llround(polar_samples_of(result))},
            {"viewport_pixels", std::llround(per_frame(result.counters.viewport_pixels, result))},
            {"counters", counters_json(result)},
            {"frames", result.frames}};
  add_subject(subject, settings_text(subject.settings, subject.session_has_camera), json);
  add_memory(subject, json);
  json["definitions"] = {
      {"frame_ms", "median over frames of each frame's median wall time"},
      {"raw_ms",
       "the same rays through bare Embree packets and the same pixels through a bare "
       "fetch-blend-store kernel, timed in alternation with the frames"},
      {"ratio", "median over frames of frame / raw; rays_ratio likewise without the pixels"},
      {"cpu_ms", "CPU time of the whole process during a frame, of the same frames as frame_ms"},
      {"counters", "means over all measured frames: the whole sequence, as often as it was repeated"},
      {"ns_per_pixel", "wall time of the viewports stage per viewport pixel, all threads together"}};
  json["definitions"].update(load_definitions_json());
  json["definitions"]["cpu_share"] = "cpu_ms / (frame_ms x cores)";
  return json;
}

std::string bench_table(const BenchResult& result, const BenchSubject& subject) {
  return subject_text(subject, settings_text(subject.settings, subject.session_has_camera)) + ", " +
         counted(result.frames, "frame", "frames") + "\n\n" + merit_rows(result) + "\n" + ray_rows(result) +
         "\n" + stage_rows(result) + "\n" + counter_rows_text(result) + "\n" +
         cpu_text(result.cpu_ms, result.frame_ms, subject.load.cores) + "\n" + memory_text(subject);
}

}  // namespace herr
