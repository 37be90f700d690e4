// More samples change the noise, not the mean: light samples up: no bias, less noise.
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"

namespace herr {

void measure_samples(const RelationCase&, RelationLog&) {}

}  // namespace herr
