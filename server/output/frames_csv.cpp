#include "server/output/frames_csv.h"

#include <cstddef>

#include "server/statistics/number_text.h"

namespace herr {
namespace {

constexpr int kDecimals = 6;  // nanoseconds in a column of milliseconds

void cell(std::string& row, const std::string& text) {
  if (!row.empty()) row += ',';
  row += text;
}

void cell(std::string& row, double value) {
  cell(row, fixed_text(value, kDecimals));
}

void cell(std::string& row, std::int64_t value) {
  cell(row, std::to_string(value));
}

void cell(std::string& row, const std::optional<double>& value) {
  cell(row, value ? fixed_text(*value, kDecimals) : std::string());
}

}  // namespace

std::string frames_csv_header() {
  std::string row = "frame,t_ns,frame_ms";
  for (std::size_t i = 0; i < kStageCount; ++i) {
    cell(row, std::string(name_of(static_cast<Stage>(i))) + "_ms");
  }
  row +=
      ",sample_ms,write_ms,wait_ms,motion_to_photon_ms,pose_age_ms,gaze_age_ms,camera_age_ms,pose_source,"
      "gaze_source_left,"
      "gaze_source_right,theta_max_left_deg,theta_max_right_deg,missed,primary_rays,shadow_rays,"
      "catcher_shadow_rays,mirror_rays,mirror_shadow_rays,polar_samples,viewport_pixels,invalid_rays,"
      "nonfinite_values,commits,dropped_frames,repeated_ticks";
  return row + "\n";
}

std::string frames_csv_row(const FrameRecord& record) {
  std::string row;
  cell(row, record.frame);
  cell(row, record.t_ns);
  cell(row, record.times.frame_ms);
  for (const double ms : record.times.ms) cell(row, ms);
  cell(row, record.sample_ms);
  cell(row, record.write_ms);
  cell(row, record.wait_ms);
  for (const auto& value :
       {record.motion_to_photon_ms, record.pose_age_ms, record.gaze_age_ms, record.camera_age_ms}) {
    cell(row, value);
  }
  cell(row, std::string(name_of(record.pose_source)));
  for (const SampleSource source : record.gaze_source) cell(row, std::string(name_of(source)));
  for (const double angle : record.theta_max_deg) cell(row, angle);
  cell(row, std::int64_t{record.missed ? 1 : 0});
  const FrameCounters& counters = record.counters;
  for (const std::int64_t value :
       {counters.primary_rays, counters.shadow_rays, counters.catcher_shadow_rays, counters.mirror_rays,
        counters.mirror_shadow_rays, counters.polar_samples, counters.viewport_pixels, counters.invalid_rays,
        counters.nonfinite_values + record.nonfinite_pictures, counters.commits, record.dropped_frames,
        record.repeated_ticks}) {
    cell(row, value);
  }
  return row + "\n";
}

}  // namespace herr
