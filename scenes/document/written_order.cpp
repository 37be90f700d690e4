#include "scenes/document/written_order.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "sessions/files/input_error.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr double kLeastFirst = 0.7, kZero = 1e-4;
constexpr std::array kSections{"world_from_session", "room_scan", "gltf", "voxels", "shapes",
                               "catchers",           "timeline"};
constexpr std::string_view kOrder = "_xyzw";

bool looks_w_first(const nlohmann::json& value) {
  if (!value.is_array() || value.size() != 4) return false;
  for (const nlohmann::json& number : value)
    if (!number.is_number()) return false;
  return value[0].get<double>() >= kLeastFirst && std::abs(value[3].get<double>()) < kZero;
}

std::string shown(const nlohmann::json& q, const std::array<std::size_t, 4>& order) {
  std::string text;
  for (const std::size_t i : order)
    text += (text.empty() ? "[" : ", ") + plain_number_text(q[i].get<double>());
  return text + "]";
}

// The same half turn with its signs turned round, which no longer looks w-first.
std::string half_turn_text(const nlohmann::json& q) {
  std::string text;
  for (const nlohmann::json& number : q)
    text += (text.empty() ? "[" : ", ") + plain_number_text(0.0 - number.get<double>());
  return text + "]";
}

struct Found {
  std::string where;  // the first
  const nlohmann::json* value = nullptr;
  int count = 0;
};

void search(const nlohmann::json& value, const std::string& where, Found& found) {
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      search(value[i], where + "[" + std::to_string(i) + "]", found);
    return;
  }
  if (!value.is_object()) return;
  for (const auto& [key, inner] : value.items()) {
    const std::string place = where + "." + key;
    if (!key.ends_with(kOrder) || !looks_w_first(inner)) {
      search(inner, place, found);
    } else if (found.count++ == 0) {
      found.where = place;
      found.value = &inner;
    }
  }
}

}  // namespace

std::string w_first_warning(const JsonObject& root) {
  Found found;
  for (const char* section : kSections)
    if (root.has(section)) search(root.value(section), section, found);
  if (found.count == 0) return {};
  const nlohmann::json& q = *found.value;
  return printable(root.file().string()) + ": field " + printable(found.where) +
         (found.count > 1 ? " (and " + std::to_string(found.count - 1) + " more)" : "") + " is " +
         shown(q, {0, 1, 2, 3}) + ", which looks w-first; here w is last: write " + shown(q, {1, 2, 3, 0}) +
         ", or where half a turn is meant " + half_turn_text(q);
}

}  // namespace herr
