// Which meshes are closed and face outwards: their backs are seen from within alone.
#include "scenes/gltf/closed_mesh.h"

#include <gtest/gtest.h>

#include <utility>

namespace herr::test {
namespace {

TEST(ClosedMesh, ASurfaceIsClosedWhenEveryEdgeIsPassedBothWays) {
  TriangleMesh tetrahedron;
  const glm::vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (const auto& face : faces) {  // three vertices of its own for each face
    const auto first = static_cast<std::uint32_t>(tetrahedron.positions.size());
    for (const int corner : face) tetrahedron.positions.push_back(corners[corner]);
    tetrahedron.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_TRUE(is_closed_outwards(tetrahedron));
  TriangleMesh open = tetrahedron;
  open.triangles.pop_back();
  EXPECT_FALSE(is_closed_outwards(open));
  TriangleMesh turned = tetrahedron;
  std::swap(turned.triangles[0][1], turned.triangles[0][2]);
  EXPECT_FALSE(is_closed_outwards(turned));
  EXPECT_FALSE(is_closed_outwards({}));
}

// Two triangles for each side of the box, their fronts outside.
void add_box(TriangleMesh& mesh, const glm::vec3& lower, const glm::vec3& upper, bool inwards = false) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (unsigned i = 0; i < 8; ++i) {
    mesh.positions.push_back(
        {(i & 1 ? upper : lower).x, (i & 2 ? upper : lower).y, (i & 4 ? upper : lower).z});
  }
  const unsigned quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads) {
    for (const unsigned second : {1u, 2u}) {
      const unsigned a = q[second], b = q[second + 1];
      mesh.triangles.push_back({first + q[0], first + (inwards ? b : a), first + (inwards ? a : b)});
    }
  }
}

TEST(ClosedMesh, AClosedSurfaceFacesOutwardsWhenEachPartEnclosesAPositiveVolume) {
  const auto of_boxes = [](bool second_inwards, const glm::vec3& lower, const glm::vec3& upper) {
    TriangleMesh mesh;
    add_box(mesh, {0, 0, 0}, {1, 1, 1});
    add_box(mesh, lower, upper, second_inwards);
    return mesh;
  };
  TriangleMesh outwards, inwards;
  add_box(outwards, {0, 0, 0}, {1, 1, 1});
  add_box(inwards, {0, 0, 0}, {1, 1, 1}, true);
  EXPECT_TRUE(is_closed_outwards(outwards));
  EXPECT_FALSE(is_closed_outwards(inwards));
  // Parts are judged alone: apart, one in the other (a cavity), joined by an edge or a corner.
  const std::pair<glm::vec3, glm::vec3> places[] = {{{5, 5, 5}, {5.1f, 5.1f, 5.1f}},
                                                    {{0.2f, 0.2f, 0.2f}, {0.8f, 0.8f, 0.8f}},
                                                    {{1, 1, 0}, {1.5f, 1.5f, 1}},
                                                    {{1, 1, 1}, {1.5f, 1.5f, 1.5f}}};
  for (const auto& [lower, upper] : places) {
    EXPECT_TRUE(is_closed_outwards(of_boxes(false, lower, upper))) << lower.x;
    EXPECT_FALSE(is_closed_outwards(of_boxes(true, lower, upper))) << lower.x;
  }
  // A card of a hundredth of a millimetre has an inside; two sides in one plane have none.
  TriangleMesh card, sheet;
  add_box(card, {0, 0, 0}, {1, 1, 1e-5f});
  EXPECT_TRUE(is_closed_outwards(card));
  add_box(sheet, {0, 0, 0}, {1, 1, 0});
  EXPECT_FALSE(is_closed_outwards(sheet));
  // Neither size nor a place far away changes that: 24 bits hold a box of 1 at 1e5 m.
  for (const float scale : {1e-6f, 1e6f}) {
    TriangleMesh other;
    add_box(other, {0, 0, 0}, glm::vec3{scale});
    EXPECT_TRUE(is_closed_outwards(other)) << scale;
  }
  TriangleMesh far_out, far_in;
  add_box(far_out, glm::vec3{1e5f}, glm::vec3{1e5f + 1});
  add_box(far_in, glm::vec3{1e5f}, glm::vec3{1e5f + 1}, true);
  EXPECT_TRUE(is_closed_outwards(far_out));
  EXPECT_FALSE(is_closed_outwards(far_in));
}

}  // namespace
}  // namespace herr::test
