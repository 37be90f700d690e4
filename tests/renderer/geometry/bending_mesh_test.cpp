// Meshes that bend: that they look like meshes loaded bent, with their normals and
// tangents, and what it costs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "renderer/frame/renderer_impl.h"
#include "scenes/animation/bend_mesh.h"
#include "scenes/model/placed_objects.h"
#include "tests/renderer/geometry/changing_scenes.h"

namespace herr {
namespace {

using test::bring_up_to_date;
using test::with_threads;

// A sheet of n x n squares that a skin of two joints bends.
Scene bending_sheet(int n) {
  Scene scene;
  TriangleMesh mesh;
  MeshDeformation deformation;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(n),
                  v = static_cast<float>(y) / static_cast<float>(n);
      mesh.positions.push_back({2 * u - 1, 2 * v - 1, 0});
      mesh.normals.push_back({0, 0, 1});
      deformation.joints.insert(deformation.joints.end(), {0, 1, 0, 0});
      deformation.weights.insert(deformation.weights.end(), {1 - u, u, 0, 0});
    }
  }
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  deformation.rest_positions = mesh.positions;
  deformation.rest_normals = mesh.normals;
  deformation.influences = 4;
  deformation.skin = 0;
  deformation.mesh = 0;
  test::add(scene, std::move(mesh), test::matte(glm::vec3{0.7f}), false,
            glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -3)));
  scene.lights = {test::light_at({1, 3, 0}, {20, 15, 10})};
  scene.deformations.push_back(std::move(deformation));
  complete_objects(scene);
  return scene;
}

// The second joint turned about the x axis.
DeformationPose turned(double angle, std::uint32_t version) {
  DeformationPose pose;
  pose.version = version;
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
  pose.joints = {{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {1, 0, 0, 0, c, s, 0, -s, c, 0, 0, 0}};
  return pose;
}

// The same scene with its mesh bent beforehand.
Scene bent_beforehand(const Scene& scene, const DeformationPose& pose) {
  Scene bent = scene;
  bend_mesh(scene.deformations[0], pose, bent.meshes[0]);
  bent.deformations.clear();
  return bent;
}

// The second joint turned, and everything mirrored.
DeformationPose mirrored(const DeformationPose& pose) {
  DeformationPose other = pose;
  for (auto& joint : other.joints) {
    for (std::size_t column = 0; column < 4; ++column) joint[3 * column] = -joint[3 * column];
  }
  return other;
}

// Of all values, by more than 8 steps of a half.
double share_of_differing(const RenderedFrame& one, const RenderedFrame& other) {
  std::int64_t differing = 0, all = 0;
  for (std::size_t v = 0; v < one.viewports.size(); ++v) {
    const auto& a = one.viewports[v].rgba_half;
    const auto& b = other.viewports[v].rgba_half;
    EXPECT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      ++all;
      differing += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i])) > 8 ? 1 : 0;
    }
  }
  return static_cast<double>(differing) / static_cast<double>(all);
}

void expect_bent_as_if_loaded_bent(const Scene& scene, const DeformationPose& pose) {
  SceneState state;
  scene_state_at(scene, 0, state);
  const FrameSample sample = test::sample_from({0, 0, 0});
  for (const int threads : {1, 2, 4}) {
    Renderer renderer(scene, test::small_profile(), with_threads(threads), false);
    RenderedFrame frame;
    state.poses = {turned(0, 1)};
    renderer.render_frame(sample, state, frame);
    state.poses = {pose};
    renderer.render_frame(sample, state, frame);
    EXPECT_EQ(frame.counters.meshes_refitted + frame.counters.meshes_rebuilt, 1);
    EXPECT_EQ(frame.counters.commits, 2);  // the mesh and the top level
    const RenderedFrame other = test::render(bent_beforehand(scene, state.poses[0]), test::small_profile(),
                                             with_threads(threads), sample);
    // Kernel and slow form add in another order: vertices differ by some 1e-7 and normals by a step of their
    // code, so pixels on silhouettes may differ and no others by more than a few steps of a half.
    EXPECT_LT(share_of_differing(frame, other), 0.005);
    renderer.render_frame(sample, state, frame);
    EXPECT_EQ(frame.counters.commits, 0);
  }
}

TEST(BendingMeshTest, ABentMeshLooksLikeOneThatWasLoadedBent) {
  expect_bent_as_if_loaded_bent(bending_sheet(20), turned(0.7, 2));
}

// With a normal texture that leans by 39 degrees along tangents that are halfway to the bitangents.
Scene textured_bending_sheet(int n) {
  Scene scene = bending_sheet(n);
  TriangleMesh& mesh = scene.meshes[0];
  mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.5f));
  mesh.tangents.assign(mesh.positions.size(), glm::vec4(0.6f, 0.8f, 0, -1));
  scene.deformations[0].rest_tangents = mesh.tangents;
  TextureImage image;
  image.width_px = image.height_px = 1;
  image.srgb = false;
  image.rgba = {230, 128, 255, 255};
  scene.textures.push_back(image);
  scene.materials[0].normal_texture = {0, 0};
  return scene;
}

