// Where a program puts the files of a recording.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "sessions/import/map/map_parts.h"

namespace herr {
namespace {

bool is_layout_part(std::string_view part) {
  return !part.empty() && part != ".." && part != "." && std::count(part.begin(), part.end(), '*') <= 1;
}

// A relative path with at most one * in each part; "." is the folder itself.
std::string parse_place(const JsonObject& entry, const char* key) {
  if (!entry.has(key)) return "";
  const std::string place = entry.text(key);
  if (place == ".") return place;
  bool good = place.find('\\') == std::string::npos;
  for (std::size_t begin = 0; begin <= place.size();) {
    const std::size_t end = std::min(place.find('/', begin), place.size());
    good = good && is_layout_part(std::string_view(place).substr(begin, end - begin));
    begin = end + 1;
  }
  if (!good)
    entry.fail(key, "is '" + printable(place) + "', no place in the recording's folder",
               "write a path such as cam0/data.csv, with at most one * in each part");
  return place;
}

RecordingLayout::Camera parse_layout_camera(const JsonObject& entry) {
  entry.allow_only({"pictures", "stamps", "calibration", "names"});
  RecordingLayout::Camera camera;
  camera.pictures = parse_place(entry, "pictures");
  if (camera.pictures.empty()) entry.fail("pictures", "is missing", "write the folder of the pictures");
  camera.stamps = parse_place(entry, "stamps");
  camera.calibration = parse_place(entry, "calibration");
  camera.names = entry.text_or("names", "");
  return camera;
}

}  // namespace

RecordingLayout parse_layout(const JsonObject& entry) {
  entry.allow_only({"head", "gaze", "cameras"});
  RecordingLayout layout;
  layout.head = parse_place(entry, "head");
  layout.gaze = parse_place(entry, "gaze");
  for (const JsonObject& camera : entry.objects("cameras"))
    layout.cameras.push_back(parse_layout_camera(camera));
  if (layout.cameras.size() > 2)
    entry.fail("cameras", "has " + std::to_string(layout.cameras.size()) + " cameras", "name one or two");
  if (layout.head.empty() && layout.gaze.empty())
    entry.fail(nullptr, "names neither head nor gaze", "write where one of them lies, such as head.csv");
  return layout;
}

}  // namespace herr
