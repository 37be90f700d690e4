// Average frame times by size of the polar buffer and number of light samples: the form of Table 1 of the
// paper ("Performance Measurements", averages of 10 seconds), with frame / bare beside each.
// Before: bench_command opened session and scene. After: printed, for people or as JSON.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "renderer/bench_frame.h"
#include "server/bench/bench_subject.h"

namespace herr {

inline constexpr std::array<int, 3> kTableLightSamples{1, 64, 256};

struct FrameTimeRow {
  int polar_width = 788, polar_height = 768;  // per eye
  std::array<BenchRun, kTableLightSamples.size()> cells;
  // What renderer, scene and pictures of each cell hold.
  std::array<std::int64_t, kTableLightSamples.size()> memory_bytes{};
  bool acuity = false;  // of each frame what it needs, up to the size above
};

// The sizes to measure: that of `settings` alone where it was asked for, else the paper's two.
std::vector<FrameTimeRow> empty_table(const RenderSettings& settings, bool one_size);

nlohmann::ordered_json frame_times_json(const std::vector<FrameTimeRow>& rows, const BenchSubject& subject,
                                        double seconds);
std::string frame_times_table(const std::vector<FrameTimeRow>& rows, const BenchSubject& subject,
                              double seconds);

}  // namespace herr
