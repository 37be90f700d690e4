// What follows time stays bounded: prediction, width control, loads that step.
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"

namespace herr {

void measure_control(const RelationCase&, RelationLog&) {}

}  // namespace herr
