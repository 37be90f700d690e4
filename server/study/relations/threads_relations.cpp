// The same bytes by any number of threads: threads and instruction sets.
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"

namespace herr {

void measure_threads(const RelationCase&, RelationLog&) {}

}  // namespace herr
