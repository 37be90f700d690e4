// What the worst relations look like. Before: RelationResult with pictures. After: StabilityRecord::pictures.
#pragma once

#include <span>
#include <vector>

#include "server/study/relations/relation.h"
#include "server/study/report/study_record.h"

namespace herr {

// The three worst of those that have pictures, as worst_first() orders them: got, wanted, difference. Its
// gain is the largest power of two at which no difference leaves the ramp; the caption says it.
std::vector<StudyPicture> worst_shown(std::span<const RelationResult> results);

}  // namespace herr
