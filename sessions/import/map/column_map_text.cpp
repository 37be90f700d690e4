#include "sessions/import/map/column_map_text.h"

#include <cstddef>

#include "sessions/import/map/write_parts.h"

namespace herr {
namespace {

constexpr std::size_t kLineLength = 100;

MapJson camera_json(const CameraColumns& camera) {
  MapJson entry;
  write_table(camera.table, entry);
  entry["time"] = json_of(camera.time);
  if (camera.file) entry["file"] = json_of(*camera.file);
  write_filter(camera.valid, "valid", entry);
  for (const ColumnRef& column : camera.lens) entry["lens"].push_back(json_of(column));
  return entry;
}

MapJson layout_json(const RecordingLayout& layout) {
  MapJson entry;
  if (!layout.head.empty()) entry["head"] = layout.head;
  if (!layout.gaze.empty()) entry["gaze"] = layout.gaze;
  for (const RecordingLayout::Camera& camera : layout.cameras) {
    MapJson place;
    place["pictures"] = camera.pictures;
    if (!camera.stamps.empty()) place["stamps"] = camera.stamps;
    if (!camera.calibration.empty()) place["calibration"] = camera.calibration;
    if (!camera.names.empty()) place["names"] = camera.names;
    entry["cameras"].push_back(place);
  }
  return entry;
}

MapJson map_json(const ColumnMap& map) {
  MapJson root;
  root["format_version"] = 1;
  root["name"] = map.name;
  if (!map.note.empty()) root["note"] = map.note;
  for (const HeadColumns& head : map.head) root["head"].push_back(json_of(head));
  for (const GazeColumns& gaze : map.gaze) root["gaze"].push_back(json_of(gaze));
  for (const CameraColumns& camera : map.camera) root["camera"].push_back(camera_json(camera));
  for (const RecordingLayout& layout : map.layouts) root["layouts"].push_back(layout_json(layout));
  if (map.vergence_m) root["vergence_m"] = *map.vergence_m;
  if (!map.otherwise.empty()) root["otherwise"] = map.otherwise;
  return root;
}

void leave_open(const OpenField& open, const std::string& name, MapJson& value) {
  if (value.is_array())
    for (MapJson& element : value) leave_open(open, name, element);
  if (!value.is_object()) return;
  for (auto& item : value.items()) leave_open(open, item.key(), item.value());
  if ((!value.contains(open.key) && !open.absent) || (!open.parent.empty() && open.parent != name)) return;
  value[open.key] = nullptr;
  if (open.key == "world_axes" || open.key == "head_axes") value.erase("handedness");
}

std::string scalar_text(const MapJson& value) {
  return value.dump(-1, ' ', false, MapJson::error_handler_t::replace);
}

// In one line: {"a": 1, "b": [2, 3]}.
std::string flat_text(const MapJson& value) {
  if (!value.is_structured()) return scalar_text(value);
  std::string text(1, value.is_object() ? '{' : '[');
  for (const auto& item : value.items()) {
    if (text.size() > 1) text += ", ";
    if (value.is_object()) text += scalar_text(item.key()) + ": ";
    text += flat_text(item.value());
  }
  return text + (value.is_object() ? '}' : ']');
}

// What fits into a line stands in one; the rest has a line for each element.
std::string laid_out(const MapJson& value, std::size_t indent, std::size_t before) {
  const std::string flat = flat_text(value);
  if (!value.is_structured() || (indent > 0 && before + flat.size() <= kLineLength)) return flat;
  const std::string margin(indent + 2, ' ');
  std::string text(1, value.is_object() ? '{' : '[');
  bool first = true;
  for (const auto& item : value.items()) {
    const std::string key = value.is_object() ? scalar_text(item.key()) + ": " : "";
    text += (first ? "\n" : ",\n") + margin + key +
            laid_out(item.value(), indent + 2, margin.size() + key.size());
    first = false;
  }
  return text + "\n" + std::string(indent, ' ') + (value.is_object() ? '}' : ']');
}

}  // namespace

std::string column_map_text(const ColumnMap& map, const std::vector<OpenField>& open) {
  MapJson json = map_json(map);
  for (const OpenField& field : open) leave_open(field, "", json);
  return laid_out(json, 0, 0) + "\n";
}

}  // namespace herr
