// read_stability() of stability_json.h.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "server/study/report/study_json.h"
#include "server/study/stability/report/stability_json.h"
#include "server/study/stability/report/stability_verdict.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr double kLargestNumber = std::numeric_limits<double>::max();
constexpr std::size_t kMostResults = 10'000, kMostShownPictures = 100;

double any_number(const JsonObject& object, const std::string& key) {
  if (!object.value(key.c_str()).is_null())
    return object.number(key.c_str(), -kLargestNumber, kLargestNumber);
  const std::string text_key = key + "_text";
  const std::string text = object.text(text_key.c_str());
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  object.fail(text_key.c_str(), "is no number that is not finite", "write nan, inf or -inf");
}

RelationKind kind_of(const JsonObject& object) {
  const std::string text = object.text("kind");
  for (const RelationKind kind : {RelationKind::exact, RelationKind::statistical, RelationKind::measured}) {
    if (text == name_of(kind)) return kind;
  }
  object.fail("kind", "is none of exact, statistical and measured", "write one of them");
}

RelationResult read_result(const JsonObject& object) {
  object.allow_only({"group", "name", "verdict", "holds", "kind", "error", "error_text", "bound",
                     "bound_text", "unit", "bound_from", "option", "not_applicable", "where", "seconds",
                     "seconds_text"});
  RelationResult result;
  result.group = object.text("group");
  result.relation.name = object.text("name");
  result.relation.holds = object.text("holds");
  result.relation.kind = kind_of(object);
  result.relation.bound = any_number(object, "bound");
  result.relation.unit = object.text("unit");
  result.relation.bound_from = object.text("bound_from");
  result.relation.option = object.text("option");
  result.not_applicable = object.text("not_applicable");
  result.error = any_number(object, "error");
  result.where = object.text("where");
  result.seconds = any_number(object, "seconds");
  return result;
}

std::vector<JsonObject> bounded_objects(const JsonObject& object, const char* key, std::size_t most) {
  const std::size_t count = object.value(key).size();
  if (count > most) {
    object.fail(key, "has " + std::to_string(count) + " elements",
                "a report has at most " + std::to_string(most));
  }
  return object.objects(key);
}

void check_stability_version(const JsonObject& object) {
  const std::int64_t version = object.integer("stability_version", 0, std::numeric_limits<int>::max());
  if (version == kStabilityVersion) return;
  object.fail("stability_version",
              "is " + std::to_string(version) + ", this program reads " + std::to_string(kStabilityVersion),
              "read it with the program that wrote it, or ask again");
}

}  // namespace

bool is_stability_json(const nlohmann::json& document) {
  return document.is_object() && document.contains("stability_version");
}

StabilityRecord read_stability(const nlohmann::json& document, const std::string& source) {
  const JsonObject object(document, source, "");
  check_stability_version(object);
  object.allow_only({"stability_version",
                     "program",
                     "command_line",
                     "session",
                     "scene",
                     "profile",
                     "viewports",
                     "cpu",
                     "isa",
                     "triangles",
                     "threads",
                     "settings",
                     "frame",
                     "seconds",
                     "seconds_text",
                     "counts",
                     "results",
                     "warnings",
                     "pictures",
                     "definitions"});
  StabilityRecord record;
  read_head(object, record);
  record.viewports = object.text("viewports");
  record.settings = object.text("settings");
  record.frame = read_study_frame(object.object("frame"));
  record.seconds = any_number(object, "seconds");
  for (const JsonObject& row : bounded_objects(object, "results", kMostResults))
    record.results.push_back(read_result(row));
  record.warnings = read_study_lines(object, "warnings");
  for (const JsonObject& picture : bounded_objects(object, "pictures", kMostShownPictures))
    record.pictures.push_back(read_study_picture(picture));
  return record;
}

}  // namespace herr
