// Light adds up: light times k, the sum of lights, lights inside and on surfaces.
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"

namespace herr {

void measure_light(const RelationCase&, RelationLog&) {}

}  // namespace herr
