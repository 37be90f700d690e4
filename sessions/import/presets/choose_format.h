// Which format a recording has: the alternatives of a map whose columns are in the files, siblings told apart by
// what the data say; and, where no preset is given, which of the built-in maps fits.
// Before: files, built_in_maps or a map of the user's. After: import_rows reads with the chosen columns.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/import_rows.h"
#include "sessions/import/map/column_map.h"

namespace herr {

struct RecordingFiles {
  std::filesystem::path head;                 // empty: none, the head stands still
  std::optional<std::filesystem::path> gaze;  // none: in the head's file, or not recorded
};

struct ChosenFormat {
  std::shared_ptr<const ColumnMap> map;
  std::string preset;  // empty: a map of the user's
  ImportColumns columns;
  std::string variant;               // chosen among siblings; empty where there were none
  std::vector<std::string> remarks;  // "variant gen2 was taken: ...", whole sentences
};

// `preset` empty and no `map`: every built-in map is tried. `variant`: the user's word among siblings, or empty.
// Throws InputError that names what is missing; where several fit and the data cannot tell, all of them.
ChosenFormat choose_format(const RecordingFiles& files, const std::string& preset,
                           std::shared_ptr<const ColumnMap> map, const std::string& variant,
                           const StillParts& still);

}  // namespace herr
