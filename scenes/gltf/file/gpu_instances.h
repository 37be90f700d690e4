// EXT_mesh_gpu_instancing: one node that shows its mesh many times, each time by a transform of its own.
// Before: read_gltf. After: node_flattener places the instances. Source: the extension's specification.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "scenes/gltf/file/gltf_model.h"

namespace herr {

// Fills GltfNode::instancing; model.nodes and model.accessors are there already. Throws InputError for
// accessors that do not exist, and where their counts differ.
void read_gpu_instances(const nlohmann::json& document, const std::filesystem::path& file, GltfModel& model);

// node_from_instance of each instance, in order; one identity for a node without the extension. Throws
// InputError for components of the wrong type and rotations without direction.
std::vector<glm::dmat4x3> instance_transforms(const GltfModel& model, const GltfNode& node);

}  // namespace herr
