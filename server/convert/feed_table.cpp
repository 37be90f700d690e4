#include "server/convert/feed_table.h"

#include <system_error>

#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

std::string file_name(const fs::path& file) {
  return printable(file.filename().string());
}

// Without links and "..", as far as that can be told.
fs::path whole_path(const fs::path& file) {
  std::error_code unknown;
  fs::path whole = fs::weakly_canonical(file, unknown);
  return unknown ? file.lexically_normal() : whole;
}

bool is_file_of_recording(const fs::path& file, const RecordingFiles& files) {
  const fs::path whole = whole_path(file);
  return whole == whole_path(files.head) || (files.gaze && whole == whole_path(*files.gaze));
}

std::vector<fs::path> tables_beside(const fs::path& pictures) {
  const fs::path folder = pictures.has_filename() ? pictures : pictures.parent_path();
  const fs::path above = folder.parent_path();
  return {folder / "data.csv", folder / "frames.csv", above / "data.csv", above / "frames.csv"};
}

}  // namespace

std::optional<CameraTable> find_camera_table(const FeedSource& source, const CameraTableSearch& search,
                                             std::vector<std::string>& passed_over) {
  if (!source.stamps.empty() && search.stamps_needed)
    return CameraTable{source.stamps, camera_columns_of(source.stamps, search.map), true};
  std::vector<fs::path> tables;
  if (!source.stamps.empty())
    tables = {source.stamps};
  else if (source.names.empty())
    tables = tables_beside(source.pictures);
  for (const fs::path& table : tables) {
    if (!path_exists(table) || (source.stamps.empty() && is_file_of_recording(table, search.files))) continue;
    try {
      return CameraTable{table, camera_columns_of(table, search.map)};
    } catch (const InputError& error) {
      passed_over.push_back(file_name(table) + " beside them " + error.problem());
    }
  }
  return std::nullopt;
}

}  // namespace herr
