// A scene with one entry of each kind on a path. Before: a test says which path. After: load_scene.
#pragma once

#include <string>

#include "tests/scenes/voxels/vox_files.h"

namespace herr::test {

inline constexpr const char* kPath = R"("path": {"keys": [
  {"t_s": 0, "translation": [0, 1, 0]},
  {"t_s": 2, "translation": [4, 1, 0], "rotation_xyzw": [0, 0, 0.70710678118654757, 0.70710678118654757], "scale": 3},
  {"t_s": 5, "translation": [4, 1, 0], "rotation_xyzw": [0, 0, 0.70710678118654757, 0.70710678118654757], "scale": 3}]})";

// One entry of each kind on that path, each beside one that stands.
inline std::filesystem::path write_kinds(const TemporaryFolder& folder, const std::string& path = kPath) {
  write_model(folder, triangle_document());
  // Two models of one voxel, a voxel to either side of the origin: 0.2 m apart.
  const std::string graph = vox_transform(0, 1, {}) + vox_group(1, {2, 4}) +
                            vox_transform(2, 3, {{"_t", "-1 0 0"}}) + vox_shape(3, 0) +
                            vox_transform(4, 5, {{"_t", "1 0 0"}}) + vox_shape(5, 1);
  folder.write("two.vox",
               vox_bytes(vox_model(1, 1, 1, {{0, 0, 0, 1}}) + vox_model(1, 1, 1, {{0, 0, 0, 2}}) + graph));
  return folder.write("kinds.scene.json", R"({"format_version": 1, "name": "kinds",
    "catchers": [{"name": "door", "box": {"min": [-1, 0, -5], "max": [1, 2, -4.9]}, )" +
                                              path + R"(}],
    "shapes": [{"name": "ball", "sphere": {"centre": [9, 0, 0], "radius": 0.5}, )" +
                                              path + R"(},
               {"name": "crate", "box": {"centre": [0, 5, 0], "half_extents": [1, 2, 3]}}],
    "gltf": [{"file": "model.gltf", "name": "cup", "translation": [9, 9, 9], "scale": 2, )" +
                                              path + R"(},
             {"file": "model.gltf", "name": "spare", "present": false, )" +
                                              path + R"(}],
    "voxels": [{"file": "two.vox", "name": "cubes", )" +
                                              path + "}]}");
}

}  // namespace herr::test
