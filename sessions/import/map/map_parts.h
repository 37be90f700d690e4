// The parts of a column map, each read from its JSON object. Private to this folder.
// Before: strict_json. After: column_map.cpp puts them together. Everything throws InputError.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/map/map_words.h"

namespace herr {

ColumnRef parse_ref(const JsonObject& entry, const char* key);
// "HMDPosition" (all numbers in one field) or ["px", "py", "pz"].
ColumnGroup parse_group(const JsonObject& entry, const char* key, std::size_t numbers);
AxisDirections parse_axes(const JsonObject& entry, const char* key);

// The one of `keys` that the object has; it is wrong to have none or two. `what` they give: "a direction".
const char* only_one_of(const JsonObject& entry, std::initializer_list<const char*> keys, const char* what);
// Fails when the object has one of `keys`, which mean nothing beside `beside`.
void refuse_beside(const JsonObject& entry, const char* beside, std::initializer_list<const char*> keys);

[[noreturn]] void fail_word(const JsonObject& entry, const char* key, const std::string& word,
                            std::span<const char* const> known);

// What the word under `key` stands for; `key` may be absent where there is a fallback.
template <typename Word, std::size_t n>
auto parse_word(const JsonObject& entry, const char* key, const Word (&words)[n],
                const char* fallback = nullptr) {
  const std::string given = fallback == nullptr ? entry.text(key) : entry.text_or(key, fallback);
  const char* known[n];
  for (std::size_t i = 0; i < n; ++i) {
    if (given == words[i].word) return words[i].meaning;
    known[i] = words[i].word;
  }
  fail_word(entry, key, given, known);
}

TableFormat parse_table(const JsonObject& entry);
TimeColumns parse_time(const JsonObject& parent);
RowFilter parse_filter(const JsonObject& parent, const char* key = "valid");
void parse_orientation(const JsonObject& entry, HeadColumns& head);
HeadColumns parse_head(const JsonObject& entry);
GazeColumns parse_gaze(const JsonObject& entry);
CameraColumns parse_camera(const JsonObject& entry);
RecordingLayout parse_layout(const JsonObject& entry);

}  // namespace herr
