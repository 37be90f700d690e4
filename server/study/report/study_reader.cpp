// read_study() of study_json.h.
#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "server/study/report/study_json.h"
#include "server/text/base64.h"
#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kNotFinite = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr int kMostCount = std::numeric_limits<int>::max();
constexpr std::size_t kMostRows = 10'000;  // of each array
constexpr std::size_t kMostPictures = 100;
constexpr int kMostPicturePixels = 1 << 16;  // along one side
constexpr std::size_t kMostTextBytes = 64 << 10;

double number_of(const JsonObject& object, const char* key, double otherwise = kNotFinite) {
  return object.number_or(key, -kLargest, kLargest, otherwise);
}

int count_of(const JsonObject& object, const char* key, int most = kMostCount) {
  return static_cast<int>(object.integer(key, 0, most));
}

std::string bounded_text(const JsonObject& object, const char* key) {
  std::string text = object.text(key);
  if (text.size() > kMostTextBytes) object.fail(key, "has more than 65536 bytes", "shorten it");
  return text;
}

bool truth_of(const JsonObject& object, const char* key) {
  object.value(key);  // throws when it is missing
  return object.boolean_or(key, false);
}

std::vector<JsonObject> rows_of(const JsonObject& object, const char* key, std::size_t most = kMostRows) {
  const std::size_t count = object.value(key).size();
  if (count > most) {
    object.fail(key, "has " + std::to_string(count) + " elements",
                "a study has at most " + std::to_string(most));
  }
  return object.objects(key);
}

template <typename Row, typename Read>
std::vector<Row> read_rows(const JsonObject& object, const char* key, const Read& read,
                           std::size_t most = kMostRows) {
  std::vector<Row> rows;
  for (const JsonObject& row : rows_of(object, key, most)) rows.push_back(read(row));
  return rows;
}

// The place of a name in a list of rows with names; throws for one that is not there.
template <typename Rows>
std::size_t place_of(const Rows& rows, const std::string& name, const JsonObject& object, const char* key) {
  std::vector<std::string> known;
  for (const auto& row : rows) known.emplace_back(row.name);
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) {
    object.fail(key, "is not known: " + printable(name), key_remedy(name, known));
  }
  return static_cast<std::size_t>(found - known.begin());
}

Interval read_interval(const JsonObject& object, const char* key) {
  const JsonObject interval = object.object(key);
  interval.allow_only({"estimate", "lower", "upper"});
  return {number_of(interval, "estimate"), number_of(interval, "lower", -kUnbounded),
          number_of(interval, "upper", kUnbounded)};
}

ErrorTable read_error(const JsonObject& object, const char* key) {
  ErrorTable table;
  const JsonObject error = object.object(key);
  for (const auto& [band, unused_value] : object.value(key).items()) {
    const std::size_t band_place = place_of(bands(), band, error, band.c_str());
    const JsonObject metrics = error.object(band.c_str());
    for (const auto& [metric, unused_number] : error.value(band.c_str()).items()) {
      table.value[band_place][place_of(metric_rows(), metric, metrics, metric.c_str())] =
          metrics.number(metric.c_str(), -kLargest, kLargest);
    }
  }
  return table;
}

Flicker read_flicker(const JsonObject& object, const char* key) {
  Flicker flicker;
  for (auto* values : {&flicker.test, &flicker.reference, &flicker.excess}) values->fill(kNotFinite);
  const JsonObject all = object.object(key);
  for (const auto& [band, unused_value] : object.value(key).items()) {
    const std::size_t place = place_of(bands(), band, all, band.c_str());
    const JsonObject values = all.object(band.c_str());
    values.allow_only({"test", "reference", "excess"});
    flicker.test[place] = number_of(values, "test");
    flicker.reference[place] = number_of(values, "reference");
    flicker.excess[place] = number_of(values, "excess");
  }
  return flicker;
}

StudyReference read_reference(const JsonObject& object) {
  object.allow_only({"name", "settings", "passes", "most_passes", "error", "goal_met", "seconds"});
  return {bounded_text(object, "name"),    bounded_text(object, "settings"), count_of(object, "passes"),
          count_of(object, "most_passes"), read_error(object, "error"),      truth_of(object, "goal_met"),
          number_of(object, "seconds")};
}

std::pair<std::string, double> read_counter(const JsonObject& object) {
  object.allow_only({"name", "per_frame"});
  return {bounded_text(object, "name"), number_of(object, "per_frame")};
}

