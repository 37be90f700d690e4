// What the stage of surfaces leaves in a batch, lane by lane, for rays straight down at a surface in z = 0.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>

#include "renderer/geometry/embree_scene.h"
#include "renderer/surfaces/surfaces-inl.h"
#include "renderer/threads/render_threads.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

namespace kernels = HWY_NAMESPACE;

// One lane of a batch.
struct Seen {
  glm::vec3 normal, diffuse, f0, emission, absorption;
  float f90, alpha2, occlusion, curvature, transmission, index_ratio, dielectric_f0;
  float coat, coat_alpha2, sheen_alpha, stretch;
  glm::vec3 coat_normal, sheen, tangent;
};

glm::vec3 at(const Lane3& lanes) {
  return {lanes.x[0], lanes.y[0], lanes.z[0]};
}

// The surface that a ray from (x, y, 1) along -z meets.
Seen look_down(const Scene& scene, float x, float y) {
  RenderThreads threads(1);
  std::unique_ptr<EmbreeScene> geometry;
  threads.inside([&] { geometry = std::make_unique<EmbreeScene>(scene, resolve_isa(Isa::best), 1); });
  threads.inside([&] { geometry->place_at(glm::dvec3(0.0)); });
  FramePlan plan;
  plan.refraction = plan.further_lobes = true;
  ShadingInputs inputs;
  inputs.plan = &plan;
  inputs.scene = geometry->top();
  inputs.instances = geometry->instances();

  auto batch = std::make_unique<HitBatch>();
  batch->lobes = std::make_unique<FurtherLobes>();
  batch->cone_width.fill(0);
  batch->cone_spread.fill(0);
  alignas(64) kernels::RayHit packet{};
  alignas(64) int valid[kMaxLanes];
  for (int i = 0; i < kernels::kLanes; ++i) {
    packet.ray.org_x[i] = x;
    packet.ray.org_y[i] = y;
    packet.ray.org_z[i] = 1;
    packet.ray.dir_z[i] = -1;
    packet.ray.tfar[i] = 1e30f;
    packet.ray.mask[i] = kAllMask;
    packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    valid[i] = -1;
  }
  intersect_packet<kernels::kLanes>(valid, inputs.scene, true, &packet);
  const auto all = hwy::HWY_NAMESPACE::Eq(kernels::set(0), kernels::set(0));
  kernels::surface_of_packet<SurfaceDetail::all>(packet, all, inputs, false, *batch, 0);
  EXPECT_EQ(batch->kind[0], static_cast<int>(HitKind::object));
  const HitBatch& b = *batch;
  const FurtherLobes& l = *batch->lobes;
  return {at(b.normal),     at(b.diffuse),      at(b.f0),       at(b.emission),   at(b.absorption),
          b.f90[0],         b.alpha2[0],        b.occlusion[0], b.curvature[0],   b.transmission[0],
          b.index_ratio[0], b.dielectric_f0[0], l.coat[0],      l.coat_alpha2[0], l.sheen_alpha[0],
          l.stretch[0],     at(l.coat_normal),  at(l.sheen),    at(l.tangent)};
}

// A square of [-1, 1]^2 in z = 0, facing up, with u along x, v along y and tangents.
Scene square(const Material& material, const glm::dmat4& placed = glm::dmat4(1.0)) {
  Scene scene;
  TriangleMesh mesh = test::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  mesh.tangents.assign(4, {1, 0, 0, 1});
  test::add(scene, mesh, material, false, placed);
  return scene;
}

int add_texel(Scene& scene, const std::array<std::uint8_t, 4>& rgba) {
  TextureImage image;
  image.width_px = image.height_px = 1;
  image.srgb = false;
  image.rgba.assign(rgba.begin(), rgba.end());
  scene.textures.push_back(image);
  return static_cast<int>(scene.textures.size()) - 1;
}

void expect_near(const glm::vec3& found, const glm::vec3& expected, float tolerance) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], tolerance) << axis;
}

TEST(SurfaceLanesTest, ASurfaceWithoutLobesHasOnesOfNoStrength) {
  const Seen seen = look_down(square(test::matte(glm::vec3{0.5f})), 0.25f, 0.1f);
  EXPECT_EQ(seen.coat, 0.0f);
  EXPECT_EQ(seen.stretch, 0.0f);
  EXPECT_EQ(seen.occlusion, 1.0f);
  EXPECT_EQ(seen.curvature, 0.0f);
  EXPECT_EQ(seen.sheen, glm::vec3(0));
  EXPECT_EQ(seen.absorption, glm::vec3(0));
  EXPECT_EQ(seen.coat_normal, glm::vec3(0, 0, 1));
  EXPECT_NEAR(glm::length(seen.tangent), 1.0, 1e-6);
  EXPECT_NEAR(seen.tangent.z, 0.0, 1e-6);
}

