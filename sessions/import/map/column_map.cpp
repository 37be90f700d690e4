#include "sessions/import/map/column_map.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "sessions/import/map/map_parts.h"

namespace herr {
namespace {

constexpr JsonLimits kMapLimits{1 << 20, 16, 10000};

ColumnMap parse_map(const nlohmann::json& document, const std::filesystem::path& file) {
  const JsonObject root(document, file, "");
  root.allow_only(
      {"format_version", "name", "note", "head", "gaze", "camera", "layouts", "vergence_m", "otherwise"});
  root.require_version(1);
  ColumnMap map;
  map.name = root.text("name");
  map.note = root.text_or("note", "");
  for (const JsonObject& entry : root.objects("head")) map.head.push_back(parse_head(entry));
  for (const JsonObject& entry : root.objects("gaze")) map.gaze.push_back(parse_gaze(entry));
  if (map.head.empty() && map.gaze.empty())
    root.fail(nullptr, "names columns of neither head nor gaze", "say in head where the head's pose stands");
  for (const JsonObject& entry : root.objects("camera")) map.camera.push_back(parse_camera(entry));
  for (const JsonObject& entry : root.objects("layouts")) map.layouts.push_back(parse_layout(entry));
  if (root.has("vergence_m")) map.vergence_m = root.number("vergence_m", 0.05, 10000);
  map.otherwise = root.text_or("otherwise", "");
  if (!map.otherwise.empty() && std::none_of(map.head.begin(), map.head.end(), [&](const HeadColumns& head) {
        return head.variant == map.otherwise;
      }))
    root.fail("otherwise", "is '" + printable(map.otherwise) + "', and no head is of that variant",
              "name a variant of head");
  return map;
}

}  // namespace

ColumnMap read_column_map(const std::filesystem::path& json_file) {
  return parse_map(parse_json_file(json_file, kMapLimits), json_file);
}

ColumnMap parse_column_map(std::string_view json_text, const std::filesystem::path& shown_name) {
  return parse_map(parse_json_text(json_text, shown_name, 1, kMapLimits), shown_name);
}

}  // namespace herr
