// Proves a glTF document sound before tinygltf or we follow any of its numbers: tinygltf 2.7.0 checks no
// extent and reads out of bounds. Before: sessions/strict_json has parsed the text (depth, size, duplicate
// keys). After: gltf_bytes, and read_gltf hands the same document to tinygltf. Rules: glTF 2.0, Khronos.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace herr {

// Throws InputError that names the field. Returns warnings (without the file's name) about
// what is left out.
std::vector<std::string> check_gltf_document(const nlohmann::json& document,
                                             const std::filesystem::path& file, bool binary);

// Parts of the above. Storage: buffers, bufferViews, accessors, images (gltf_checks.cpp); references: meshes,
// textures, nodes, scenes (gltf_reference_checks.cpp). Materials are checked where they are read.
void check_gltf_references(const nlohmann::json& document, const std::filesystem::path& file);
// What moves a model or is not drawn (gltf_further_checks.cpp).
void check_gltf_further_references(const nlohmann::json& document, const std::filesystem::path& file);

}  // namespace herr
