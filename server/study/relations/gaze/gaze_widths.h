// The user's own picture from polar buffers of growing width, against one ray per pixel: on the user's
// display and on viewports of 1 and of 179 degrees. Before: gaze_cases, near_rays. After: gaze_relations.
#pragma once

#include "server/study/relations/relation_groups.h"

namespace herr {

// Returns how many rays and values of its frames were invalid.
double measure_gaze_widths(const DrawFrame& draw, const RelationCase& subject, RelationLog& log);

}  // namespace herr
