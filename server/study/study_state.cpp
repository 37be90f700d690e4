#include "server/study/study_state.h"

#include <nlohmann/json.hpp>

#include "server/study/report/study_json.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

using StateJson = nlohmann::ordered_json;

constexpr int kStateVersion = 1;
constexpr std::size_t kMostNames = 10000;

StateJson changes_json(const SettingChanges& changes) {
  StateJson json = StateJson::array();
  for (const auto& [name, value] : changes) json.push_back(name), json.push_back(value);
  return json;
}

std::vector<std::string> texts_of(const JsonObject& object, const char* key) {
  std::vector<std::string> texts;
  const nlohmann::json& value = object.value(key);
  if (!value.is_array() || value.size() > kMostNames)
    object.fail(key, "is no list of texts", "begin the study anew");
  for (const nlohmann::json& text : value) {
    if (!text.is_string()) object.fail(key, "is no list of texts", "begin the study anew");
    texts.push_back(text.get<std::string>());
  }
  return texts;
}

SettingChanges changes_of(const JsonObject& object, const char* key) {
  const std::vector<std::string> texts = texts_of(object, key);
  if (texts.size() % 2 != 0) object.fail(key, "is no list of names and values", "begin the study anew");
  SettingChanges changes;
  for (std::size_t i = 0; i < texts.size(); i += 2) changes.emplace_back(texts[i], texts[i + 1]);
  return changes;
}

}  // namespace

void write_state(const std::filesystem::path& file, const StudyState& state) {
  StateJson json{{"format", "herr study state"}, {"version", kStateVersion}, {"subject", state.subject}};
  if (state.settings) json["settings"] = *state.settings;
  json["frames"] = state.frames;
  json["minutes"] = state.minutes;
  json["dropped"] = state.dropped;
  if (state.combinations) {
    json["combinations"] = StateJson::array();
    for (const StudySetting& setting : *state.combinations) {
      json["combinations"].push_back({{"name", setting.name},
                                      {"changes", changes_json(setting.changes)},
                                      {"own", setting.own == OwnReference::pixels ? "pixels" : "none"},
                                      {"model", changes_json(setting.model)}});
    }
  }
  StudyRecord record;
  json["reference_frames"] = StateJson::array();
  for (const auto& [frame, reference] : state.references) {
    json["reference_frames"].push_back(frame);
    record.references.push_back(reference);
  }
  json["record"] = study_json(record);
  write_whole_file(file, json.dump(-1, ' ', false, StateJson::error_handler_t::replace) + "\n");
}

StudyState read_state(const std::filesystem::path& file) {
  const nlohmann::json document = parse_json_file(file);
  const JsonObject root(document, file, "");
  if (root.integer("version", 0, 1000) != kStateVersion) {
    root.fail("version", "is that of another program", "begin the study anew, with --overwrite");
  }
  StudyState state;
  state.subject = root.text("subject");
  if (root.has("settings")) state.settings = texts_of(root, "settings");
  state.frames = static_cast<std::size_t>(root.integer("frames", 0, 1000000));
  if (root.has("minutes")) state.minutes = root.number("minutes", 0, 1e6);
  state.dropped = texts_of(root, "dropped");
  if (root.has("combinations")) {
    state.combinations.emplace();
    for (const JsonObject& object : root.objects("combinations")) {
      StudySetting setting;
      setting.name = setting.value = object.text("name");
      setting.knob = "combination";
      setting.changes = changes_of(object, "changes");
      setting.model = changes_of(object, "model");
      if (object.text("own") == "pixels") setting.own = OwnReference::pixels;
      state.combinations->push_back(std::move(setting));
    }
  }
  const StudyRecord record = read_study(root.value("record"), file.string());
  const nlohmann::json& frames = root.value("reference_frames");
  if (!frames.is_array() || frames.size() != record.references.size()) {
    root.fail("reference_frames", "does not fit the record", "begin the study anew, with --overwrite");
  }
  for (std::size_t i = 0; i < record.references.size(); ++i) {
    if (!frames[i].is_number_integer()) {
      root.fail("reference_frames", "has no whole number", "begin the study anew, with --overwrite");
    }
    state.references.emplace_back(frames[i].get<std::int64_t>(), record.references[i]);
  }
  return state;
}

}  // namespace herr
