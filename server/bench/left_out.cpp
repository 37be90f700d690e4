#include "server/bench/left_out.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "renderer/timing.h"
#include "server/process/version.h"
#include "server/results/memory_parts.h"
#include "server/results/settings_report.h"
#include "server/results/summary_json.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kLeftOutWidth = 25, kTimeWidth = 11, kShareWidth = 10, kMemoryWidth = 12;
constexpr const char* kEverything = "everything at once";
constexpr const char* kControl = "nothing, twice the plan";
// Embree's own memory is the same whatever runs, but for where its threads happened to allocate.
constexpr const char* kEmbreeEntry = "acceleration structures";

std::int64_t planned_bytes(const MemoryUse& use) {
  std::int64_t sum = 0;
  for (const MemoryEntry& entry : use) sum += entry.name == kEmbreeEntry ? 0 : entry.bytes;
  return sum;
}

std::int64_t different_values(const RenderedFrame& a, const RenderedFrame& b) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < a.viewports.size(); ++i) {
    const ViewportImage &one = a.viewports[i], &other = b.viewports[i];
    for (int y = 0; y < one.height_px; ++y) {
      const auto* row = one.row(y);
      for (int x = 0; x < 4 * one.width_px; ++x) count += row[x] != other.row(y)[x] ? 1 : 0;
    }
  }
  return count;
}

// Two renderers whose frames are timed in pairs, each the first in every other one.
struct Pair {
  std::unique_ptr<Renderer> planned, full;
  RenderedFrame planned_frame, full_frame;

  void render(const FrameSample& sample, const SceneState& state, bool planned_first) {
    if (planned_first) planned->render_frame(sample, state, planned_frame);
    full->render_frame(sample, state, full_frame);
    if (!planned_first) planned->render_frame(sample, state, planned_frame);
  }
};

// The fastest frame of each instant, over all repeats: what else the machine does only ever adds to a time.
struct FastestFrames {
  std::vector<double> planned_ms, ratios;
  std::int64_t different = 0;

  void add(Pair& pair, const FrameStep& prepared, int repeats) {
    // The first pair warms up and is compared; probes take another moment for another frame.
    FrameSample sample = prepared.sample();
    const SceneState& state = prepared.scene_state();
    pair.render(sample, state, true);
    different += different_values(pair.planned_frame, pair.full_frame);
    double planned = std::numeric_limits<double>::infinity(), full = planned;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      sample.t_ns = prepared.sample().t_ns + repeat + 1;
      pair.render(sample, state, repeat % 2 == 0);
      planned = std::min(planned, pair.planned_frame.times.frame_ms);
      full = std::min(full, pair.full_frame.times.frame_ms);
    }
    planned_ms.push_back(planned);
    ratios.push_back(full / planned);
  }
};

std::string size_text(std::int64_t bytes) {
  if (bytes == 0) return "0";
  return std::llabs(bytes) < 1'000'000 ? fixed_text(static_cast<double>(bytes) * 1e-3, 1) + " kB"
                                       : fixed_text(static_cast<double>(bytes) * 1e-6, 1) + " MB";
}

std::string with_sign(double value, int decimals) {
  return (value >= 0 ? "+" : "") + fixed_text(value, decimals);
}

std::string row(const LeftOut& entry) {
  return left_aligned(entry.name, kLeftOutWidth) +
         right_aligned(with_sign(entry.added_ms, 2) + " ms", kTimeWidth) +
         right_aligned(with_sign(100 * (entry.time_ratio - 1), 1) + " %", kShareWidth) +
         right_aligned(size_text(entry.added_bytes), kMemoryWidth) + "  " + entry.reason + "\n";
}

Json entry_json(const LeftOut& entry) {
  return {{"name", entry.name},
          {"reason", entry.reason},
          {"added_ms", entry.added_ms},
          {"time_ratio", entry.time_ratio},
          {"added_bytes", entry.added_bytes},
          {"different_values", entry.different_values}};
}

}  // namespace

