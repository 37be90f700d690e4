#include "server/study/report/study_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "server/diagrams/html_text.h"
#include "server/text/base64.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

void put_number(Json& json, const char* key, double value) {
  if (std::isfinite(value)) json[key] = value;
}

void put_text(Json& json, const char* key, const std::string& text) {
  json[key] = clean_text(text);
}

Json interval_json(const Interval& interval) {
  Json json = Json::object();
  put_number(json, "estimate", interval.estimate);
  put_number(json, "lower", interval.lower);
  put_number(json, "upper", interval.upper);
  return json;
}

// {"all": {"rmse": ...}, ...}
Json error_json(const ErrorTable& error) {
  Json json = Json::object();
  for (std::size_t band = 0; band < kBands; ++band) {
    Json metrics = Json::object();
    for (std::size_t metric = 0; metric < kMetrics; ++metric) {
      put_number(metrics, metric_rows()[metric].name, error.value[band][metric]);
    }
    if (!metrics.empty()) json[bands()[band].name] = metrics;
  }
  return json;
}

Json flicker_json(const Flicker& flicker) {
  Json json = Json::object();
  for (std::size_t band = 0; band < kBands; ++band) {
    Json values = Json::object();
    put_number(values, "test", flicker.test[band]);
    put_number(values, "reference", flicker.reference[band]);
    put_number(values, "excess", flicker.excess[band]);
    if (!values.empty()) json[bands()[band].name] = values;
  }
  return json;
}

Json reference_json(const StudyReference& reference) {
  Json json;
  put_text(json, "name", reference.name);
  put_text(json, "settings", reference.settings);
  json["passes"] = reference.passes;
  json["most_passes"] = reference.most_passes;
  json["error"] = error_json(reference.error);
  json["goal_met"] = reference.goal_met;
  put_number(json, "seconds", reference.seconds);
  return json;
}

Json point_json(const StudyPoint& point) {
  Json json;
  put_text(json, "name", point.name);
  put_text(json, "knob", point.knob);
  put_text(json, "base", point.base);
  put_text(json, "value", point.value);
  put_number(json, "n", point.n);
  put_text(json, "flags", point.flags);
  json["frames"] = point.frames;
  if (point.of_default) json["of_default"] = true;
  json["error"] = error_json(point.error);
  if (point.own_error) json["own_error"] = error_json(*point.own_error);
  put_text(json, "own_reference", point.own_reference);
  json["at_floor"] = point.at_floor;
  if (point.bias) json["bias"] = std::isfinite(*point.bias) ? Json(*point.bias) : Json(nullptr);
  json["comparable"] = point.comparable;
  json["time_ratio"] = interval_json(point.time_ratio);
  json["work_ratio"] = interval_json(point.work_ratio);
  put_number(json, "frame_ms", point.frame_ms);
  put_number(json, "pixels_ms", point.pixels_ms);
  put_number(json, "calibration_ms", point.calibration_ms);
  json["counters"] = Json::array();
  for (const auto& [name, value] : point.counters) {
    Json counter;
    put_text(counter, "name", name);
    put_number(counter, "per_frame", value);
    json["counters"].push_back(counter);
  }
  json["on_front"] = point.on_front;
  put_number(json, "front_confidence", point.front_confidence);
  if (point.flicker) json["flicker"] = flicker_json(*point.flicker);
  return json;
}

Json fit_json(const StudyFit& fit) {
  Json json;
  put_text(json, "knob", fit.knob);
  put_text(json, "base", fit.base);
  put_text(json, "against", fit.against);
  json["metric"] = metric_rows()[static_cast<std::size_t>(fit.metric)].name;
  put_text(json, "effort", fit.effort);
  if (fit.fit) {
    Json values{{"p", interval_json(fit.fit->p)}, {"floor", interval_json(fit.fit->floor)}};
    put_number(values, "c", fit.fit->c);
    put_number(values, "relative_rms", fit.fit->relative_rms);
    values["points"] = fit.fit->points;
    json["fit"] = values;
  }
  put_text(json, "theory", fit.theory);
  put_text(json, "remark", fit.remark);
  return json;
}

Json advice_json(const StudyAdvice& advice) {
  Json json = Json::object();
  put_number(json, "most_error", advice.most_error);
  put_text(json, "point", advice.point);
  put_text(json, "sentence", advice.sentence);
  return json;
}

Json aim_json(const StudyAim& aim) {
  Json json;
  put_text(json, "name", aim.name);
  json["measured"] = interval_json(aim.measured);
  put_number(json, "aim", aim.aim);
  json["at_least"] = aim.at_least;
  json["met"] = aim.met;
  put_text(json, "sentence", aim.sentence);
  return json;
}

Json remark_json(const StudyRemark& remark) {
  Json json;
  put_text(json, "knob", remark.knob);
  put_text(json, "text", remark.text);
  return json;
}

