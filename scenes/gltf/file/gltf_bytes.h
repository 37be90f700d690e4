// The bytes of a glTF document: its buffers and pictures, from files beneath its folder, from data URIs and
// from the binary chunk of a .glb. Of a buffer that is longer than its byteLength the first bytes count.
// Before: gltf_checks has proved the document. After: read_gltf. Uses: sessions/files/contained_folder for
// every file that the document names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string_view>
#include <vector>

#include "scenes/gltf/file/gltf_limits.h"
#include "scenes/gltf/file/gltf_model.h"
#include "sessions/files/strict_json.h"

namespace herr {

struct GltfBytes {
  // Each has its byteLength; one that nobody reads is empty.
  std::vector<std::vector<unsigned char>> buffers;
  std::vector<GltfImage> images;
  std::set<std::filesystem::path> files;
  std::int64_t bytes_left = kMaxExternalBytes;  // of the budget of files
};

// The parts of a file: all of a .gltf is JSON. Throws InputError for a .glb whose chunks contradict its size.
struct GltfChunks {
  bool is_binary = false;
  std::string_view json, binary;
};
GltfChunks chunks_of(std::string_view bytes, const std::filesystem::path& file);

// Throws InputError for a file that is not there, lies outside the folder or holds too little. Data URIs of
// pictures that cannot be read are kept as failures: they matter where a material uses the picture.
GltfBytes read_gltf_bytes(const JsonObject& root, const GltfChunks& chunks);

}  // namespace herr