StudyPoint read_point(const JsonObject& object) {
  object.allow_only({"name",          "knob",       "base",
                     "value",         "n",          "flags",
                     "frames",        "error",      "own_error",
                     "own_reference", "at_floor",   "bias",
                     "comparable",    "time_ratio", "work_ratio",
                     "frame_ms",      "pixels_ms",  "calibration_ms",
                     "counters",      "on_front",   "front_confidence",
                     "flicker",       "of_default"});
  StudyPoint point;
  point.name = bounded_text(object, "name");
  point.knob = bounded_text(object, "knob");
  point.base = bounded_text(object, "base");
  point.value = bounded_text(object, "value");
  point.n = number_of(object, "n");
  point.flags = bounded_text(object, "flags");
  point.frames = count_of(object, "frames");
  point.of_default = object.boolean_or("of_default", false);
  point.error = read_error(object, "error");
  if (object.has("own_error")) point.own_error = read_error(object, "own_error");
  point.own_reference = bounded_text(object, "own_reference");
  point.at_floor = truth_of(object, "at_floor");
  if (object.has("bias"))
    point.bias = object.value("bias").is_null() ? kNotFinite : number_of(object, "bias");
  point.comparable = object.boolean_or("comparable", false);
  point.time_ratio = read_interval(object, "time_ratio");
  point.work_ratio = read_interval(object, "work_ratio");
  point.frame_ms = number_of(object, "frame_ms");
  point.pixels_ms = number_of(object, "pixels_ms");
  point.calibration_ms = number_of(object, "calibration_ms");
  point.counters = read_rows<std::pair<std::string, double>>(object, "counters", read_counter);
  point.on_front = truth_of(object, "on_front");
  point.front_confidence = number_of(object, "front_confidence");
  if (object.has("flicker")) point.flicker = read_flicker(object, "flicker");
  return point;
}

PowerFit read_power_fit(const JsonObject& object) {
  object.allow_only({"p", "floor", "c", "relative_rms", "points"});
  return {read_interval(object, "p"), read_interval(object, "floor"), number_of(object, "c"),
          number_of(object, "relative_rms"), count_of(object, "points")};
}

StudyFit read_fit(const JsonObject& object) {
  object.allow_only({"knob", "base", "against", "metric", "effort", "fit", "theory", "remark"});
  StudyFit fit;
  fit.knob = bounded_text(object, "knob");
  fit.base = bounded_text(object, "base");
  fit.against = bounded_text(object, "against");
  fit.metric = static_cast<Metric>(place_of(metric_rows(), object.text("metric"), object, "metric"));
  fit.effort = bounded_text(object, "effort");
  if (object.has("fit")) fit.fit = read_power_fit(object.object("fit"));
  fit.theory = bounded_text(object, "theory");
  fit.remark = bounded_text(object, "remark");
  return fit;
}

StudyRemark read_remark(const JsonObject& object) {
  object.allow_only({"knob", "text"});
  return {bounded_text(object, "knob"), bounded_text(object, "text")};
}

StudyAdvice read_advice(const JsonObject& object) {
  object.allow_only({"most_error", "point", "sentence"});
  return {number_of(object, "most_error"), bounded_text(object, "point"), bounded_text(object, "sentence")};
}

StudyAim read_aim(const JsonObject& object) {
  object.allow_only({"name", "measured", "aim", "at_least", "met", "sentence"});
  return {bounded_text(object, "name"), read_interval(object, "measured"), number_of(object, "aim"),
          truth_of(object, "at_least"), truth_of(object, "met"),           bounded_text(object, "sentence")};
}

StudyTiming read_timing(const JsonObject& object) {
  object.allow_only({"pairs", "spread", "preemptions", "cpu_share", "sentence"});
  StudyTiming timing;
  timing.pairs = count_of(object, "pairs");
  timing.spread = number_of(object, "spread");
  timing.preemptions = number_of(object, "preemptions");
  timing.sentence = bounded_text(object, "sentence");
  if (object.has("cpu_share")) timing.cpu_share = number_of(object, "cpu_share");
  return timing;
}

void check_study_version(const JsonObject& object) {
  const std::int64_t version = object.integer("study_version", 0, kMostCount);
  if (version == kStudyVersion) return;
  object.fail("study_version",
              "is " + std::to_string(version) + ", this program reads " + std::to_string(kStudyVersion),
              "read it with the program that wrote it, or measure again");
}

