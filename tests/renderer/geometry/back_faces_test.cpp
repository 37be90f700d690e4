// Backs of single-sided surfaces: eyes look past them, whether a mesh is open, closed, inside out, mirrored
// or around the eye. Every shape glows, so colours are what its material says. Each case is rendered as a
// mesh that is known to be closed (no filter) and as one that is not.
#include <gtest/gtest.h>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

const glm::vec3 kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1};

Material one_sided(const glm::vec3& colour) {
  Material material = test::glowing(colour);
  material.double_sided = false;
  material.specular = 0;
  return material;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  for (glm::vec3& normal : mesh.normals) normal = -normal;
  return mesh;
}

TriangleMesh cube(float half, float distance = 4) {
  return test::box({-half, -half, -distance - half}, {half, half, -distance + half});
}

RenderedFrame look(const Scene& scene, Foveation foveation = Foveation::off) {
  RenderSettings settings = test::small_settings();
  settings.foveation = foveation;
  return test::render(scene, test::single_view(64, 64, 30, 30), settings, test::sample_from({0, 0, 0}));
}

glm::vec3 seen_at(const RenderedFrame& frame, double right_deg) {
  const double scale = 32 / std::tan(glm::radians(30.0));
  const int x = static_cast<int>(32 + scale * std::tan(glm::radians(right_deg)));
  const test::Pixel pixel = test::pixel_at(frame.viewports[0], x, 32);
  return {static_cast<float>(pixel[0]), static_cast<float>(pixel[1]), static_cast<float>(pixel[2])};
}

// Both ways of tracing show `colour` at `right_deg` from the middle, on a polar grid (in the middle) too.
void expect_seen(Scene scene, const glm::vec3& colour, double right_deg = 0) {
  for (const bool closed : {false, true}) {
    SCOPED_TRACE(closed ? "no filter" : "filter");
    for (TriangleMesh& mesh : scene.meshes) mesh.closed = closed;
    const RenderedFrame frame = look(scene);
    EXPECT_EQ(seen_at(frame, right_deg), colour);
    test::expect_finite(frame);
    if (right_deg == 0) {
      EXPECT_EQ(seen_at(look(scene, Foveation::log_polar), 0), colour);
    }
  }
}

TEST(BackFacesTest, AShellThatFacesInwardsShowsWhatItHolds) {
  Scene scene;
  scene.environment = kBlue;
  test::add(scene, inside_out(cube(1)), one_sided(kRed));
  expect_seen(scene, kRed);  // the inside of its far wall
  test::add(scene, cube(0.3f), one_sided(kGreen));
  expect_seen(scene, kGreen);
}

TEST(BackFacesTest, FromInsideAShellThatFacesOutwardsTheWorldIsSeen) {
  Scene scene;
  scene.environment = kBlue;
  test::add(scene, cube(1, 0), one_sided(kRed));
  expect_seen(scene, kBlue);
  test::add(scene, cube(2, 0), one_sided(kRed));  // several backs, one behind the other
  test::add(scene, cube(1, 8), one_sided(kGreen));
  expect_seen(scene, kGreen);
  for (Material& material : scene.materials) material.double_sided = true;
  expect_seen(scene, kRed);
}

TEST(BackFacesTest, AnOutlineByAnInvertedHullIsARim) {
  // From 3 m a ball of 1 m ends at asin(1 / 3) = 19.5 degrees, one of 1.1 m at 21.5.
  Scene scene;
  scene.environment = kBlue;
  test::add(scene, test::sphere({0, 0, -3}, 1, 48, 96), one_sided(kGreen));
  test::add(scene, inside_out(test::sphere({0, 0, -3}, 1.1f, 48, 96)), one_sided({0, 0, 0}));
  expect_seen(scene, kGreen);
  expect_seen(scene, kGreen, 18.5);
  expect_seen(scene, {0, 0, 0}, 20.5);
  expect_seen(scene, kBlue, 23);
}

TEST(BackFacesTest, AClosedBlendedShellIsOneLayer) {
  // Half of red over white; its far wall shows its back.
  Scene scene;
  scene.environment = glm::vec3{1.0f};
  Material half = one_sided(kRed);
  half.alpha_mode = AlphaMode::blend;
  half.alpha = 0.5f;
  test::add(scene, cube(1), half);
  expect_seen(scene, {1, 0.5f, 0.5f});
  scene.materials[0].double_sided = true;  // two layers: 0.25 of the white are left
  expect_seen(scene, {1, 0.25f, 0.25f});
}

TEST(BackFacesTest, AMaskedShellIsSeenFromItsFrontOnly) {
  Material cut = one_sided(kRed);
  cut.alpha_mode = AlphaMode::mask;
  Scene scene;
  scene.environment = kBlue;
  test::add(scene, cube(1, 0), cut);
  expect_seen(scene, kBlue);
  scene.meshes[0] = cube(1);
  expect_seen(scene, kRed);
}

