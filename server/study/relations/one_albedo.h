// A case whose surfaces all look the same: matte, opaque, of one albedo and without a glow. Where light goes
// is asked of it, and not what surfaces are made of. Before: RelationCase. After: groups of relations.
#pragma once

#include "server/study/relations/relation_case.h"

namespace herr {

// Meshes lose the colours of their vertices, and voxels theirs.
RelationCase of_albedo(RelationCase subject, float albedo);

}  // namespace herr
