#include "server/convert/convert_report.h"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "server/text/number_text.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

std::string shown(const std::filesystem::path& path) {
  return printable(path.string());
}

// Counts that are not 0, by what they mean.
std::vector<std::pair<std::string, std::int64_t>> remarks(const ImportedStream& stream, bool is_gaze) {
  const std::vector<std::pair<std::string, std::int64_t>> all{
      {is_gaze ? "rows without gaze (blinks, lost pupils), written as not valid"
               : "rows without tracking, left out",
       stream.lost_rows},
      {"rows with one eye only", stream.one_eye_rows},
      {"rows repeat the one before: the sensor is slower than the log", stream.repeated_values},
      {"rows left out: the stamp repeats the one before", stream.repeated_stamps},
      {"rows left out: the stamp goes backwards", stream.backward_stamps},
      {"bad rows left out", stream.bad_rows},
      {"rows normalised: the length was off by more than rounding", stream.normalised_rows},
      {"blank lines", stream.blank_lines}};
  std::vector<std::pair<std::string, std::int64_t>> found;
  for (const auto& remark : all)
    if (remark.second > 0) found.push_back(remark);
  return found;
}

std::string stream_text(const std::string& name, const ImportedStream& stream, bool is_gaze) {
  const double seconds = static_cast<double>(stream.last_ns - stream.first_ns) * kSecondsPerNs;
  std::string text =
      name + ": " + std::to_string(stream.rows) + " rows over " + fixed_text(seconds, 2) + " s";
  if (stream.rows > 1) text += ", " + fixed_text(stream.rate_hz(), 1) + " Hz";
  text += "  (" + shown(stream.file) + ")\n";
  if (const std::int64_t hitches = stream.intervals.hitches(); hitches > 0)
    text += "  " + std::to_string(hitches) + " intervals of more than 1.5 times the usual one, the widest " +
            fixed_text(static_cast<double>(stream.intervals.widest_ns()) * 1e-6, 1) + " ms before line " +
            std::to_string(stream.intervals.widest_line()) + "\n";
  for (const auto& [meaning, count] : remarks(stream, is_gaze))
    text += "  " + std::to_string(count) + " " + meaning + "\n";
  return text;
}

Json stream_json(const ImportedStream& stream) {
  return {{"file", printable(stream.file.string())},
          {"rows", stream.rows},
          {"first_ns", stream.first_ns},
          {"last_ns", stream.last_ns},
          {"rate_hz", stream.rate_hz()},
          {"hitches", stream.intervals.hitches()},
          {"widest_interval_ns", stream.intervals.widest_ns()},
          {"widest_interval_line", stream.intervals.widest_line()},
          {"lost_rows", stream.lost_rows},
          {"one_eye_rows", stream.one_eye_rows},
          {"repeated_values", stream.repeated_values},
          {"repeated_stamps_left_out", stream.repeated_stamps},
          {"backward_stamps_left_out", stream.backward_stamps},
          {"bad_rows_left_out", stream.bad_rows},
          {"normalised_rows", stream.normalised_rows},
          {"blank_lines", stream.blank_lines}};
}

std::vector<std::string> all_warnings(const ConvertReport& report) {
  std::vector<std::string> warnings = report.rows.warnings;
  warnings.insert(warnings.end(), report.findings.warnings.begin(), report.findings.warnings.end());
  return warnings;
}

}  // namespace

std::string convert_text(const ConvertReport& report) {
  std::string text = "session: " + shown(report.out) + "\n";
  text += stream_text("poses", report.rows.poses, false);
  if (report.rows.has_gaze)
    text +=
        stream_text(report.rows.gaze_combined ? "gaze (combined)" : "gaze (per eye)", report.rows.gaze, true);
  if (report.camera_rows > 0)
    text += "camera: " + std::to_string(report.camera_rows) + " frames from " +
            std::to_string(report.pictures) + " pictures\n";
  for (const std::string& warning : all_warnings(report)) text += "note: " + warning + "\n";
  return text;
}

std::string convert_json(const ConvertReport& report) {
  Json json{{"session", shown(report.out)}, {"map", report.map}, {"poses", stream_json(report.rows.poses)}};
  if (report.rows.has_gaze) {
    json["gaze"] = stream_json(report.rows.gaze);
    json["gaze"]["kind"] = report.rows.gaze_combined ? "combined" : "per_eye";
  }
  json["camera"] = {{"frames", report.camera_rows}, {"pictures", report.pictures}};
  json["warnings"] = all_warnings(report);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace herr
