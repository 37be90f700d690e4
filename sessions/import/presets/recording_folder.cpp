#include "sessions/import/presets/recording_folder.h"

#include <algorithm>
#include <cstddef>
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

// `pattern` may hold one *, which stands for any text.
bool fits_pattern(const std::string& name, const std::string& pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) return name == pattern;
  const std::string_view before = std::string_view(pattern).substr(0, star);
  const std::string_view after = std::string_view(pattern).substr(star + 1);
  return name.size() >= before.size() + after.size() && name.starts_with(before) && name.ends_with(after);
}

// What `pattern` stands for below `folder`, by name.
std::vector<fs::path> paths_of(const fs::path& folder, const std::string& pattern) {
  std::vector<fs::path> found{folder};
  for (const fs::path& part : fs::path(pattern)) {
    const std::string wanted = part.string();
    std::vector<fs::path> deeper;
    for (const fs::path& at : found) {
      if (wanted.find('*') == std::string::npos) {
        if (path_exists(at / part)) deeper.push_back(at / part);
        continue;
      }
      std::error_code error;  // a folder that cannot be listed holds no recording
      for (const std::string& name : list_folder(at, error))
        if (fits_pattern(name, wanted)) deeper.push_back(at / name);
    }
    found = std::move(deeper);
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Empty: not there.
fs::path only_path(const fs::path& folder, const std::string& pattern) {
  if (pattern.empty()) return {};
  const std::vector<fs::path> found = paths_of(folder, pattern);
  if (found.size() > 1)
    throw InputError(folder, 0,
                     "holds several recordings: " + found[0].lexically_relative(folder).string() + " and " +
                         found[1].lexically_relative(folder).string(),
                     "name the file of one of them");
  return found.empty() ? fs::path{} : found[0];
}

struct FolderFit {
  FoundRecording recording;
  std::string head;  // as the layout names it
};

std::optional<FolderFit> fit_of(const fs::path& folder, const RecordingLayout& layout) {
  FolderFit fit;
  fit.head = layout.head.empty() ? layout.gaze : layout.head;
  fit.recording.files.head = only_path(folder, layout.head);
  if (!layout.head.empty() && fit.recording.files.head.empty()) return std::nullopt;
  if (!layout.gaze.empty()) {
    fit.recording.files.gaze = only_path(folder, layout.gaze);
    if (fit.recording.files.gaze->empty()) return std::nullopt;
  }
  for (const RecordingLayout::Camera& camera : layout.cameras) {
    const fs::path pictures = only_path(folder, camera.pictures);
    const fs::path stamps = only_path(folder, camera.stamps);
    if (pictures.empty() || (!camera.stamps.empty() && stamps.empty())) continue;
    fit.recording.cameras.push_back({pictures, stamps, only_path(folder, camera.calibration), camera.names});
  }
  return fit;
}

std::optional<FolderFit> best_fit(const fs::path& folder, const ColumnMap& map) {
  std::optional<FolderFit> best;
  const auto rank = [](const FolderFit& fit) {
    return std::pair(fit.recording.files.gaze.has_value(), fit.recording.cameras.size());
  };
  for (const RecordingLayout& layout : map.layouts) {
    std::optional<FolderFit> fit = fit_of(folder, layout);
    if (fit && (!best || rank(*fit) > rank(*best))) best = std::move(fit);
  }
  if (best) best->recording.preset = map.name;
  return best;
}

bool holds(const fs::path& folder, const ColumnMap& map) {
  return std::any_of(map.layouts.begin(), map.layouts.end(), [&](const RecordingLayout& layout) {
    return !paths_of(folder, layout.head.empty() ? layout.gaze : layout.head).empty();
  });
}

constexpr std::size_t kMostSubfolders = 100;  // that are looked into

// A folder one too high names the recordings in it.
void refuse_folder_of_recordings(const fs::path& folder, const std::vector<ColumnMap>& maps) {
  std::error_code error;
  std::vector<std::string> names = list_folder(folder, error);
  std::sort(names.begin(), names.end());
  if (names.size() > kMostSubfolders) names.resize(kMostSubfolders);
  std::vector<std::string> recordings;
  for (const std::string& name : names)
    if (std::any_of(maps.begin(), maps.end(),
                    [&](const ColumnMap& map) { return holds(folder / name, map); }))
      recordings.push_back(printable((folder / name).string()));
  if (recordings.empty()) return;
  std::string text = recordings[0];
  for (std::size_t i = 1; i < std::min<std::size_t>(recordings.size(), 3); ++i) text += ", " + recordings[i];
  if (recordings.size() > 3) text += ", ...";
  throw InputError(
      folder, 0,
      "holds " + std::string(recordings.size() == 1 ? "a recording" : "several recordings") + " in " + text,
      recordings.size() == 1 ? "name that folder" : "name one of these folders");
}

// "hmd_poses.csv (quest-capture), ...", of each map its first layout.
std::string known_layouts(const std::vector<ColumnMap>& maps) {
  std::string text;
  for (const ColumnMap& map : maps) {
    if (map.layouts.empty()) continue;
    const RecordingLayout& layout = map.layouts.front();
    text += (text.empty() ? "" : ", ") + (layout.head.empty() ? layout.gaze : layout.head) + " (" + map.name +
            ")";
  }
  return text;
}

}  // namespace

FoundRecording find_recording(const std::filesystem::path& folder, const std::string& preset,
                              const ColumnMap* map) {
  std::vector<ColumnMap> maps;
  if (map != nullptr) maps.push_back(*map);
  for (const BuiltInMap& built_in : built_in_maps())
    if (map == nullptr && (preset.empty() || built_in.name == preset))
      maps.push_back(parse_column_map(built_in.json, std::string(built_in.name) + ".json"));
  std::vector<FolderFit> fits;
  for (const ColumnMap& one : maps)
    if (std::optional<FolderFit> fit = best_fit(folder, one)) fits.push_back(std::move(*fit));
  if (fits.size() == 1) return std::move(fits.front().recording);
  if (!fits.empty())
    throw InputError(folder, 0,
                     "holds files of several formats: " + fits[0].head + " (" + fits[0].recording.preset +
                         ") and " + fits[1].head + " (" + fits[1].recording.preset + ")",
                     "say which one with --preset");
  refuse_folder_of_recordings(folder, maps);
  if (path_exists(folder / "session.json"))
    throw InputError(folder, 0, "is a session already, it has a session.json",
                     "replay it as it is: herr replay " + printable(folder.string()));
  const std::string layouts = known_layouts(maps);
  if (layouts.empty())
    throw InputError(folder, 0, "is a folder, but preset " + preset + " reads single files",
                     "name the file with the head's poses");
  throw InputError(folder, 0,
                   preset.empty() ? "holds no recording of a known layout"
                                  : "holds no recording as preset " + preset + " knows it",
                   "such folders hold " + layouts + "; else name the file with the head's poses");
}

bool named_in_layouts(const fs::path& file, const ColumnMap& map) {
  const std::string name = file.filename().string();
  return std::any_of(map.layouts.begin(), map.layouts.end(), [&](const RecordingLayout& layout) {
    const fs::path pattern = layout.head.empty() ? layout.gaze : layout.head;
    // "data.csv" says nothing of its own.
    return pattern.filename() != "data.csv" && fits_pattern(name, pattern.filename().string());
  });
}

}  // namespace herr