void read_subject(const JsonObject& object, StudyRecord& record) {
  read_head(object, record);
  record.minutes_allowed = number_of(object, "minutes_allowed");
  record.minutes_taken = number_of(object, "minutes_taken");
  record.default_settings = bounded_text(object, "default_settings");
  if (object.has("timing")) record.timing = read_timing(object.object("timing"));
}

}  // namespace

void read_head(const JsonObject& object, ReportHead& head) {
  head.program = bounded_text(object, "program");
  head.command_line = bounded_text(object, "command_line");
  head.session = bounded_text(object, "session");
  head.scene = bounded_text(object, "scene");
  head.profile = bounded_text(object, "profile");
  head.cpu = bounded_text(object, "cpu");
  head.isa = bounded_text(object, "isa");
  head.triangles = object.integer("triangles", 0, std::numeric_limits<std::int64_t>::max());
  head.threads = count_of(object, "threads");
}

std::vector<std::string> read_study_lines(const JsonObject& object, const char* key) {
  const nlohmann::json& found = object.value(key);
  if (!found.is_array() || found.size() > kMostRows) {
    object.fail(key, "is not an array of at most 10000 texts", "write [\"...\", ...]");
  }
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::string element = std::string(key) + "[" + std::to_string(i) + "]";
    const nlohmann::json line = {{element, found[i]}};  // so that the error names the field
    lines.push_back(bounded_text(JsonObject(line, object.file(), object.where()), element.c_str()));
  }
  return lines;
}

StudyFrame read_study_frame(const JsonObject& object) {
  object.allow_only({"number", "time_s", "head_deg_per_s", "gaze_deg"});
  return {object.integer("number", 0, std::numeric_limits<std::int64_t>::max()), number_of(object, "time_s"),
          number_of(object, "head_deg_per_s"), number_of(object, "gaze_deg")};
}

StudyPicture read_study_picture(const JsonObject& object) {
  constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  object.allow_only({"title", "caption", "width_px", "height_px", "png"});
  StudyPicture picture{bounded_text(object, "title"),
                       bounded_text(object, "caption"),
                       count_of(object, "width_px", kMostPicturePixels),
                       count_of(object, "height_px", kMostPicturePixels),
                       {}};
  const auto bytes = bytes_from_base64(object.text("png"));
  if (!bytes) object.fail("png", "is not base64", "write the report again");
  for (const std::byte byte : *bytes) picture.png.push_back(std::to_integer<std::uint8_t>(byte));
  const bool whole = picture.png.size() >= kPngSignature.size() &&
                     std::equal(kPngSignature.begin(), kPngSignature.end(), picture.png.begin());
  if (!picture.png.empty() && !whole) object.fail("png", "is no PNG file", "write the report again");
  return picture;
}

StudyRecord read_study(const nlohmann::json& document, const std::string& source) {
  const JsonObject object(document, source, "");
  check_study_version(object);
  object.allow_only({"study_version",
                     "program",
                     "command_line",
                     "session",
                     "scene",
                     "profile",
                     "cpu",
                     "isa",
                     "triangles",
                     "threads",
                     "minutes_allowed",
                     "minutes_taken",
                     "default_settings",
                     "timing",
                     "aims",
                     "advice",
                     "advice_note",
                     "no_advice",
                     "frames",
                     "clip",
                     "references",
                     "points",
                     "fits",
                     "remarks",
                     "left_out",
                     "dropped",
                     "warnings",
                     "pictures",
                     "definitions"});
  StudyRecord record;
  read_subject(object, record);
  record.frames = read_rows<StudyFrame>(object, "frames", read_study_frame);
  record.clip = read_rows<StudyFrame>(object, "clip", read_study_frame);
  record.references = read_rows<StudyReference>(object, "references", read_reference);
  record.points = read_rows<StudyPoint>(object, "points", read_point);
  record.fits = read_rows<StudyFit>(object, "fits", read_fit);
  record.advice = read_rows<StudyAdvice>(object, "advice", read_advice);
  if (object.has("advice_note")) record.advice_note = bounded_text(object, "advice_note");
  if (object.has("no_advice")) record.no_advice = bounded_text(object, "no_advice");
  record.aims = read_rows<StudyAim>(object, "aims", read_aim);
  record.remarks = read_rows<StudyRemark>(object, "remarks", read_remark);
  record.left_out = read_study_lines(object, "left_out");
  record.dropped = read_study_lines(object, "dropped");
  record.warnings = read_study_lines(object, "warnings");
  record.pictures = read_rows<StudyPicture>(object, "pictures", read_study_picture, kMostPictures);
  return record;
}

}  // namespace herr
