// Which format a recording has: the alternatives of a map whose columns are in the files, siblings told apart
// by what the data say; and, where no preset is given, which of the built-in maps fits. Before:
// fitting_columns. After: import_rows reads with the chosen columns.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sessions/import/import_rows.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/presets/fitting_columns.h"

namespace herr {

struct FormatRequest {
  RecordingFiles files;
  std::string preset;                    // empty and no map: every built-in map is tried
  std::shared_ptr<const ColumnMap> map;  // of the user's
  std::string variant;                   // the user's word among siblings, or empty
  StillParts still;
};

struct ChosenFormat {
  FittingColumns format;
  std::vector<std::string> remarks;  // "variant gen2 was taken: ...", whole sentences
  std::string alike{};               // formats that fit the data as well, in words; empty: none, it was told
};

// Throws InputError that names what is missing, and the format that fits instead; where several fit and the
// data cannot tell, all of them.
ChosenFormat choose_format(const FormatRequest& request);

// The files as import_rows takes them.
ImportRequest import_request(const FormatRequest& request, const ImportColumns& columns);

}  // namespace herr
