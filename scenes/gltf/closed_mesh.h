// Is a mesh a closed surface that faces outwards? Then its back faces can only be seen from within, and a
// renderer need not ask of each hit which side it is on. Before: mesh_builder. After: TriangleMesh::closed.
#pragma once

#include "scenes/model/scene.h"

namespace herr {

// Every edge is passed as often in one direction as in the other, by triangles that have an area. Vertices at
// the same place count as one; edges that do not meet end to end leave a surface open. O(n log n).
bool is_closed(const TriangleMesh& mesh);

// is_closed, and each part encloses a volume with its fronts outside. A part is what hangs together by edges
// of two triangles. Inward shells, cavities and sheets without thickness: false.
bool is_closed_outwards(const TriangleMesh& mesh);

// is_closed, and encloses more volume with its backs outside than with its fronts: as hulls do that are drawn
// around a body for an outline, and rooms whose walls are seen from within.
bool is_closed_inwards(const TriangleMesh& mesh);

}  // namespace herr
