// Light that probes gather over time: memory of 0 and nearly all, lights that are switched.
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"

namespace herr {

void measure_probes(const RelationCase&, RelationLog&) {}

}  // namespace herr
