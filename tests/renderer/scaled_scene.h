// A scene (scenes/model/similar_scene.h) and what looks at it, grown or shrunk as a whole. Before:
// test_scenes.h. After: pictures that must not differ.
#pragma once

#include <utility>
#include <vector>

#include "scenes/model/similar_scene.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {

// by_nodes: matrices of instances grow, as with a scaled root node. by_vertices: coordinates of meshes do.
enum class Growth : std::uint8_t { by_nodes, by_vertices };

inline Scene scaled_scene(Scene scene, double factor, Growth growth) {
  Similarity similarity;
  similarity.scale = factor;
  if (growth == Growth::by_nodes) return similar_scene(std::move(scene), similarity);
  std::vector<glm::dmat4x3> before;
  for (const Instance& instance : scene.instances) before.push_back(instance.world_from_object);
  scene = similar_scene(std::move(scene), similarity);
  for (TriangleMesh& mesh : scene.meshes) {
    for (glm::vec3& p : mesh.positions) p = glm::vec3(factor * glm::dvec3(p));
    for (CoarserMesh& form : mesh.coarser) form.error_m = static_cast<float>(factor * double{form.error_m});
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (scene.instances[i].kind != ShapeKind::mesh) continue;
    for (int axis = 0; axis < 3; ++axis) scene.instances[i].world_from_object[axis] = before[i][axis];
  }
  return scene;
}

inline FrameSample scaled_sample(FrameSample sample, double factor) {
  sample.head.world_from_head.position *= factor;
  for (Pose& eye : sample.head_from_eye) eye.position *= factor;
  return sample;
}

inline RenderSettings scaled_settings(RenderSettings settings, double factor) {
  settings.occlusion_radius_m *= factor;
  return settings;
}

// IEC 61966-2-1, in steps of 8 bits.
inline double srgb_step(double linear) {
  const double x = std::min(std::max(linear, 0.0), 1.0);
  return 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

// The share of pixels whose colours are within one step of 8-bit sRGB of the other picture's.
inline double share_alike(const RenderedFrame& a, const RenderedFrame& b) {
  std::int64_t alike = 0, all = 0;
  for (std::size_t i = 0; i < a.viewports.size(); ++i) {
    for_each_pixel(a.viewports[i], [&](int x, int y, const Pixel& pixel) {
      const Pixel other = pixel_at(b.viewports[i], x, y);
      bool same = true;
      for (std::size_t channel = 0; channel < 3; ++channel)
        same = same &&
               std::abs(std::round(srgb_step(pixel[channel])) - std::round(srgb_step(other[channel]))) <= 1;
      alike += same ? 1 : 0;
      ++all;
    });
  }
  return static_cast<double>(alike) / static_cast<double>(all);
}

}  // namespace herr::test