// Every triangle has three vertices of its own, and its own normal.
void flatten(TriangleMesh& mesh, MeshDeformation& deformation) {
  const TriangleMesh from = std::exchange(mesh, {});
  const MeshDeformation bends = deformation;
  deformation.joints.clear();
  deformation.weights.clear();
  for (const auto& triangle : from.triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const std::uint32_t vertex : triangle) {
      mesh.positions.push_back(from.positions[vertex]);
      mesh.normals.push_back(from.normals[vertex]);
      mesh.uvs.push_back(from.uvs[vertex]);
      mesh.tangents.push_back(from.tangents[vertex]);
      for (std::size_t k = 0; k < 4; ++k) {
        deformation.joints.push_back(bends.joints[4 * vertex + k]);
        deformation.weights.push_back(bends.weights[4 * vertex + k]);
      }
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  deformation.flat_normals = true;
  deformation.rest_positions = mesh.positions;
  deformation.rest_normals = mesh.normals;
  deformation.rest_tangents = mesh.tangents;
}

TEST(BendingMeshTest, ABentMeshBendsItsTangentsToo) {
  Scene scene = textured_bending_sheet(20);
  for (const DeformationPose& pose : {turned(0.7, 2), mirrored(turned(0.7, 2))})
    expect_bent_as_if_loaded_bent(scene, pose);
  const TriangleMesh& mesh = scene.meshes[0];
  // And it matters: unbent tangents of a bent mesh look otherwise.
  const DeformationPose pose = turned(0.7, 2);
  const Scene bent = bent_beforehand(scene, pose);
  Scene unbent = bent;
  unbent.meshes[0].tangents = mesh.tangents;
  const FrameSample sample = test::sample_from({0, 0, 0});
  const auto picture = [&](const Scene& of) {
    return test::render(of, test::small_profile(), with_threads(1), sample);
  };
  EXPECT_GT(share_of_differing(picture(bent), picture(unbent)), 0.05);
}

TEST(BendingMeshTest, AFlatMeshBendsItsTangentsToo) {
  Scene scene = textured_bending_sheet(20);
  flatten(scene.meshes[0], scene.deformations[0]);
  for (const DeformationPose& pose : {turned(0.7, 2), mirrored(turned(0.7, 2))})
    expect_bent_as_if_loaded_bent(scene, pose);
}

TEST(BendingMeshTest, AMeshThatCrumplesIsBuiltAnew) {
  // Vertices that were neighbours end far apart: refitted boxes would all overlap.
  Scene scene = bending_sheet(40);
  MeshDeformation& deformation = scene.deformations[0];
  for (std::size_t i = 0; i < deformation.rest_positions.size(); ++i) {
    const float odd = i % 2 == 0 ? 0.0f : 1.0f;
    deformation.weights[4 * i] = 1 - odd;
    deformation.weights[4 * i + 1] = odd;
  }
  SceneState state;
  scene_state_at(scene, 0, state);
  Renderer renderer(scene, test::small_profile(), with_threads(1), false);
  RenderedFrame frame;
  state.poses = {turned(0, 1)};
  renderer.render_frame(test::sample_from({0, 0, 0}), state, frame);
  EXPECT_EQ(frame.counters.meshes_rebuilt, 0);
  state.poses = {turned(1.5, 2)};
  renderer.render_frame(test::sample_from({0, 0, 0}), state, frame);
  EXPECT_EQ(frame.counters.meshes_rebuilt, 1);
}

TEST(BendingMeshTest, AHundredThousandSkinnedTrianglesUpdateInAQuarterOfRebuildingThem) {
  const Scene scene = bending_sheet(224);  // 2 * 224^2 = 100,352
  RenderThreads threads(2);
  std::unique_ptr<EmbreeScene> geometry;
  threads.inside([&] { geometry = std::make_unique<EmbreeScene>(scene, resolve_isa(Isa::best), 2); });
  SceneState state;
  state.poses = {turned(0, 1)};
  std::vector<double> updates, rebuilds;
  const EmbreeDevice device(resolve_isa(Isa::best), 2);
  for (int i = 0; i < 9; ++i) {
    state.poses[0] = turned(0.05 * (i + 1), static_cast<std::uint32_t>(i + 2));
    updates.push_back(wall_ms([&] {
      geometry->bend(state, threads);
      threads.inside([&] { bring_up_to_date(*geometry, state); });
    }));
    rebuilds.push_back(wall_ms([&] {
      TriangleMesh mesh = scene.meshes[0];
      bend_mesh(scene.deformations[0], state.poses[0], mesh);
      threads.inside([&] { build_mesh(device, mesh, {}); });
    }));
  }
  std::printf("100k skinned triangles: update %.2f ms, rebuilding %.2f ms, ratio %.3f (medians of 9)\n",
              median(updates), median(rebuilds), median(updates) / median(rebuilds));
  EXPECT_LE(median(updates), 0.25 * median(rebuilds));
}

}  // namespace
}  // namespace herr
