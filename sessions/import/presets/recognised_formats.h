// Which built-in maps a recording fits by its columns, and what is said of one that fits none or another than
// the user named. Before: fitting_columns. After: choose_format, which lets the data decide between those
// that fit.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/presets/choose_format.h"
#include "sessions/import/presets/fitting_columns.h"

namespace herr {

std::shared_ptr<const ColumnMap> parsed(const BuiltInMap& map);
const std::filesystem::path& any_file(const FormatRequest& request);
FittingResult fitting(const FormatRequest& request, const std::shared_ptr<const ColumnMap>& map,
                      const std::string& preset);

// Of all built-in maps, those that ask for the most columns by name: a table of bare numbers fits any map
// that counts columns.
std::vector<FittingColumns> recognised(const FormatRequest& request);
// The presets of a list, each once: "euroc, tum".
std::string presets_in(const std::vector<FittingColumns>& formats);

// What a preset or map that does not fit lacks, and the preset that fits instead.
[[noreturn]] void fail_misfit(const FormatRequest& request, const InputError& missing);
// No preset fits: what is wrong with the file, or which part of a recording it is.
[[noreturn]] void fail_unrecognised(const FormatRequest& request);
// The columns that a preset counts stand elsewhere in a table whose names are another's. Throws InputError.
void refuse_named_columns(const FormatRequest& request);

}  // namespace herr
