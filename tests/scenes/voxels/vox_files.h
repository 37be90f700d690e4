// .vox files written chunk by chunk. Before: a test says which chunks. After: load_vox reads the bytes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/scenes/scene_files.h"

namespace herr::test {

inline std::string int32(std::int32_t value) {
  return bytes_of<std::int32_t>({value});
}
inline std::string vox_text(const std::string& text) {
  return int32(static_cast<std::int32_t>(text.size())) + text;
}
inline std::string vox_dictionary(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string bytes = int32(static_cast<std::int32_t>(entries.size()));
  for (const auto& [key, value] : entries) bytes += vox_text(key) + vox_text(value);
  return bytes;
}
inline std::string vox_chunk(const std::string& id, const std::string& content) {
  return id + int32(static_cast<std::int32_t>(content.size())) + int32(0) + content;
}
inline std::string vox_model(int x, int y, int z, const std::vector<std::array<std::uint8_t, 4>>& voxels) {
  std::string content = int32(static_cast<std::int32_t>(voxels.size()));
  for (const auto& voxel : voxels) content.append(reinterpret_cast<const char*>(voxel.data()), 4);
  return vox_chunk("SIZE", int32(x) + int32(y) + int32(z)) + vox_chunk("XYZI", content);
}
inline std::string vox_transform(std::int32_t id, std::int32_t child,
                                 const std::vector<std::pair<std::string, std::string>>& frame,
                                 const std::vector<std::pair<std::string, std::string>>& attributes = {},
                                 std::int32_t layer = -1) {
  return vox_chunk("nTRN", int32(id) + vox_dictionary(attributes) + int32(child) + int32(-1) + int32(layer) +
                               int32(1) + vox_dictionary(frame));
}
inline std::string vox_group(std::int32_t id, const std::vector<std::int32_t>& children) {
  return vox_chunk("nGRP", int32(id) + vox_dictionary({}) +
                               int32(static_cast<std::int32_t>(children.size())) + bytes_of(children));
}
inline std::string vox_shape(std::int32_t id, std::int32_t model) {
  return vox_chunk("nSHP", int32(id) + vox_dictionary({}) + int32(1) + int32(model) + vox_dictionary({}));
}
inline std::string vox_bytes(const std::string& chunks, std::int32_t version = 150) {
  return "VOX " + int32(version) + "MAIN" + int32(0) + int32(static_cast<std::int32_t>(chunks.size())) +
         chunks;
}

}  // namespace herr::test
