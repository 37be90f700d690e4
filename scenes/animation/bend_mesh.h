// One mesh in a pose, vertex by vertex: the slow, obvious way. Before: a DeformationPose. After: the shape at
// load; the reference of the renderer's kernels. Source: glTF 2.0 section 3.7.3.
#pragma once

#include "scenes/model/scene.h"

namespace herr {

// Gives `mesh` its positions, normals and tangents (where it has these at rest). Normals are turned by each
// joint's inverse transpose, tangents by the joint itself, and both come out unit; where they vanish they
// stay as they were at rest. Flat normals follow the triangles: three vertices in a row are one.
void bend_mesh(const MeshDeformation& deformation, const DeformationPose& pose, TriangleMesh& mesh);

}  // namespace herr
