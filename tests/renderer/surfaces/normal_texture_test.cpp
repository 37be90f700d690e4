// Normal textures: a wall of one texel lit by a sun alone, so that each pixel is albedo / pi * E * cos(sun,
// normal), with normals worked out in double.
#include <gtest/gtest.h>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kAlbedo = 0.5, kIrradiance = 10.0;
const glm::dvec3 kTowardsSuns[] = {{0, 0, 1},     {0.6, 0, 0.8},  {-0.6, 0, 0.8},
                                   {0, 0.6, 0.8}, {0, -0.6, 0.8}, {0.48, -0.36, 0.8}};

using Texel = std::array<std::uint8_t, 3>;

glm::dvec3 decoded(const Texel& texel, double scale) {
  const glm::dvec3 c = glm::dvec3(texel[0], texel[1], texel[2]) / 127.5 - 1.0;
  return {scale * c.x, scale * c.y, c.z};
}

// The square of +-1 at z = -1 that faces the eye, u to the right and v downwards, as a picture hangs; with
// `handedness` -1 its picture is mirrored.
Scene wall(const Texel& texel, float handedness = 1, const glm::dmat4& place = glm::dmat4(1.0)) {
  Scene scene;
  TriangleMesh mesh = test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
  for (glm::vec2& uv : mesh.uvs) uv.y = 1 - uv.y;
  mesh.tangents.assign(4, glm::vec4(1, 0, 0, handedness));
  Material paint = test::matte(glm::vec3{static_cast<float>(kAlbedo)});
  paint.specular = 0;
  paint.normal_texture = {0, 0};
  TextureImage image;
  image.width_px = image.height_px = 1;
  image.srgb = false;
  image.rgba = {texel[0], texel[1], texel[2], 255};
  scene.textures.push_back(std::move(image));
  test::add(scene, std::move(mesh), paint, false, glm::dmat4x3(place));
  return scene;
}

double radiance(Scene scene, const glm::dvec3& towards_sun, Isa isa) {
  AreaLight sun;
  sun.kind = LightKind::sun;
  sun.direction = -towards_sun;
  sun.intensity_w_sr = glm::vec3{static_cast<float>(kIrradiance)};
  scene.lights = {sun};
  RenderSettings settings = test::planar_settings();
  settings.isa = isa;
  const RenderedFrame frame =
      test::render(scene, test::single_view(9, 9, 20, 20), settings, test::sample_from({0, 0, 0}));
  test::expect_finite(frame);
  return test::pixel_at(frame.viewports[0], 4, 4)[0];
}

// For suns from all sides, of which some are behind the bent normal; light must be before the triangle too.
void expect_normal(const Scene& scene, const glm::dvec3& normal, const glm::dvec3& triangle = {0, 0, 1}) {
  const glm::dvec3 unit = glm::normalize(normal);
  for (const Isa isa : test::offered_isas()) {
    for (const glm::dvec3& sun : kTowardsSuns) {
      const double cosine = glm::dot(triangle, sun) > 0 ? std::max(0.0, glm::dot(unit, sun)) : 0.0;
      const double expected = kAlbedo / glm::pi<double>() * kIrradiance * cosine;
      // Octahedral codes are off by 6.6e-5 rad at most: as much for the normal and for the tangent.
      EXPECT_NEAR(radiance(scene, sun, isa), expected, 3e-4 + 2 * test::half_rounding(expected))
          << name_of(isa) << ", sun at " << sun.x << ", " << sun.y;
    }
  }
}

TEST(NormalTextureTest, RedBendsAlongTheTangentAndGreenAlongTheBitangent) {
  expect_normal(wall({230, 128, 220}), decoded({230, 128, 220}, 1));
  expect_normal(wall({100, 240, 200}), decoded({100, 240, 200}, 1));
  const glm::dvec3 mirrored = decoded({100, 240, 200}, 1) * glm::dvec3(1, -1, 1);
  expect_normal(wall({100, 240, 200}, -1), mirrored);
}

TEST(NormalTextureTest, ScaleMultipliesRedAndGreenAlone) {
  for (const float scale : {0.0f, 0.25f, 3.0f, -1.0f, 1e6f}) {
    Scene scene = wall({160, 90, 255});
    scene.materials[0].normal_scale = scale;
    expect_normal(scene, decoded({160, 90, 255}, scale));
  }
}

