#include "server/results/frames_csv.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr int kDecimals = 6;  // nanoseconds in a column of milliseconds

// Calls visit(name, value) for each column in its order; header, rows and reader all follow this list.
template <typename Record, typename Visit>
void for_each_column(Record& record, Visit&& visit) {
  visit("frame", record.frame);
  visit("t_ns", record.t_ns);
  visit("frame_ms", record.times.frame_ms);
  visit("period_ms", record.period_ms);
  for (std::size_t i = 0; i < kStageCount; ++i) {
    visit(std::string(name_of(static_cast<Stage>(i))) + "_ms", record.times.ms[i]);
  }
  visit("sample_ms", record.sample_ms);
  visit("write_ms", record.write_ms);
  visit("wait_ms", record.wait_ms);
  visit("cpu_ms", record.cpu_ms);
  visit("motion_to_photon_ms", record.motion_to_photon_ms);
  visit("pose_age_ms", record.pose_age_ms);
  visit("gaze_age_ms", record.gaze_age_ms);
  visit("camera_age_ms", record.camera_age_ms);
  visit("pose_source", record.pose_source);
  visit("gaze_source_left", record.gaze_source[0]);
  visit("gaze_source_right", record.gaze_source[1]);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::string name = eye == 0 ? "gaze_left_" : "gaze_right_";
    visit(name + "x", record.gaze_in_head[eye].x);
    visit(name + "y", record.gaze_in_head[eye].y);
    visit(name + "z", record.gaze_in_head[eye].z);
  }
  visit("theta_max_left_deg", record.theta_max_deg[0]);
  visit("theta_max_right_deg", record.theta_max_deg[1]);
  visit("k_radial_left_per_deg", record.k_radial[0]);
  visit("k_radial_right_per_deg", record.k_radial[1]);
  visit("k_angular_left_per_deg", record.k_angular[0]);
  visit("k_angular_right_per_deg", record.k_angular[1]);
  visit("k_angular_at_left_deg", record.k_angular_at_deg[0]);
  visit("k_angular_at_right_deg", record.k_angular_at_deg[1]);
  visit("missed", record.missed);
  auto& decision = record.decision;
  visit("polar_width", decision.quality.polar_width);
  visit("polar_height", decision.quality.polar_height);
  visit("light_samples", decision.quality.light_samples);
  visit("allowed_probes", decision.quality.probes);
  visit("quality_reason", decision.reason);
  visit("quality_aim_ms", decision.aim_ms);
  visit("quality_predicted_ms", decision.predicted_ms);
  visit("head_deg_s", record.head_deg_s);
  visit("feed_turn_arcmin", record.feed_turn_arcmin);
  visit("feed_shift_arcmin", record.feed_shift_arcmin);
  visit("misregistration_arcmin", record.misregistration_arcmin);
  for_each_counter(record.counters, visit);
  visit("nonfinite_picture_values", record.nonfinite_pictures);
  visit("commit_ms", record.times.commit_ms);
  visit("views_ms", record.times.views_ms);
  visit("outside_ms", record.times.outside_ms);
  visit("active_probes", record.probes.active);
  visit("relocated_probes", record.probes.relocated);
  visit("inactive_probes", record.probes.inactive);
  visit("updated_probes", record.probes.updated);
  visit("reacting_probes", record.probes.reacting);
  visit("probe_change_share", record.probes.variability);
  visit("dropped_frames", record.dropped_frames);
  visit("repeated_ticks", record.repeated_ticks);
  visit("preemptions", record.preemptions);
  visit("miss_cause", record.cause);
  visit("clipped_pixels", record.clipped_pixels);
  visit("stutter", record.stutter);  // stays last: one character, so that no cut row reads as a whole one
}

std::string text_of(std::int64_t value) {
  return std::to_string(value);
}
std::string text_of(int value) {
  return std::to_string(value);
}
std::string text_of(QualityReason reason) {
  return name_of(reason);
}
std::string text_of(MissCause cause) {
  return name_of(cause);
}
std::string text_of(const std::optional<std::int64_t>& value) {
  return value ? std::to_string(*value) : std::string();
}
std::string text_of(bool value) {
  return value ? "1" : "0";
}
std::string text_of(double value) {
  return fixed_text(value, kDecimals);
}
std::string text_of(const std::optional<double>& value) {
  return value ? fixed_text(*value, kDecimals) : std::string();
}
std::string text_of(SampleSource source) {
  return name_of(source);
}

// Whole cells only: what stays unread makes the cell bad.
template <typename Number>
bool read_number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool read(std::string_view text, std::int64_t& value) {
  return read_number(text, value);
}
bool read(std::string_view text, int& value) {
  return read_number(text, value);
}
bool read(std::string_view text, QualityReason& reason) {
  for (std::size_t i = 0; i < kQualityReasons; ++i) {
    reason = static_cast<QualityReason>(i);
    if (text == name_of(reason)) return true;
  }
  return false;
}
bool read(std::string_view text, MissCause& cause) {
  for (int i = 0; i < kMissCauses; ++i) {
    cause = static_cast<MissCause>(i);
    if (text == name_of(cause)) return true;
  }
  return false;
}
bool read(std::string_view text, bool& value) {
  value = text == "1";
  return value || text == "0";
}
bool read(std::string_view text, double& value) {
  return read_number(text, value) && std::isfinite(value);
}
template <typename Number>
bool read(std::string_view text, std::optional<Number>& value) {
  if (text.empty()) return true;
  return read(text, value.emplace());
}
bool read(std::string_view text, SampleSource& source) {
  for (const SampleSource known : {SampleSource::exact, SampleSource::held, SampleSource::interpolated,
                                   SampleSource::predicted, SampleSource::gliding, SampleSource::centred}) {
    source = known;
    if (text == name_of(known)) return true;
  }
  return false;
}

}  // namespace

std::string frames_csv_header() {
  std::string row;
  const FrameRecord record;
  for_each_column(record, [&row](const std::string& name, const auto&) { row += name + ','; });
  row.back() = '\n';
  return row;
}

std::string frames_csv_row(const FrameRecord& record) {
  std::string row;
  for_each_column(record, [&row](const std::string&, const auto& value) { row += text_of(value) + ','; });
  row.back() = '\n';
  return row;
}

std::optional<FrameRecord> frame_record_of(std::string_view row) {
  FrameRecord record;
  bool good = true, more = true;
  for_each_column(record, [&](const std::string&, auto& value) {
    const std::size_t comma = row.find(',');
    good = good && more && read(row.substr(0, comma), value);
    more = comma != std::string_view::npos;
    row.remove_prefix(more ? comma + 1 : row.size());
  });
  if (!good || more) return std::nullopt;
  return record;
}

}  // namespace herr
