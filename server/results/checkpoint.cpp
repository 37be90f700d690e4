#include "server/results/checkpoint.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "server/results/summary_json.h"
#include "server/text/base64.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kFormatVersion = 1;
constexpr std::int64_t kMostCounted = std::int64_t{1} << 53;
constexpr double kFarthestAnchor_m = 2e9;
constexpr std::int64_t kMostBytes = std::int64_t{1} << 28;          // 65536 probes of two kinds: 160 MB
constexpr const char* kRemedy = "give --overwrite to start again";  // nobody repairs such a file by hand

Json entries_json(const Fingerprint::Entries& entries) {
  Json json = Json::object();
  for (const auto& [name, value] : entries) json[name] = value;
  return json;
}

Fingerprint::Entries read_entries(const JsonObject& document, const char* key) {
  Fingerprint::Entries entries;
  const nlohmann::json& object = document.value(key);
  if (!object.is_object()) document.fail(key, "is not an object", kRemedy);
  for (const auto& [name, value] : object.items()) {
    if (!value.is_string()) document.fail(key, "has a value that is no text", kRemedy);
    entries.emplace_back(name, value.get<std::string>());
  }
  return entries;
}

std::vector<std::byte> read_bytes(const JsonObject& document, const char* key) {
  if (!document.has(key)) return {};
  const std::optional<std::vector<std::byte>> bytes = bytes_from_base64(document.text(key));
  if (!bytes) document.fail(key, "is no base64", kRemedy);
  return *bytes;
}

RendererState read_renderer_state(const JsonObject& document) {
  RendererState state;
  state.probes = read_bytes(document, "probes");
  state.details = read_bytes(document, "details");
  if (!document.has("anchor_m")) return state;
  state.anchor = document.vec3("anchor_m", -kFarthestAnchor_m, kFarthestAnchor_m);
  return state;
}

std::vector<std::string> read_texts(const JsonObject& document, const char* key) {
  std::vector<std::string> texts;
  for (const nlohmann::json& text : document.value(key)) {
    if (!text.is_string()) document.fail(key, "holds something else than texts", kRemedy);
    texts.push_back(text.get<std::string>());
  }
  return texts;
}

Checkpoint parse_checkpoint(const std::filesystem::path& file) {
  JsonLimits limits;
  limits.max_bytes = kMostBytes;
  const nlohmann::json json = parse_json_file(file, limits);
  const JsonObject document(json, file, "");
  if (document.integer("format_version", 1, kMostCounted) != kFormatVersion) {
    document.fail("format_version", "is of a later version of this program", kRemedy);
  }
  document.allow_only({"format_version", "next_frame", "anchor_m", "probes", "details", "left_camera_ns",
                       "right_camera_ns", "sanitised_camera_values", "skipped_images", "warnings", "settings",
                       "inputs"});
  Checkpoint checkpoint;
  checkpoint.fingerprint = {read_entries(document, "settings"), read_entries(document, "inputs")};
  RunState& state = checkpoint.state;
  state.next_frame = document.integer("next_frame", 0, kMostCounted);
  state.renderer = read_renderer_state(document);
  constexpr TimeNs kLatest = 4'000'000'000'000'000'000;  // of any session
  if (document.has("left_camera_ns")) {
    state.camera_stamps_ns[0] = document.integer("left_camera_ns", 0, kLatest);
  }
  if (document.has("right_camera_ns")) {
    state.camera_stamps_ns[1] = document.integer("right_camera_ns", 0, kLatest);
  }
  state.sanitised_camera_values = document.integer("sanitised_camera_values", 0, kMostCounted);
  state.skipped_images = document.integer("skipped_images", 0, kMostCounted);
  state.warnings = read_texts(document, "warnings");
  return checkpoint;
}

}  // namespace

std::string checkpoint_text(const Fingerprint& fingerprint, const RunState& state) {
  Json json{{"format_version", kFormatVersion}, {"next_frame", state.next_frame}};
  if (const auto& anchor = state.renderer.anchor) json["anchor_m"] = {anchor->x, anchor->y, anchor->z};
  if (state.camera_stamps_ns[0]) json["left_camera_ns"] = *state.camera_stamps_ns[0];
  if (state.camera_stamps_ns[1]) json["right_camera_ns"] = *state.camera_stamps_ns[1];
  if (!state.renderer.probes.empty()) json["probes"] = base64_text(state.renderer.probes);
  if (!state.renderer.details.empty()) json["details"] = base64_text(state.renderer.details);
  json["sanitised_camera_values"] = state.sanitised_camera_values;
  json["skipped_images"] = state.skipped_images;
  json["warnings"] = state.warnings;
  json["settings"] = entries_json(fingerprint.settings);
  json["inputs"] = entries_json(fingerprint.inputs);
  return json_text(json);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  try {
    return parse_checkpoint(file);
  } catch (const InputError& error) {
    const std::string what = error.what();
    const std::size_t begin = std::min(what.find(": "), what.size() - 2) + 2;
    throw InputError(file, 0, "is damaged: " + what.substr(begin, what.rfind("; ") - begin), kRemedy);
  }
}

void check_fits(const RunState& state, const FrameRange& range, const std::filesystem::path& file) {
  bool fits = state.next_frame >= range.first && state.next_frame <= range.first + range.count;
  for (const auto& stamp : state.camera_stamps_ns) {
    fits =
        fits && (!stamp || (state.next_frame > range.first && *stamp <= range.time_ns(state.next_frame - 1)));
  }
  if (!fits) {
    throw InputError(file, 0, "is damaged: it does not fit the session", kRemedy);
  }
}

}  // namespace herr