Json timing_json(const StudyTiming& timing) {
  Json json{{"pairs", timing.pairs}};
  put_number(json, "spread", timing.spread);
  put_number(json, "preemptions", timing.preemptions);
  if (timing.cpu_share) put_number(json, "cpu_share", *timing.cpu_share);
  put_text(json, "sentence", timing.sentence);
  return json;
}

template <typename Row, typename Write>
Json array_json(const std::vector<Row>& rows, const Write& write) {
  Json json = Json::array();
  for (const Row& row : rows) json.push_back(write(row));
  return json;
}

Json definitions_json() {
  Json metrics = Json::object(), all_bands = Json::object();
  for (const MetricRow& metric : metric_rows()) {
    metrics[metric.name] = std::string(metric.sentence) + " Blind to: " + metric.blind_to;
  }
  for (const Band& band : bands()) {
    all_bands[band.name] = {{"from_deg", band.from_deg}, {"to_deg", band.to_deg}};
  }
  return {
      {"metrics", metrics},
      {"bands", all_bands},
      {"numbers", "one that is not there is not known, or not finite"},
      {"estimate, lower, upper", "95 % interval; without a bound where there is too little data"},
      {"error", "against the picture that endless effort would give"},
      {"own_error", "against endless effort of this knob alone"},
      {"at_floor", "acuity_rmse of all pixels below 3 times that of the reference"},
      {"bias", "RMSE of the mean over many seeds, without the noise left in it"},
      {"work_ratio", "the same of frame times without the stage from samples to viewport pixels"},
      {"comparable", "lit as the default is and on all frames: its error compares with that of the others"},
      {"time_ratio", "frame time over that of the default, of pairs timed side by side; of the default 1"},
      {"timing",
       "of all pairs: spread, by which ratios of one setting differ from pair to pair (1.4826 median "
       "absolute "
       "deviations, a share; those of the default from 1); cpu_share, of the cores that threads could have "
       "had"},
      {"front_confidence", "share of bootstrap draws in which the point is on the Pareto front"},
      {"flicker", "RMS change from frame to frame; excess: of the difference of both changes"},
      {"fit", "error = floor + c n^p"},
      {"passes", "per half of a reference, which is the mean of two halves"},
      {"png", "base64 (RFC 4648)"}};
}

}  // namespace

nlohmann::ordered_json study_frame_json(const StudyFrame& frame) {
  Json json{{"number", frame.number}};
  put_number(json, "time_s", frame.time_s);
  put_number(json, "head_deg_per_s", frame.head_deg_per_s);
  put_number(json, "gaze_deg", frame.gaze_deg);
  return json;
}

nlohmann::ordered_json study_picture_json(const StudyPicture& picture) {
  Json json;
  put_text(json, "title", picture.title);
  put_text(json, "caption", picture.caption);
  json["width_px"] = picture.width_px;
  json["height_px"] = picture.height_px;
  json["png"] = base64_text(std::as_bytes(std::span(picture.png)));
  return json;
}

void put_head(nlohmann::ordered_json& json, const ReportHead& head) {
  put_text(json, "program", head.program);
  put_text(json, "command_line", head.command_line);
  put_text(json, "session", head.session);
  put_text(json, "scene", head.scene);
  put_text(json, "profile", head.profile);
  put_text(json, "cpu", head.cpu);
  put_text(json, "isa", head.isa);
  json["triangles"] = head.triangles;
  json["threads"] = head.threads;
}

nlohmann::ordered_json study_json(const StudyRecord& record) {
  const auto text = [](const std::string& line) { return Json(clean_text(line)); };
  Json json{{"study_version", kStudyVersion}};
  put_head(json, record);
  put_number(json, "minutes_allowed", record.minutes_allowed);
  put_number(json, "minutes_taken", record.minutes_taken);
  put_text(json, "default_settings", record.default_settings);
  if (record.timing) json["timing"] = timing_json(*record.timing);
  json["aims"] = array_json(record.aims, aim_json);
  json["advice"] = array_json(record.advice, advice_json);
  if (!record.advice_note.empty()) put_text(json, "advice_note", record.advice_note);
  if (!record.no_advice.empty()) put_text(json, "no_advice", record.no_advice);
  json["frames"] = array_json(record.frames, study_frame_json);
  json["clip"] = array_json(record.clip, study_frame_json);
  json["references"] = array_json(record.references, reference_json);
  json["points"] = array_json(record.points, point_json);
  json["fits"] = array_json(record.fits, fit_json);
  json["remarks"] = array_json(record.remarks, remark_json);
  json["left_out"] = array_json(record.left_out, text);
  json["dropped"] = array_json(record.dropped, text);
  json["warnings"] = array_json(record.warnings, text);
  json["pictures"] = array_json(record.pictures, study_picture_json);
  json["definitions"] = definitions_json();
  return json;
}

}  // namespace herr
