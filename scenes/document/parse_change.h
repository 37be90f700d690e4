// Scene changes from their JSON: lines of events.jsonl (t_ns, on the session's clock) and entries of a scene
// document's timeline (t_s, since the session's start). Before: sessions/ yields lines, scene_document the
// timeline. After: world.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/model/scene_change.h"
#include "sessions/files/strict_json.h"
#include "sessions/format/pose.h"

namespace herr {

const char* name_of(ChangeKind kind);

// `object` holds a stamp under `stamp_key`, which is not read here. Throws InputError that names the field.
SceneChange parse_change(const JsonObject& object, const char* stamp_key);
// `timeline` of a scene document: sorted by t_s.
std::vector<SceneChange> parse_timeline(const JsonObject& document);
// A line of events.jsonl; `start_ns` is the session's start. Throws InputError with file and line.
SceneChange parse_event(const std::string& json, const std::filesystem::path& file, std::int64_t line,
                        TimeNs start_ns);

}  // namespace herr
