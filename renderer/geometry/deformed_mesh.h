// A mesh that bends: skin and morph targets on this frame's pose, Embree's boxes refitted around it, its
// normals baked anew in place. Before: SceneState::poses. After: the instances of the mesh show the new
// shape. Source: glTF 2.0 section 3.7.3; the slow, obvious form of the arithmetic is
// scenes/animation/bend_mesh.h.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/geometry/mesh_geometry.h"
#include "renderer/threads/render_threads.h"
#include "scenes/model/scene.h"

namespace herr {

// How far a tree may degrade before it is built anew: summed areas of sampled groups of neighbouring
// triangles, over the area of the whole. Boxes that grow by half make rays enter about half as many more.
inline constexpr double kWorstGrowth = 1.5;

class DeformedMesh {
 public:
  // Makes a built mesh one that can be refitted (LOW quality, DYNAMIC; otherwise Embree builds anew without a
  // word). The three must outlive this; `built` stays where it is.
  DeformedMesh(const TriangleMesh& mesh, const MeshDeformation& deformation, MeshGeometry& built);

  // Bends the vertices on the render threads; false where the pose is the one that it has. Allocates nothing.
  bool bend(const DeformationPose& pose, RenderThreads& threads);
  // After bend(), inside the arena: refits, or builds anew where the measure asks for it. True: built anew.
  bool commit();
  std::int64_t bytes() const;  // beside those of the mesh

 private:
  struct alignas(16) Joint {
    float columns[4][4];
  };

  void bend_vertices(const DeformationPose& pose, std::size_t first, std::size_t last);
  void bake(std::size_t first, std::size_t last);
  void flatten_normals(std::size_t first, std::size_t last);
  void choose_groups();
  double spread() const;

  const TriangleMesh& mesh_;
  const MeshDeformation& deformation_;
  MeshGeometry& built_;
  RTCGeometry geometry_ = nullptr;                 // of the built scene
  float* vertices_ = nullptr;                      // Embree's own, three a vertex
  std::vector<Joint> joints_;                      // of this pose
  std::vector<std::uint32_t> normals_, tangents_;  // encoded; tangents where the mesh has them
  std::vector<glm::vec3> directions_;              // normals as numbers, unit; none where they are flat
  std::vector<float> handedness_;                  // of tangents
  std::vector<std::uint32_t> sampled_;             // triangles, kGroup neighbours in a row
  std::vector<std::uint64_t> order_;               // scratch of choose_groups
  double spread_when_built_ = 0;
  std::uint32_t version_ = 0;
};

}  // namespace herr
