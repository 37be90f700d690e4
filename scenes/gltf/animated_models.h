// A glTF file's nodes, skins and the clip that plays -> an AnimatedModel; what bends a primitive -> a
// MeshDeformation. Before: gltf_motion. After: load_gltf. Every count and range is proved here.
// Source: glTF 2.0 sections 3.7.2.2, 3.7.3 and 3.11.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/mesh_builder.h"
#include "scenes/model/animated_model.h"

namespace herr {

// Which clip of a file plays. Neither name nor number: the first.
struct PlaybackRequest {
  bool play = true;
  std::optional<std::string> name;
  std::optional<int> number;
  double speed = 1, offset_s = 0;
  bool loop = true;

  bool operator==(const PlaybackRequest&) const = default;
};

// All clips are checked; only the one that plays is kept. Throws InputError for times that do not grow,
// counts that do not fit, and a clip that does not exist.
AnimatedModel animated_model(const GltfModel& model, const PlaybackRequest& request);

// Per node: the clip moves it, or one of its ancestors.
std::vector<bool> moved_nodes(const AnimatedModel& model);

// A primitive once built: where it stands in the scene, and which of its vertices were kept.
struct BuiltPrimitive {
  std::uint32_t mesh, material;
  const GltfPrimitive* from = nullptr;
  std::vector<std::uint32_t> sources;  // as of BuiltMesh; only where something may bend it
  int tangent_uv_set = 0;              // where its mesh has tangents: the coordinates that they follow
  bool made_tangents = false;          // these are ours, not the file's
  double unit = 1;                     // of its mesh's coordinates: how many of the file's
};

// None for a primitive that a node neither skins nor morphs. `mesh` is its shape at rest. Throws InputError
// for joints that do not exist, counts that do not fit, and more than the budget reaches for.
std::optional<MeshDeformation> mesh_deformation(const GltfModel& model, const BuiltPrimitive& primitive,
                                                int node, const TriangleMesh& mesh, MeshBudget& budget);

}  // namespace herr
