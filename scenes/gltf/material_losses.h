// What glTF materials ask for and pictures do not show: said at load, with the materials' names, so that
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

// Collects them over the materials of a file.
class MaterialLosses {
 public:
  void add(const GltfMaterial& from, const MeanRoughness& mean);
  // One line for each kind of loss, which names its materials: the first four, and how many others there are.
  std::vector<std::string> lines() const;

 private:
  struct Loss {
    std::string text;
    std::vector<std::string> names;  // of materials, each once
  };
  void say(const GltfMaterial& from, const std::string& text);

  std::vector<Loss> losses_;
};

}  // namespace herr
