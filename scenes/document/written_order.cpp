#include "scenes/document/written_order.h"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "sessions/files/input_error.h"
#include "sessions/text/written_order.h"

namespace herr {
namespace {

constexpr std::array kSections{"world_from_session", "room_scan", "gltf", "voxels", "shapes",
                               "catchers",           "timeline"};
constexpr std::string_view kOrder = "_xyzw";

std::optional<OrderDoubt> doubt_of(const nlohmann::json& value) {
  if (!value.is_array() || value.size() != 4) return std::nullopt;
  std::array<double, 4> q{};
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (!value[i].is_number()) return std::nullopt;
    q[i] = value[i].get<double>();
  }
  return order_doubt(q);
}

struct Found {
  std::string where;  // the first
  OrderDoubt doubt;
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
    const auto doubt = key.ends_with(kOrder) ? doubt_of(inner) : std::nullopt;
    if (!doubt) {
      search(inner, place, found);
    } else if (found.count++ == 0) {
      found.where = place;
      found.doubt = *doubt;
    }
  }
}

}  // namespace

std::string w_first_warning(const JsonObject& root) {
  Found found;
  for (const char* section : kSections)
    if (root.has(section)) search(root.value(section), section, found);
  if (found.count == 0) return {};
  const std::string more = found.count > 1 ? " (and " + std::to_string(found.count - 1) + " more)" : "";
  return InputError(root.file(), line_of_field(root.file(), found.where),
                    "field " + printable(found.where) + more + " " + found.doubt.problem, found.doubt.remedy)
      .what();
}

}  // namespace herr
