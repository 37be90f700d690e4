// Reads one .gltf or .glb into GltfModel. The only door to tinygltf, and it opens after the checks.
// Before: load_gltf. Uses: gltf_checks, gltf_bytes for buffers and pictures; tinygltf sees a document without
// them, so that it opens no file. After: the builders.
#pragma once

#include <filesystem>

#include "scenes/gltf/file/gltf_model.h"

namespace herr {

// Every index and extent of the result is in range. Images are still encoded. Throws
// InputError for anything wrong.
GltfModel read_gltf(const std::filesystem::path& file);

}  // namespace herr
