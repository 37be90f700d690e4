// An instance and its material -> the record that shading reads. Before: mesh_geometry bakes the mesh. After:
// embree_scene keeps one record for each instance.
#pragma once

#include <span>

#include "renderer/geometry/shading_scene.h"
#include "renderer/geometry/triangle_records.h"
#include "scenes/model/scene.h"

namespace herr {

// `baked`: of the instance's mesh, null for other kinds; it and `textures` must outlive the record.
InstanceRecord instance_record(const Scene& scene, const Instance& instance, const BakedMesh* baked,
                               std::span<const TextureRecord> textures);

// What depends on the matrix alone, for an instance that has moved.
void set_matrix(const Instance& instance, InstanceRecord& record);

}  // namespace herr
