// The scene graph of a .vox file -> which models stand where. Transforms have whole-number translations and
// rotations by quarter turns, mirrors included. A node with several parents shows once below each. Before:
// vox_tally. After: load_vox makes instances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x3.hpp>
#include <string>
#include <vector>

#include "scenes/voxels/vox_file.h"

namespace herr {

struct PlacedModel {
  std::size_t model = 0;
  std::string name;                  // of the nearest transform above that has one
  glm::dmat4x3 vox_from_model{1.0};  // in voxels, z up; a model's own coordinates begin at its corner
};

struct VoxShow {
  std::vector<PlacedModel> models;
  std::int64_t hidden = 0;   // models that are not shown: a node above them or its layer is hidden
  std::size_t animated = 0;  // nodes shown that have more than one frame or model; the first is shown
};

// Throws InputError: what tally_vox_graph throws; a transform that is none.
VoxShow placed_models(const VoxFile& vox, const std::filesystem::path& file);

}  // namespace herr
