// Which alternatives of column maps have all their columns in the files of a recording.
// Before: RecordingFiles, ColumnMap. After: choose_format, which lets the data decide where several fit.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/import_rows.h"
#include "sessions/import/map/column_map.h"

namespace herr {

struct RecordingFiles {
  std::filesystem::path head;                 // empty: none, the head stands still
  std::optional<std::filesystem::path> gaze;  // none: in the head's file, or not recorded
};

// A head and a gaze of one map that belong together.
struct FittingColumns {
  std::shared_ptr<const ColumnMap> map;
  std::string preset;  // empty: a map of the user's
  ImportColumns columns;
  std::size_t named_columns = 0;  // asked for by name: the more, the less it fits by accident

  std::string variant() const;
  std::string words() const;  // "preset euroc, variant tumvi"
};

struct FittingResult {
  std::vector<FittingColumns> fitting;
  std::optional<InputError> missing;  // what the nearest alternative lacks, where nothing fits
  bool unreadable = false;  // `missing`: the file cannot even be opened as a table or XML of that kind
};

// `variant` empty: all.
FittingResult fitting_columns(const RecordingFiles& files, const std::shared_ptr<const ColumnMap>& map,
                              const std::string& preset, const std::string& variant, const StillParts& still);

// Names of the siblings of head and gaze; empty: there are none.
std::vector<std::string> variants_of(const ColumnMap& map);

// All gaze alternatives of `variant` (empty: of those without one) whose columns are in the file.
std::vector<const GazeColumns*> fitting_gaze(const std::filesystem::path& file, const ColumnMap& map,
                                             const std::string& variant);

}  // namespace herr
