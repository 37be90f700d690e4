#include "server/study/stability/report/stability_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "server/diagrams/html_text.h"
#include "server/study/report/study_json.h"
#include "server/study/stability/report/stability_verdict.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

void put_clean(Json& json, const char* key, const std::string& text) {
  json[key] = clean_text(text);
}

void put_any_number(Json& json, const std::string& key, double value) {
  if (std::isfinite(value)) {
    json[key] = value;
    return;
  }
  json[key] = nullptr;
  json[key + "_text"] = std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

Json result_json(const RelationResult& result) {
  const Relation& relation = result.relation;
  Json json;
  put_clean(json, "group", result.group);
  put_clean(json, "name", relation.name);
  put_clean(json, "verdict", verdict_text(result));
  put_clean(json, "holds", relation.holds);
  json["kind"] = name_of(relation.kind);
  put_any_number(json, "error", result.error);
  put_any_number(json, "bound", relation.bound);
  put_clean(json, "unit", relation.unit);
  put_clean(json, "bound_from", relation.bound_from);
  put_clean(json, "option", relation.option);
  put_clean(json, "not_applicable", result.not_applicable);
  put_clean(json, "where", result.where);
  put_any_number(json, "seconds", result.seconds);
  return json;
}

Json counts_json(const RelationCounts& counts) {
  return {{"hold", counts.hold},
          {"fail", counts.fail},
          {"fail_of_what_is_off", counts.fail_off},
          {"not_applicable", counts.not_applicable}};
}

Json stability_definitions() {
  return {{"error", "what was measured, in the unit; held to the bound; null with a text: no finite number"},
          {"exact", "no chance is involved, and the bound is derived"},
          {"statistical", "means over at least 16 seeds, held to 4 standard errors"},
          {"measured", "exact, but rounding alone changes more here: held to a multiple of what it changes"},
          {"option", "what must be switched on for the relation to decide; empty: it decides in every run"},
          {"not_applicable", "why the relation was not asked; empty: it was"},
          {"counts, verdict", "follow from the results; not read again"},
          {"png", "base64 (RFC 4648)"}};
}

}  // namespace

Json stability_json(const StabilityRecord& record) {
  Json json{{"stability_version", kStabilityVersion}};
  put_head(json, record);
  put_clean(json, "viewports", record.viewports);
  put_clean(json, "settings", record.settings);
  json["frame"] = study_frame_json(record.frame);
  put_any_number(json, "seconds", record.seconds);
  json["counts"] = counts_json(counts_of(record.results));
  json["results"] = Json::array();
  for (const RelationResult& result : record.results) json["results"].push_back(result_json(result));
  json["warnings"] = Json::array();
  for (const std::string& warning : record.warnings) json["warnings"].push_back(clean_text(warning));
  json["pictures"] = Json::array();
  for (const StudyPicture& picture : record.pictures) json["pictures"].push_back(study_picture_json(picture));
  json["definitions"] = stability_definitions();
  return json;
}

}  // namespace herr
