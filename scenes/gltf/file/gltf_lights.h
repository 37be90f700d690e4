// Point, spot and directional lights of a glTF file (KHR_lights_punctual), checked and read from its JSON.
// Before: read_gltf. After: node_flattener places them.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "scenes/gltf/file/gltf_model.h"

namespace herr {

// Fills model.lights and GltfNode::light; model.nodes are there already. The extension's candela
// and lux are taken as W/sr and W/m^2: brightness in a picture is relative. Throws InputError for
// what the extension forbids.
void read_gltf_lights(const nlohmann::json& document, const std::filesystem::path& file, GltfModel& model);

}  // namespace herr
