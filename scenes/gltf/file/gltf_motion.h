// What makes a glTF file move: animations, skins, morph targets, and the parts of nodes that they change.
// Before: read_gltf (every index is proved). After: animated_model, mesh_deformation.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "scenes/gltf/file/gltf_model.h"

namespace herr {

// Fills skins and animations of the model, and what nodes, meshes and primitives have for them; its nodes,
// meshes and accessors are there already. Throws InputError for a channel without sampler, values or a path
// that glTF knows, and for one that moves a node which stands by a matrix.
void read_gltf_motion(const nlohmann::json& document, const std::filesystem::path& file, GltfModel& model);

// KHR_node_visibility: whether nodes show. Throws InputError where that is no truth value.
void read_gltf_visibility(const nlohmann::json& document, const std::filesystem::path& file,
                          GltfModel& model);

}  // namespace herr
