#include "server/synth/synth_report.h"

#include <cstddef>
#include <nlohmann/json.hpp>

#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(MotionKind kind) {
  return motion_names()[static_cast<std::size_t>(kind)];
}

std::string name_of(GazeKind kind) {
  return gaze_names()[static_cast<std::size_t>(kind)];
}

std::string rows_text(const std::string& stream, const SynthCounts& counts, double hz) {
  std::string text = stream + ": " + counted(counts.rows, "row", "rows") + " at " + shortest_text(hz) + " Hz";
  if (counts.hitches > 0) text += ", " + counted(counts.hitches, "hitch", "hitches");
  return text;
}

Json rows_json(const SynthCounts& counts, double hz) {
  return {{"rows", counts.rows}, {"rate_hz", hz}, {"hitches", counts.hitches}};
}

}  // namespace

std::string synth_motion_text(const SynthOptions& options) {
  std::string text = "head " + name_of(options.motion) + ", gaze " + name_of(options.gaze);
  if (!options.room.empty()) text += ", room " + printable(options.room.filename().string());
  return text;
}

std::string synth_text(const SynthOptions& options, const SynthReport& report) {
  std::string text = "session: " + printable(report.out.string()) + ", " + shortest_text(options.duration_s) +
                     " s, " + synth_motion_text(options) + "\n" +
                     rows_text("poses", report.poses, options.pose_hz) + "\n" +
                     rows_text("gaze", report.gaze, options.gaze_hz) + ", " +
                     counted(report.gaze.saccades, "saccade", "saccades") + ", " +
                     counted(report.gaze.blinks, "blink", "blinks") + " (" +
                     counted(report.gaze.lost_rows, "row", "rows") + " not valid)\n";
  if (report.camera.rows > 0) text += rows_text("camera", report.camera, options.camera_hz) + "\n";
  for (const std::string& warning : report.findings.warnings) text += "warning: " + warning + "\n";
  return text;
}

std::string synth_json(const SynthOptions& options, const SynthReport& report) {
  Json gaze = rows_json(report.gaze, options.gaze_hz);
  gaze["kind"] = name_of(options.gaze);
  gaze["saccades"] = report.gaze.saccades;
  gaze["blinks"] = report.gaze.blinks;
  gaze["lost_rows"] = report.gaze.lost_rows;
  Json poses = rows_json(report.poses, options.pose_hz);
  poses["kind"] = name_of(options.motion);
  Json json{{"session", printable(report.out.string())},
            {"seed", options.seed},
            {"duration_s", options.duration_s},
            {"poses", poses},
            {"gaze", gaze}};
  if (report.camera.rows > 0) json["camera"] = rows_json(report.camera, options.camera_hz);
  json["warnings"] = report.findings.warnings;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace herr
