// Wherever the eye looks every pixel has data: gaze, polar widths and viewports at their limits.
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"

namespace herr {

void measure_gaze(const RelationCase&, RelationLog&) {}

}  // namespace herr
