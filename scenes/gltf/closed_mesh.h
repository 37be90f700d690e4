// Is a mesh a closed surface that faces outwards? Then its back faces can only be seen from within, and a
// renderer need not ask of each hit which side it is on. Before: mesh_builder. After: TriangleMesh::closed.
#pragma once

#include "scenes/model/scene.h"

namespace herr {

// Every edge is passed as often in one direction as in the other, by triangles that have an area, and each
// part encloses a volume with its fronts outside. A part is what hangs together by edges of two triangles.
// Vertices at the same place count as one; edges that do not meet end to end leave a surface open. Inward
// shells, cavities and sheets without thickness: false. O(n log n).
bool is_closed_outwards(const TriangleMesh& mesh);

}  // namespace herr
