// What the frame plan leaves out of a scene, and what that saves: each stage and kernel feature is forced
// on in a second renderer, whose frames are timed in alternation with those of the planned one. Before:
// bench_command opened session and scene. After: printed, for people or as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "renderer/bench_frame.h"
#include "server/bench/bench_subject.h"
#include "server/bench/session_sequence.h"

namespace herr {

struct LeftOut {
  std::string name, reason;  // as the plan's entry
  double added_ms = 0;       // to the median frame, were it to run; noise around 0 may be negative
  double time_ratio = 1;     // median over instants of the fastest frame with it / without it
  std::int64_t added_bytes = 0;
  std::int64_t different_values = 0;  // of all pictures: 0, or the plan has changed a picture
};

struct LeftOutResult {
  double frame_ms = 0;  // median over instants of the fastest frame, as planned
  int instants = 0, repeats = 0;
  std::vector<LeftOut> entries;
  LeftOut everything;  // all of them at once
  LeftOut control;     // nothing: two renderers of the same plan, to see the noise
  MemoryUse memory;    // as planned
};

// What its renderers are built from.
struct LeftOutSubject {
  const Scene& scene;  // that the sequence brings to each frame's time
  const DisplayProfile& profile;
  const RenderSettings& settings;
  bool session_has_camera = false;
};

// With each entry the whole sequence, each frame `repeats` times. Throws as Renderer.
LeftOutResult measure_left_out(const LeftOutSubject& subject, SessionSequence& sequence, int repeats);

nlohmann::ordered_json left_out_json(const LeftOutResult& result, const BenchSubject& subject);
std::string left_out_table(const LeftOutResult& result, const BenchSubject& subject);
// One line that names the first entry whose pictures differ from the planned ones; empty when there is none.
std::string changed_picture(const LeftOutResult& result);

}  // namespace herr
