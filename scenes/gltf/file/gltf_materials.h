// Materials of a glTF file with the extensions that are honoured, checked and read from its JSON.
// Before: read_gltf. After: material_builder maps them to ours. Source: glTF 2.0 section 3.9,
// KHR_materials_*.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "scenes/gltf/file/gltf_model.h"

namespace herr {

// Fills model.materials; model.textures are there already, and every texture that a material names is one of
// them. Throws InputError for what the specification forbids.
void read_gltf_materials(const nlohmann::json& document, const std::filesystem::path& file, GltfModel& model);

}  // namespace herr
