// Decodes glTF accessors to plain arrays: any component type, normalised or not, interleaved, sparse.
// Before: read_gltf (extents are proved). After: mesh_builder. Source: glTF 2.0 sections 3.6 and 3.11.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/gltf/file/gltf_model.h"

namespace herr {

// `components` floats per element. Throws InputError when the accessor has another number of components, or a
// value that is not finite or beyond kFarthest_m.
std::vector<float> read_floats(const GltfModel& model, int accessor, int components);
// Unsigned integers; each < `vertex_count`, else InputError.
std::vector<std::uint32_t> read_indices(const GltfModel& model, int accessor, std::size_t vertex_count);

}  // namespace herr
