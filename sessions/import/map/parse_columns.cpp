// Columns, axes and words of a map.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "sessions/import/map/map_parts.h"

namespace herr {
namespace {

using nlohmann::json;

constexpr std::int64_t kMostColumns = 65536;
constexpr std::size_t kMostShown = 80;  // bytes of a value that a message quotes

std::string shown_json(const json& value) {
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return printable(text.size() <= kMostShown ? text : text.substr(0, kMostShown) + "...");
}

ColumnRef ref_of(const JsonObject& entry, const char* key, const json& value) {
  ColumnRef ref;
  if (value.is_string()) ref.name = value.get<std::string>();
  if (value.is_number_integer() && value >= 1 && value <= kMostColumns) ref.number = value.get<std::size_t>();
  if (ref.name.empty() && ref.number == 0)
    entry.fail(key, "is " + shown_json(value) + ", which names no column",
               "write the column's name, or its number where 1 is the first");
  return ref;
}

std::string shown_ref(const ColumnRef& ref) {
  return ref.number > 0 ? std::to_string(ref.number) : "'" + printable(ref.name) + "'";
}

}  // namespace

ColumnRef parse_ref(const JsonObject& entry, const char* key) {
  return ref_of(entry, key, entry.value(key));
}

ColumnGroup parse_group(const JsonObject& entry, const char* key, std::size_t numbers) {
  const json& value = entry.value(key);
  ColumnGroup group;
  group.numbers = numbers;
  if (!value.is_array()) {
    group.columns.push_back(ref_of(entry, key, value));
    return group;
  }
  if (value.size() != numbers)
    entry.fail(key, "has " + std::to_string(value.size()) + (value.size() == 1 ? " column" : " columns"),
               "name " + std::to_string(numbers) +
                   " columns, or one (without brackets) whose field holds all numbers");
  for (const json& element : value) {
    const ColumnRef ref = ref_of(entry, key, element);
    if (std::find(group.columns.begin(), group.columns.end(), ref) != group.columns.end())
      entry.fail(key, "names column " + shown_ref(ref) + " twice", "name each number's own column");
    group.columns.push_back(ref);
  }
  return group;
}

AxisDirections parse_axes(const JsonObject& entry, const char* key) {
  const json& value = entry.value(key);
  std::array<std::string, 3> words;
  bool good = value.is_array() && value.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    good = value[i].is_string();
    if (good) words[i] = value[i].get<std::string>();
  }
  const auto axes = good ? AxisDirections::from_words(words) : std::nullopt;
  if (!axes)
    entry.fail(key, "is " + shown_json(value) + ", which does not say where x, y and z point",
               "write three of right, left, up, down, forward, back, such as [\"right\", \"up\", \"back\"]");
  return *axes;
}

const char* only_one_of(const JsonObject& entry, std::initializer_list<const char*> keys, const char* what) {
  const char* found = nullptr;
  for (const char* key : keys) {
    if (!entry.has(key)) continue;
    if (found != nullptr)
      entry.fail(nullptr, "has both " + std::string(found) + " and " + key,
                 "keep the one that the file holds");
    found = key;
  }
  if (found == nullptr)
    entry.fail(nullptr, "names no " + std::string(what),
               "give one of " + either_of({keys.begin(), keys.size()}, ""));
  return found;
}

void refuse_beside(const JsonObject& entry, const char* beside, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (entry.has(key)) entry.fail(key, "does not go with " + std::string(beside), "remove one of them");
}

void fail_word(const JsonObject& entry, const char* key, const std::string& word,
               std::span<const char* const> known) {
  entry.fail(key, "is '" + printable(word) + "'", "write " + either_of(known, "'"));
}

}  // namespace herr