TEST(SurfaceLanesTest, TheOcclusionTextureCountsByItsStrength) {
  Material paint = test::matte(glm::vec3{0.5f});
  paint.occlusion_strength = 0.5f;
  Scene scene = square(paint);
  scene.materials[0].occlusion_texture.texture = add_texel(scene, {51, 255, 255, 255});
  // 1 + strength (texel - 1) = 1 + 0.5 (0.2 - 1).
  EXPECT_NEAR(look_down(scene, 0.25f, 0.1f).occlusion, 0.6, 1e-6);
}

TEST(SurfaceLanesTest, ACoatHasItsOwnTexturesAndIgnoresTheNormalTextureBelow) {
  Material paint = test::matte(glm::vec3{0.5f});
  paint.clearcoat.strength = 0.5f;
  paint.clearcoat.roughness = 0.5f;
  Scene scene = square(paint);
  // x = 2 * 204 / 255 - 1 = 0.6, y = 2 * 127.5 / 255 - 1, but for a half step; z = 2 * 230 / 255 - 1 = 0.8.
  const int slope = add_texel(scene, {204, 128, 230, 255});
  Material& m = scene.materials[0];
  m.normal_texture.texture = slope;
  m.clearcoat.strength_texture.texture = m.clearcoat.roughness_texture.texture =
      add_texel(scene, {51, 102, 0, 255});
  Seen seen = look_down(scene, 0.25f, 0.1f);
  EXPECT_NEAR(seen.coat, 0.5 * 0.2, 1e-6);
  EXPECT_NEAR(seen.coat_alpha2, std::pow(0.5 * 0.4, 4), 1e-8);
  expect_near(seen.normal, {0.6f, 0, 0.8f}, 0.005f);
  EXPECT_EQ(seen.coat_normal, glm::vec3(0, 0, 1));

  m.normal_texture.texture = -1;
  m.clearcoat.normal_texture.texture = slope;
  seen = look_down(scene, 0.25f, 0.1f);
  EXPECT_EQ(seen.normal, glm::vec3(0, 0, 1));
  expect_near(seen.coat_normal, {0.6f, 0, 0.8f}, 0.005f);
}

TEST(SurfaceLanesTest, SheenHasItsColourAndTheSquareOfItsRoughness) {
  Material cloth = test::matte(glm::vec3{0.5f});
  cloth.sheen.colour = {0.5f, 0.25f, 1};
  cloth.sheen.roughness = 0.5f;
  Scene scene = square(cloth);
  scene.materials[0].sheen.colour_texture.texture = scene.materials[0].sheen.roughness_texture.texture =
      add_texel(scene, {51, 102, 153, 204});
  const Seen seen = look_down(scene, 0.25f, 0.1f);
  expect_near(seen.sheen, {0.5f * 0.2f, 0.25f * 0.4f, 0.6f}, 1e-6f);
  EXPECT_NEAR(seen.sheen_alpha, 0.4 * 0.4, 1e-6);
}

TEST(SurfaceLanesTest, AStretchedHighlightTurnsWithItsAngleItsTextureAndTheMatrix) {
  Material steel = test::matte(glm::vec3{0.5f});
  steel.anisotropy.strength = 0.5f;
  steel.anisotropy.rotation_rad = 0.5f;
  // Counter-clockwise from the tangent (x), seen from the side that the normal (z) points to; either way
  // along it is the same highlight.
  const auto along = [](const Scene& scene) {
    const Seen seen = look_down(scene, 0.25f, 0.1f);
    return std::pair(seen.tangent.x < 0 ? -seen.tangent : seen.tangent, seen.stretch);
  };
  expect_near(along(square(steel)).first, {std::cos(0.5f), std::sin(0.5f), 0}, 1e-5f);
  EXPECT_NEAR(along(square(steel)).second, 0.5, 1e-6);

  // The texture's direction (1, 0.6), turned by the angle; B is its strength. Bytes 255 and 204.
  Scene textured = square(steel);
  textured.materials[0].anisotropy.texture.texture = add_texel(textured, {255, 204, 51, 255});
  const float angle = std::atan2(0.6f, 1.0f) + 0.5f;
  expect_near(along(textured).first, {std::cos(angle), std::sin(angle), 0}, 1e-5f);
  EXPECT_NEAR(along(textured).second, 0.5 * 0.2, 1e-6);

  // What lies along (cos, sin) in the mesh lies along (3 cos, sin) where x is three times as long.
  const Scene longer = square(steel, glm::scale(glm::dmat4(1.0), glm::dvec3(3, 1, 1)));
  expect_near(along(longer).first, glm::normalize(glm::vec3{3 * std::cos(0.5f), std::sin(0.5f), 0}), 1e-5f);

  // Without tangents there is no direction.
  Scene bare = square(steel);
  bare.meshes[0].tangents.clear();
  EXPECT_EQ(along(bare).second, 0.0f);
}

