#include "sessions/import/presets/recording_folder.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/import/presets/built_in_maps.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

// One * stands for any text.
bool matches_part(std::string_view name, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name == pattern;
  const std::string_view before = pattern.substr(0, star), after = pattern.substr(star + 1);
  return name.size() >= before.size() + after.size() && name.starts_with(before) && name.ends_with(after);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> names = list_folder(folder, error);
  if (error) names.clear();  // not there, or not a folder: nothing matches
  std::sort(names.begin(), names.end());
  return names;
}

// What exists below the folder under a pattern of names.
std::vector<fs::path> matches(const fs::path& folder, const std::string& pattern) {
  std::vector<fs::path> found{folder};
  for (const fs::path& part : fs::path(pattern)) {
    std::vector<fs::path> next;
    for (const fs::path& parent : found) {
      if (part.string().find('*') == std::string::npos) {
        if (path_exists(parent / part)) next.push_back(parent / part);
        continue;
      }
      for (const std::string& name : names_in(parent))
        if (matches_part(name, part.string())) next.push_back(parent / name);
    }
    found = std::move(next);
  }
  return found;
}

// The file of a pattern, or nothing. Throws InputError when there are several.
std::optional<fs::path> only_match(const fs::path& folder, const std::string& pattern) {
  if (pattern.empty()) return std::nullopt;
  const std::vector<fs::path> found = matches(folder, pattern);
  if (found.empty()) return std::nullopt;
  if (found.size() > 1)
    throw InputError(folder, 0,
                     "holds several recordings: " + found[0].lexically_relative(folder).string() + ", " +
                         found[1].lexically_relative(folder).string() + (found.size() > 2 ? ", ..." : ""),
                     "name one of the files instead of the folder");
  return found.front();
}

struct Match {
  FoundRecording recording;
  std::size_t files = 0;
};

std::optional<Match> match(const fs::path& folder, const RecordingLayout& layout, const std::string& preset) {
  Match match;
  match.recording.preset = preset;
  if (!layout.head.empty()) {
    const auto head = only_match(folder, layout.head);
    if (!head) return std::nullopt;
    match.recording.files.head = *head;
    ++match.files;
  }
  if (!layout.gaze.empty()) {
    match.recording.files.gaze = only_match(folder, layout.gaze);
    if (!match.recording.files.gaze && layout.head.empty()) return std::nullopt;
    match.files += match.recording.files.gaze ? 1 : 0;
  }
  for (const RecordingLayout::Camera& camera : layout.cameras) {
    const auto pictures = only_match(folder, camera.pictures);
    if (!pictures) continue;
    FoundCamera found{*pictures, only_match(folder, camera.stamps).value_or(""),
                      only_match(folder, camera.calibration).value_or(""), camera.names};
    match.files += 1 + (found.stamps.empty() ? 0 : 1) + (found.calibration.empty() ? 0 : 1);
    match.recording.cameras.push_back(std::move(found));
  }
  return match;
}

// The layouts that are there, those with the most files first.
std::vector<Match> matches_of(const fs::path& folder, const ColumnMap& map, const std::string& preset) {
  std::vector<Match> found;
  for (const RecordingLayout& layout : map.layouts)
    if (auto one = match(folder, layout, preset)) found.push_back(std::move(*one));
  return found;
}

// "mav0/state_groundtruth_estimate0/data.csv or mav0/mocap0/data.csv".
std::string heads_of(const ColumnMap& map) {
  std::string text;
  for (const RecordingLayout& layout : map.layouts) {
    const std::string& file = layout.head.empty() ? layout.gaze : layout.head;
    text += (text.empty() ? "" : " or ") + file;
  }
  return text;
}

bool same_files(const FoundRecording& a, const FoundRecording& b) {
  return a.files.head == b.files.head && a.files.gaze == b.files.gaze;
}

}  // namespace

FoundRecording find_recording(const fs::path& folder, const std::string& preset, const ColumnMap* map) {
  std::vector<Match> found;
  std::string expected;
  const auto look = [&](const ColumnMap& one, const std::string& name) {
    std::vector<Match> more = matches_of(folder, one, name);
    std::move(more.begin(), more.end(), std::back_inserter(found));
    expected = heads_of(one);
  };
  if (map != nullptr) {
    look(*map, preset);
  } else {
    for (const BuiltInMap& built_in : built_in_maps())
      if (preset.empty() || built_in.name == preset)
        look(parse_column_map(built_in.json, std::string(built_in.name) + ".json"),
             std::string(built_in.name));
  }
  if (found.empty()) {
    const bool one_format = map != nullptr || !preset.empty();
    throw InputError(
        folder, 0, one_format ? "is no folder of this format" : "is no folder of a recorder that is known",
        one_format && !expected.empty() ? "it should hold " + expected : "name the recording's file");
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Match& a, const Match& b) { return a.files > b.files; });
  FoundRecording best = found.front().recording;
  for (const Match& other : found) {
    if (other.files < found.front().files || other.recording.preset == best.preset) continue;
    if (!same_files(other.recording, best))
      throw InputError(folder, 0,
                       "could be a recording of " + best.preset + " or of " + other.recording.preset,
                       "give --preset, or name the recording's file");
    best.preset.clear();  // the columns tell
  }
  return best;
}

bool named_in_layouts(const fs::path& file, const ColumnMap& map) {
  const std::string name = file.filename().string();
  return std::any_of(map.layouts.begin(), map.layouts.end(), [&](const RecordingLayout& layout) {
    const fs::path pattern = layout.head.empty() ? layout.gaze : layout.head;
    // "data.csv" says nothing of its own.
    return pattern.filename() != "data.csv" && matches_part(name, pattern.filename().string());
  });
}

}  // namespace herr
