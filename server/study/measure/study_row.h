// One setting at one frame, measured: a row of study.csv, appended as soon as it is known. Before:
// measure_setting. After: study_points, and a study that goes on, which reads the rows that are there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/frame_counters.h"
#include "server/study/error/flicker.h"
#include "server/study/error/metrics.h"

namespace herr {

struct StudyRow {
  std::string name, knob, base, value, flags;  // StudySetting
  double n = 0;
  std::int64_t frame = 0;
  std::string reference, own_reference;  // names; empty: none
  std::optional<ErrorTable> error, own_error;
  std::optional<double> bias;
  // Of pairs: frame time, and frame time without the stage from samples to pixels, each ln(this / default).
  std::vector<double> log_ratios, work_log_ratios;
  double frame_ms = 0, pixels_ms = 0, calibration_ms = 0;  // medians
  double cpu_ms = 0, cores_ms = 0, preemptions = 0;        // of all these frames (paired_times.h)
  FrameCounters counters;
  std::optional<Flicker> flicker;  // of the clip that begins with this frame
  double seconds = 0;              // that measuring took
};

// Both end with a line break.
std::string study_csv_header();
std::string study_csv_row(const StudyRow& row);
// The row of a line (without its line break), bit for bit; none when it is no row of this header.
std::optional<StudyRow> study_row_of(std::string_view line);

}  // namespace herr