TEST(NormalTextureTest, ATangentThatLeansIntoTheNormalIsMadePerpendicular) {
  Scene scene = wall({230, 128, 220});
  scene.meshes[0].tangents.assign(4, glm::vec4(0.8f, 0, 0.6f, 1));
  expect_normal(scene, decoded({230, 128, 220}, 1));
}

TEST(NormalTextureTest, MatricesTreatItAsTheyTreatTheMesh) {
  const glm::dvec3 bent = decoded({100, 240, 200}, 1);
  for (const glm::dvec3& scale : {glm::dvec3(-1, 1, 1), glm::dvec3(3, 1, 1), glm::dvec3(1, -2, 1)}) {
    const glm::dmat4 place = glm::scale(glm::dmat4(1.0), scale);
    expect_normal(wall({100, 240, 200}, 1, place), bent / scale);
  }
  const glm::dmat4 large = glm::scale(glm::dmat4(1.0), glm::dvec3(1e5));
  expect_normal(wall({100, 240, 200}, 1, large), bent);
  const glm::dmat4 small = glm::scale(glm::dmat4(1.0), glm::dvec3(1e-3));
  expect_normal(wall({100, 240, 200}, 1, small), bent);
}

TEST(NormalTextureTest, SeenFromBehindTheWholeNormalIsReversed) {
  // Turned about y: the eye sees the back, and what bent to the right in front bends to
  // the left seen from there.
  const glm::dmat4 turn = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -2)) *
                          glm::rotate(glm::dmat4(1.0), glm::pi<double>(), glm::dvec3(0, 1, 0));
  const glm::dvec3 bent = decoded({100, 240, 200}, 1);
  expect_normal(wall({100, 240, 200}, 1, turn), -(glm::dmat3(turn) * bent));
}

TEST(NormalTextureTest, OneThatPointsIntoTheSurfaceIsTakenForOneThatFacesTheViewer) {
  expect_normal(wall({128, 128, 0}), decoded({128, 128, 255}, 1));
  expect_normal(wall({128, 128, 128}), decoded({128, 128, 128}, 1));
  Scene flat = wall({255, 128, 0});
  flat.materials[0].normal_scale = 0;
  expect_normal(flat, {0, 0, 1});
}

TEST(NormalTextureTest, ASlopeThatFacesAwayIsTakenForOneThatFacesTheViewerAsMuch) {
  // The wall is seen at 70 degrees, and the texture leans 45 degrees farther.
  const glm::dmat4 turn = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -1)) *
                          glm::rotate(glm::dmat4(1.0), 70 / kDegreesPerRadian, glm::dvec3(0, 1, 0)) *
                          glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 1));
  const glm::dvec3 viewer(0, 0, 1), bent = glm::normalize(glm::dmat3(turn) * decoded({255, 128, 255}, 1));
  ASSERT_LT(glm::dot(bent, viewer), -0.3);
  const glm::dvec3 triangle = glm::dmat3(turn) * glm::dvec3(0, 0, 1);
  expect_normal(wall({255, 128, 255}, 1, turn), bent - 2.0 * glm::dot(bent, viewer) * viewer, triangle);
  // The other way it faces the viewer anyway; beyond the triangle's own horizon it is left out.
  const glm::dvec3 facing = glm::dmat3(turn) * decoded({0, 128, 255}, 1);
  expect_normal(wall({0, 128, 255}, 1, turn), facing, triangle);
  expect_normal(wall({0, 128, 100}, 1, turn), triangle, triangle);
}

TEST(NormalTextureTest, ATangentAlongTheNormalSaysNoDirection) {
  Scene scene = wall({230, 128, 220});
  scene.meshes[0].tangents.assign(4, glm::vec4(0, 0, 1, 1));
  expect_normal(scene, {0, 0, 1});
  scene.meshes[0].tangents.assign(4, glm::vec4(0, 0, -1, -1));
  expect_normal(scene, {0, 0, 1});
}

TEST(NormalTextureTest, AMeshWithoutTangentsIsNotBent) {
  Scene scene = wall({230, 128, 220});
  scene.meshes[0].tangents.clear();
  expect_normal(scene, {0, 0, 1});
}

}  // namespace
}  // namespace herr