TEST(BackFacesTest, AMirroredNodeTurnsTheWindingWithIt) {
  // glTF: where the determinant is negative, fronts are wound clockwise. What was outside stays outside.
  glm::dmat4x3 mirror{1.0};
  mirror[0].x = -1;
  Scene scene;
  scene.environment = kBlue;
  test::add(scene, cube(1), one_sided(kRed), false, mirror);
  test::add(scene, cube(0.3f), one_sided(kGreen));
  expect_seen(scene, kRed);
  scene.meshes[0] = inside_out(cube(1));
  expect_seen(scene, kGreen);
}

TEST(BackFacesTest, AHollowBodyShowsTheWallThatFacesTheEye) {
  Scene scene;
  test::add(scene, cube(1), one_sided(kRed));
  test::add(scene, inside_out(cube(0.8f)), one_sided(kGreen));  // its cavity's wall
  expect_seen(scene, kRed);
  scene.meshes = {cube(1, 0), inside_out(cube(0.8f, 0))};
  expect_seen(scene, kGreen);
}

// A prism over a bow-tie: one loop of it is inside out, though all edges meet end to end. The larger loop,
// on the right, faces outwards.
TEST(BackFacesTest, WhereASurfaceCrossesItselfEachSideIsJudgedAlone) {
  const glm::vec3 outline[4] = {{-1, 0, -3.5f}, {1.5f, 0, -5}, {1.5f, 0, -2}, {-1, 0, -4.5f}};
  TriangleMesh mesh;
  for (int i = 0; i < 4; ++i) {
    const TriangleMesh side =
        test::quad(outline[i] + glm::vec3{0, -1, 0}, outline[(i + 1) % 4] - outline[i], {0, 2, 0});
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), side.positions.begin(), side.positions.end());
    mesh.normals.insert(mesh.normals.end(), side.normals.begin(), side.normals.end());
    for (const auto& t : side.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  Scene scene;
  scene.environment = kBlue;
  test::add(scene, inside_out(mesh), one_sided(kRed));
  test::add(scene, test::sphere({-0.9f, 0, -4}, 0.1f), one_sided(kGreen));
  test::add(scene, test::sphere({1.2f, 0, -3.5f}, 0.1f), one_sided(kGreen));
  const double left = glm::degrees(std::atan2(-0.9, 4.0)), right = glm::degrees(std::atan2(1.2, 3.5));
  glm::vec3 seen[2];
  for (const bool turned : {false, true}) {
    if (turned) scene.meshes[0] = mesh;
    for (const bool closed : {false, true}) {
      for (TriangleMesh& m : scene.meshes) m.closed = closed;
      const RenderedFrame frame = look(scene);
      // The loop that shows its fronts hides its ball, the other one does not.
      seen[0] = seen_at(frame, left), seen[1] = seen_at(frame, right);
      EXPECT_EQ(seen[0], turned ? kRed : kGreen) << closed;
      EXPECT_EQ(seen[1], turned ? kGreen : kRed) << closed;
    }
  }
}

TEST(BackFacesTest, FromOutsideAClosedShellCostsNoFurtherRays) {
  Scene scene;
  test::add(scene, cube(1), one_sided(kRed));
  scene.meshes[0].closed = true;
  EXPECT_EQ(look(scene).counters.rays[RayKind::behind], 0);
  scene.meshes[0] = cube(1, 0);
  scene.meshes[0].closed = true;
  const RenderedFrame inside = look(scene);
  EXPECT_EQ(inside.counters.rays[RayKind::behind], inside.counters.rays[RayKind::primary]);
}

TEST(BackFacesTest, BothSidesCastShadows) {
  for (const bool turned : {false, true}) {
    Scene scene;
    test::add(scene, test::floor_quad(5, -1), test::matte(glm::vec3{0.5f}));
    Material roof = test::matte(glm::vec3{0.5f});
    roof.double_sided = false;
    const TriangleMesh shell = test::box({-4, 2, -5}, {4, 3, 4});
    test::add(scene, turned ? inside_out(shell) : shell, roof);
    scene.meshes[1].closed = true;
    scene.lights = {test::light_at({0, 6, -1}, glm::vec3{20.0f})};
    const RenderedFrame frame = test::render(scene, test::single_view(8, 8, 10, 10), test::planar_settings(),
                                             test::looking_down({0, 1, -1}));
    EXPECT_EQ(test::pixel_at(frame.viewports[0], 4, 4)[1], 0.0);
  }
}

}  // namespace
}  // namespace herr
