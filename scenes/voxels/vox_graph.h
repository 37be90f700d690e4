// The scene graph of a .vox file -> which models stand where. Transforms have whole-number translations and
// rotations by quarter turns, mirrors included. Before: vox_file. After: load_vox makes instances.
#pragma once

#include <cstddef>
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
  std::size_t hidden = 0;    // shapes that are not shown: they or their layer are hidden
  std::size_t animated = 0;  // nodes with more than one frame or model; the first is shown
};

// Throws InputError: a node that does not exist, lies in a cycle or below two parents, or too deep.
VoxShow placed_models(const VoxFile& vox, const std::filesystem::path& file);

}  // namespace herr
