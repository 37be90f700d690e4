// Materials at their limits: roughness 0, index of refraction 1 and 10, albedo 0 and 1.
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"

namespace herr {

void measure_surfaces(const RelationCase&, RelationLog&) {}

}  // namespace herr
