// Everything that a stability report is made of: the content of stability.json. Page and text are pure
// functions of it. Before: stability_record_of, or stability.json read again. After: stability_json,
// stability_text, stability_page.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/study/relations/relation.h"
#include "server/study/report/study_record.h"

namespace herr {

// Raised whenever a field changes its meaning.
inline constexpr int kStabilityVersion = 1;

struct StabilityRecord : ReportHead {
  std::string settings;   // of most relations, one line
  std::string viewports;  // as small as they are rendered: "left_context 131x112, ..."
  StudyFrame frame;
  double seconds = 0;
  std::vector<RelationResult> results;  // by group; without RelationResult::pictures
  std::vector<StudyPicture> pictures;   // of the worst
  std::vector<std::string> warnings;
};

}  // namespace herr