TEST(SurfaceLanesTest, ABodyAbsorbsByTheLogarithmOfItsColourPerMetre) {
  Material glass = test::matte(glm::vec3{1.0f});
  glass.transmission = 1;
  glass.attenuation = {{0.5f, 0, 1}, 0.25f};
  const Seen seen = look_down(square(glass), 0.25f, 0.1f);
  // exp(-absorption 0.25 m) = colour; a colour of 0 is taken as 1e-6.
  EXPECT_NEAR(std::exp(-0.25 * seen.absorption.x), 0.5, 1e-6);
  EXPECT_NEAR(std::exp(-0.25 * seen.absorption.y), 0.0, 2e-6);
  EXPECT_EQ(seen.absorption.z, 0.0f);
  EXPECT_EQ(seen.transmission, 1.0f);
}

TEST(SurfaceLanesTest, IndexZeroReflectsItsSpecularColourAndScattersTheRest) {
  Material m = test::matte({0.5f, 0.5f, 1});
  m.refractive_index = 0;
  m.specular_colour = {0.25f, 0.5f, 0.125f};
  m.transmission = 1;
  const Seen seen = look_down(square(m), 0.25f, 0.1f);
  EXPECT_EQ(seen.f0, glm::vec3(0.25f, 0.5f, 0.125f));
  EXPECT_EQ(seen.f90, 1.0f);
  // Specular-glossiness: diffuse (1 - max F0).
  EXPECT_EQ(seen.diffuse, glm::vec3(0.25f, 0.25f, 0.5f));
  EXPECT_EQ(seen.transmission, 0.0f);
  EXPECT_TRUE(std::isfinite(seen.index_ratio));

  m.specular_colour = glm::vec3(1.0f);
  const Seen mirror = look_down(square(m), 0.25f, 0.1f);
  EXPECT_EQ(mirror.f0, glm::vec3(1));
  EXPECT_EQ(mirror.diffuse, glm::vec3(0));
}

TEST(SurfaceLanesTest, AnUnlitSurfaceHasNoReflectance) {
  Material paint = test::matte({0.5f, 0.25f, 1});
  paint.unlit = true;
  const Seen seen = look_down(square(paint), 0.25f, 0.1f);
  EXPECT_EQ(seen.emission, glm::vec3(0.5f, 0.25f, 1));
  EXPECT_EQ(seen.diffuse, glm::vec3(0));
  EXPECT_EQ(seen.f0, glm::vec3(0));
  EXPECT_EQ(seen.f90, 0.0f);
}

TEST(SurfaceLanesTest, CurvatureIsThatOfTheSurfaceInTheWorld) {
  // A ball of radius 2, as an analytic shape and as a mesh of radius 1 twice as large: 1 / 2 per metre, on
  // the mesh within a hundredth (its normals are those of a ball, its places lie on chords of 7.5 degrees).
  Scene scene;
  test::add(scene, test::sphere({0, 0, 0}, 1), test::matte(glm::vec3{0.5f}), false,
            glm::translate(glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)), glm::dvec3(0, 0, -2)));
  EXPECT_NEAR(look_down(scene, 0.3f, 0.4f).curvature, 0.5, 0.005);
  scene.instances[0].kind = ShapeKind::sphere;
  EXPECT_FLOAT_EQ(look_down(scene, 0.3f, 0.4f).curvature, 0.5f);
  scene.instances[0].kind = ShapeKind::box;
  EXPECT_EQ(look_down(scene, 0.3f, 0.4f).curvature, 0.0f);
}

}  // namespace
}  // namespace herr
