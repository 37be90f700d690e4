// Which alternatives of a map find all their columns in the files of a recording: one candidate for each
// variant. Before: a map, files. After: choose_format takes one, format_trial tells several apart.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sessions/import/import_rows.h"
#include "sessions/import/presets/choose_format.h"

namespace herr {

struct FormatCandidate {
  std::shared_ptr<const ColumnMap> map;
  std::string preset, variant;
  ImportColumns columns;
  StillParts still;
};

// What is to be imported of these files with a candidate.
ImportRequest request_of(const RecordingFiles& files, const FormatCandidate& candidate);

// Those of one map, in its order. `variant`: only this one, or empty. Throws InputError where there are none:
// of the alternative that lacks least, the first column that it lacks.
std::vector<FormatCandidate> fitting_formats(const RecordingFiles& files,
                                             std::shared_ptr<const ColumnMap> map, const std::string& variant,
                                             const StillParts& still);

}  // namespace herr
