// What a glTF material asks for and pictures do not show: said at load, with the material's name, so that
// nobody takes it for what its author meant. Before: material_builder. After: Scene::warnings, which
// `inspect` prints.
#pragma once

#include <string>
#include <vector>

#include "scenes/gltf/file/gltf_model.h"

namespace herr {

// Of the surface and of its coat, textures counted with their means.
struct MeanRoughness {
  float surface = 0.0f, coat = 0.0f;
};

// One line for each loss; none for a material that shows as it should.
std::vector<std::string> material_losses(const GltfMaterial& from, const MeanRoughness& mean);

}  // namespace herr