LeftOutResult measure_left_out(const LeftOutSubject& subject, SessionSequence& sequence, int repeats) {
  const auto renderer = [&](const RenderSettings& settings) {
    return std::make_unique<Renderer>(subject.scene, subject.profile, settings, subject.session_has_camera);
  };
  const std::unique_ptr<Renderer> planned = renderer(subject.settings);
  LeftOutResult result;
  result.instants = sequence.frames();
  result.repeats = repeats;
  const std::vector<std::string> names = left_out(planned->plan());
  std::vector<double> planned_ms;
  const auto measure = [&](const std::vector<std::string>& force) {
    RenderSettings forcing = subject.settings;
    forcing.force = force;
    LeftOut entry;
    FastestFrames times;
    sequence.rewind();
    for (int frame = 0; frame < sequence.frames(); ++frame) {
      const FrameStep& prepared = sequence.prepare(frame);
      // Each with new renderers: where their buffers happen to lie in memory moves a frame by up to 5 %.
      Pair pair{renderer(subject.settings), renderer(forcing), {}, {}};
      if (frame == 0) {
        entry.added_bytes = planned_bytes(pair.full->memory()) - planned_bytes(pair.planned->memory());
      }
      times.add(pair, prepared, repeats);
      const PictureMemory pictures{frame_bytes(pair.planned_frame), camera_bytes(prepared.sample()), 0};
      result.memory = memory_parts(*pair.planned, subject.scene, pictures);
    }
    planned_ms.insert(planned_ms.end(), times.planned_ms.begin(), times.planned_ms.end());
    entry.time_ratio = median(times.ratios);
    entry.added_ms = (entry.time_ratio - 1) * median(times.planned_ms);
    entry.different_values = times.different;
    return entry;
  };
  result.control = measure({});
  result.control.name = kControl;
  result.control.reason = "how far chance moves a row";
  for (const PlanEntry& entry : planned->plan().entries) {
    if (!entry.unneeded || entry.runs) continue;
    result.entries.push_back(measure({entry.name}));
    result.entries.back().name = entry.name;
    result.entries.back().reason = entry.reason;
  }
  result.everything = measure(names);
  result.everything.name = kEverything;
  result.frame_ms = median(planned_ms);
  return result;
}

Json left_out_json(const LeftOutResult& result, const BenchSubject& subject) {
  Json entries = Json::array();
  for (const LeftOut& entry : result.entries) entries.push_back(entry_json(entry));
  Json json{{"format_version", 1},
            {"program", program_with_version()},
            {"left_out", entries},
            {"everything", entry_json(result.everything)},
            {"control", entry_json(result.control)},
            {"frame_ms", result.frame_ms},
            {"instants", result.instants},
            {"repeats", result.repeats},
            {"memory_bytes", memory_json(result.memory)}};
  add_subject(subject, settings_text(subject.settings, subject.session_has_camera), json);
  json["definitions"] = {
      {"frame_ms", "median over instants of the fastest of `repeats` frames as planned"},
      {"time_ratio",
       "median over instants: fastest frame with the entry running / as planned, in alternation"},
      {"added_ms", "(time_ratio - 1) times the median of these fastest frames as planned"},
      {"added_bytes", "memory of the renderer with the entry running, less that as planned"},
      {"different_values", "half-float values of all pictures that differ"}};
  return json;
}

std::string left_out_table(const LeftOutResult& result, const BenchSubject& subject) {
  std::string text =
      subject_text(subject, settings_text(subject.settings, subject.session_has_camera)) + "\nframe " +
      fixed_text(result.frame_ms, 1) + " ms; what it would take more, medians of " +
      counted(result.instants, "instant", "instants") + ", of each the fastest of " +
      counted(result.repeats, "frame", "frames") + "\n\n" + left_aligned("left out", kLeftOutWidth) +
      right_aligned("time", kTimeWidth + kShareWidth) + right_aligned("memory", kMemoryWidth) + "  because\n";
  for (const LeftOut& entry : result.entries) text += row(entry);
  text += row(result.everything) + row(result.control);
  if (changed_picture(result).empty()) text += "pictures: the same, bit for bit, with each of them\n";
  text += "\n" + left_aligned("memory", kLeftOutWidth) + "\n";
  for (const MemoryEntry& entry : result.memory) {
    text +=
        left_aligned(entry.name, kLeftOutWidth) + right_aligned(size_text(entry.bytes), kTimeWidth) + "\n";
  }
  return text + left_aligned("together", kLeftOutWidth) +
         right_aligned(size_text(total_bytes(result.memory)), kTimeWidth) + "\n";
}

std::string changed_picture(const LeftOutResult& result) {
  std::vector<LeftOut> all = result.entries;
  all.insert(all.end(), {result.everything, result.control});
  for (const LeftOut& entry : all) {
    if (entry.different_values == 0) continue;
    return "'" + entry.name + "' changes " + std::to_string(entry.different_values) +
           " values of pictures of a scene that has nothing for it; please report it";
  }
  return "";
}

}  // namespace herr
