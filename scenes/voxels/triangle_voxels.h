// Which voxels a triangle touches: exact test of a triangle against boxes, column by column of its flattest
// side, so that the work follows the triangle's area. Before: voxelise_mesh. Method: Akenine-Moeller, "Fast
// 3D Triangle-Box Overlap Testing" (2001).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

namespace herr {

using TriangleCorners = std::array<glm::dvec3, 3>;

// Does the triangle touch the unit box whose lower corner is `voxel`?
bool touches(const TriangleCorners& triangle, const glm::ivec3& voxel);

// Columns that for_each_touched will look at; what a caller bounds the work by.
std::int64_t column_count(const TriangleCorners& triangle, const glm::ivec3& counts);

// Calls visit(voxel) for each voxel of [0, counts) that the triangle touches. Corners in voxels.
void for_each_touched(const TriangleCorners& triangle, const glm::ivec3& counts,
                      const std::function<void(const glm::ivec3&)>& visit);

// Weights of the corners for the triangle's point nearest to `point` (Ericson, "Real-Time Collision
// Detection", 5.1.5).
glm::dvec3 nearest_weights(const TriangleCorners& triangle, const glm::dvec3& point);

}  // namespace herr
