// What a MagicaVoxel .vox file holds, checked but not yet placed: models, palette, materials, scene
// graph. Before: vox_bytes. After: vox_graph finds out which models are shown where, load_vox makes
// grids of them. Format: github.com/ephtracy/voxel-model, MagicaVoxel-file-format-vox.txt (version 150)
// and its extension (200).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace herr {

using VoxDictionary = std::map<std::string, std::string>;

// Axes as in the file: x to the right, y away from the viewer, z up.
struct VoxModel {
  int size_x = 0, size_y = 0, size_z = 0;  // 1 ... 256
  std::string_view voxels;  // x, y, z, colour index each, within the size; views the file's bytes
};

enum class VoxNodeKind : std::uint8_t { transform, group, shape };

struct VoxNode {
  VoxNodeKind kind = VoxNodeKind::group;
  std::size_t offset = 0;              // in the file
  bool hidden = false;                 // of a transform
  std::string name;                    // of a transform
  std::int32_t layer = -1;             // of a transform
  VoxDictionary frame;                 // of a transform: its first frame
  std::vector<std::int32_t> children;  // nodes; of a shape: models
  std::size_t frames = 1;              // of a transform
};

struct VoxFile {
  std::vector<VoxModel> models;
  std::array<std::uint32_t, 256> palette{};         // of colour index i, R in the low byte; A is always 255
  std::map<std::int32_t, VoxDictionary> materials;  // by colour index
  std::map<std::int32_t, VoxNode> nodes;            // none in files of old programs
  std::map<std::int32_t, bool> layer_hidden;
};

// `bytes` must outlive the result. Throws InputError that names the byte.
VoxFile parse_vox(std::string_view bytes, const std::filesystem::path& file);

// Colours of a file without a palette.
std::array<std::uint32_t, 256> default_vox_palette();

}  // namespace herr
