// What makes up a surface beyond its triangles: vertex colours, several coordinates, their transforms, alpha,
// sides, highlights; and one mesh shown many times.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scenes/gltf/vertex_tangents.h"
#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

void write_grey_picture(const std::filesystem::path& file, std::uint8_t value) {
  const auto writer = OIIO::ImageOutput::create(file.string());
  const OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::UINT8);
  const std::uint8_t pixel[3] = {value, value, value};
  if (!writer || !writer->open(file.string(), spec) || !writer->write_image(OIIO::TypeDesc::UINT8, pixel) ||
      !writer->close()) {
    throw std::runtime_error("cannot write " + file.string());
  }
}

// Adds an attribute of `components` floats per vertex to the triangle, in a buffer of its own.
void add_attribute(const TemporaryFolder& folder, json& document, const std::string& name,
                   const std::vector<float>& values) {
  static const char* const kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  folder.write(name + ".bin", bytes_of(values));
  const std::size_t bytes = 4 * values.size();
  document["buffers"].push_back({{"byteLength", bytes}, {"uri", name + ".bin"}});
  document["bufferViews"].push_back({{"buffer", document["buffers"].size() - 1}, {"byteLength", bytes}});
  document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                   {"componentType", 5126},
                                   {"count", 3},
                                   {"type", kTypes[values.size() / 3]}});
  document["meshes"][0]["primitives"][0]["attributes"][name] = document["accessors"].size() - 1;
}

// The triangle with a material of one texture, grey 128.
json with_texture(const TemporaryFolder& folder, json document) {
  write_grey_picture(folder.path() / "grey.png", 128);
  document["images"] = json::array({{{"uri", "grey.png"}}});
  document["textures"] = json::array({{{"source", 0}}});
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["materials"] = json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  return document;
}

TEST(GltfSurfaces, VertexColoursAreReadWithAlphaOneWhereTheyHaveNone) {
  const TemporaryFolder folder;
  json document = triangle_document();
  add_attribute(folder, document, "COLOR_0", {0, 0.5f, 1, 1, 2, 3, -1, 0.25f, 0});
  const auto rgb = load_scene(write_model(folder, document)).meshes.at(0).colours;
  ASSERT_EQ(rgb.size(), 3u);
  EXPECT_EQ(rgb[0], glm::vec4(0, 0.5f, 1, 1));
  EXPECT_EQ(rgb[1], glm::vec4(1)) << "brought into [0, 1]";
  EXPECT_EQ(rgb[2], glm::vec4(0, 0.25f, 0, 1));

  document = triangle_document();
  add_attribute(folder, document, "COLOR_0", {1, 1, 1, 0.5f, 1, 1, 1, 1, 1, 1, 1, 1});
  EXPECT_EQ(load_scene(write_model(folder, document)).meshes.at(0).colours.at(0).w, 0.5f);

  document = triangle_document();
  add_attribute(folder, document, "COLOR_0", std::vector<float>(12, 1.0f));
  EXPECT_TRUE(load_scene(write_model(folder, document)).meshes.at(0).colours.empty()) << "white: nothing";
}

TEST(GltfSurfaces, ATextureTransformThatAllTexturesShareIsBakedIntoTheCoordinates) {
  const TemporaryFolder folder;
  json document = with_texture(folder, triangle_document());
  add_attribute(folder, document, "TEXCOORD_0", {1, 0, 0, 1, 0, 0});
  // A quarter turn counter-clockwise as v points down takes (u, v) to (v, -u); scale
  // comes first, offset last.
  const json moved = {{"offset", {0.5, 0.25}}, {"rotation", 1.5707963267948966}, {"scale", {2, 3}}};
  json& material = document["materials"][0];
  const json use = {{"index", 0}, {"extensions", {{"KHR_texture_transform", moved}}}};
  material["pbrMetallicRoughness"]["baseColorTexture"] = use;
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = use;
  document["extensionsRequired"] = {"KHR_texture_transform"};
  const Scene scene = load_scene(write_model(folder, document));
  const TriangleMesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.uvs.size(), 3u);
  EXPECT_TRUE(mesh.more_uvs.empty());
  const glm::vec2 expected[] = {{0.5f, -1.75f}, {3.5f, 0.25f}, {0.5f, 0.25f}};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::distance(mesh.uvs[i], expected[i]), 1e-6f) << i;
}

TEST(GltfSurfaces, TexturesThatDifferInCoordinatesGetASetEach) {
  const TemporaryFolder folder;
  json document = with_texture(folder, triangle_document());
  add_attribute(folder, document, "TEXCOORD_0", {1, 0, 0, 1, 0, 0});
  add_attribute(folder, document, "TEXCOORD_1", {0.5f, 0.5f, 0, 0.5f, 0.5f, 0});
  json& material = document["materials"][0];
  material["emissiveFactor"] = {1, 1, 1};
  material["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
  // The extension's set replaces the reference's own.
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 1}, {"scale", {2, 2}}}}}}};
  const Scene scene = load_scene(write_model(folder, document));
  const TriangleMesh& mesh = scene.meshes.at(0);
  const Material& made = scene.materials.at(0);
  ASSERT_EQ(mesh.more_uvs.size(), 2u);
  EXPECT_EQ(made.base_colour_uv_set, 0);
  EXPECT_EQ(made.metallic_roughness_uv_set, 1);
  EXPECT_EQ(made.emission_texture.uv_set, 2);
  EXPECT_EQ(mesh.uvs[0], glm::vec2(1, 0));
  EXPECT_EQ(mesh.more_uvs[0][0], glm::vec2(1, 1));
  EXPECT_EQ(mesh.more_uvs[1][0], glm::vec2(0.5f, 0.5f));

  document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_1");
  const Scene without = load_scene(write_model(folder, document));
  EXPECT_EQ(without.materials.at(0).emission_texture.texture, -1);
  EXPECT_GE(without.materials.at(0).base_colour_texture, 0);
  EXPECT_TRUE(any_contains(without.warnings, "no texture coordinates"));
}

TEST(GltfSurfaces, AlphaSidesAndHighlightsAreReadAndCheckedForTheirRange) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["materials"] = json::array(
      {{{"alphaMode", "MASK"},
        {"alphaCutoff", 0.25},
        {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.75}}}},
        {"extensions",
         {{"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 2, 0}}}}}}}});
  const Material mask = load_scene(write_model(folder, document)).materials.at(0);
  EXPECT_EQ(mask.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(mask.alpha_cutoff, 0.25f);
  EXPECT_EQ(mask.alpha, 0.75f);
  EXPECT_FALSE(mask.double_sided);
  EXPECT_EQ(mask.specular, 0.5f);
  EXPECT_EQ(mask.specular_colour, glm::vec3(1, 2, 0));

  document["materials"][0]["alphaMode"] = "BLEND";
  document["materials"][0]["doubleSided"] = true;
  const Material blend = load_scene(write_model(folder, document)).materials.at(0);
  EXPECT_EQ(blend.alpha_mode, AlphaMode::blend);
  EXPECT_TRUE(blend.double_sided);

  document["materials"][0]["alphaMode"] = "GLASS";
  EXPECT_TRUE(contains(error_of(write_model(folder, document)), "materials[0].alphaMode"));
  document["materials"][0]["alphaMode"] = "BLEND";
  document["materials"][0]["extensions"]["KHR_materials_specular"]["specularFactor"] = 1.5;
  EXPECT_TRUE(contains(error_of(write_model(folder, document)), "specularFactor"));
}

TEST(GltfSurfaces, AnUnlitSurfaceWithATextureKeepsItsColourAndIsMarked) {
  const TemporaryFolder folder;
  json document = with_texture(folder, triangle_document());
  add_attribute(folder, document, "TEXCOORD_0", {1, 0, 0, 1, 0, 0});
  document["materials"][0]["extensions"] = {{"KHR_materials_unlit", json::object()}};
  const Material material = load_scene(write_model(folder, document)).materials.at(0);
  EXPECT_TRUE(material.unlit);
  EXPECT_EQ(material.base_colour, glm::vec3(1));
  EXPECT_EQ(material.base_colour_texture, 0);
}

TEST(GltfSurfaces, TheMagnificationFilterNearestIsKept) {
  const TemporaryFolder folder;
  json document = with_texture(folder, triangle_document());
  add_attribute(folder, document, "TEXCOORD_0", {1, 0, 0, 1, 0, 0});
  EXPECT_FALSE(load_scene(write_model(folder, document)).textures.at(0).nearest);
  document["samplers"] = json::array({{{"magFilter", 9728}}});
  document["textures"][0]["sampler"] = 0;
  EXPECT_TRUE(load_scene(write_model(folder, document)).textures.at(0).nearest);
}

TEST(GltfSurfaces, OneNodeShowsItsMeshOnceForEachInstanceOfTheExtension) {
  const TemporaryFolder folder;
  json document = triangle_document();
  const float h = std::sqrt(0.5f);
  add_attribute(folder, document, "T", {1, 2, 3, 4, 5, 6, 0, 0, 0});
  add_attribute(folder, document, "R", {0, 0, 0, 1, 0, 0, h, h, 0, 0, 0, 1});
  add_attribute(folder, document, "S", {1, 1, 1, 2, 3, 4, -1, 1, 1});
  auto& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  const json instancing = {
      {"attributes",
       {{"TRANSLATION", attributes["T"]}, {"ROTATION", attributes["R"]}, {"SCALE", attributes["S"]}}}};
  for (const char* name : {"T", "R", "S"}) attributes.erase(name);
  document["nodes"][0]["translation"] = {10, 0, 0};
  document["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", instancing}};
  document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Scene scene = load_scene(write_model(folder, document));
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.meshes.size(), 1u);
  // A quarter turn about z after the scale (2, 3, 4): x goes to +y by 2, y to -x by 3.
  const glm::dmat4x3& m = scene.instances[1].world_from_object;
  EXPECT_LT(glm::distance(m[0], glm::dvec3(0, 2, 0)), 1e-6);
  EXPECT_LT(glm::distance(m[1], glm::dvec3(-3, 0, 0)), 1e-6);
  EXPECT_LT(glm::distance(m[2], glm::dvec3(0, 0, 4)), 1e-6);
  EXPECT_EQ(m[3], glm::dvec3(14, 5, 6));
  EXPECT_EQ(scene.instances[2].world_from_object[0], glm::dvec3(-1, 0, 0));

  document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = 77;
  EXPECT_TRUE(contains(error_of(write_model(folder, document)), "SCALE"));
}

// The triangle (0,0,0) (1,0,0) (0,1,0), which looks along z, with a normal texture.
json with_normal_texture(const TemporaryFolder& folder, const std::vector<float>& uvs) {
  json document = with_texture(folder, triangle_document());
  add_attribute(folder, document, "TEXCOORD_0", uvs);
  document["materials"][0]["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  return document;
}

const std::vector<float> kUpright{0, 1, 1, 1, 0, 0};  // a picture as it hangs: v points down

TEST(GltfSurfaces, TangentsAreReadWhereANormalTextureNeedsThem) {
  const TemporaryFolder folder;
  json document = with_normal_texture(folder, kUpright);
  add_attribute(folder, document, "NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  add_attribute(folder, document, "TANGENT", {0, 2, 0, 1, 0, 1, 0, -1, 0.6f, 0.8f, 0, -3});
  const Scene scene = load_scene(write_model(folder, document));
  EXPECT_EQ(scene.materials.at(0).normal_scale, 0.5f);
  const auto& tangents = scene.meshes.at(0).tangents;
  ASSERT_EQ(tangents.size(), 3u);
  EXPECT_EQ(tangents[0], glm::vec4(0, 1, 0, 1)) << "made unit";
  EXPECT_EQ(tangents[1], glm::vec4(0, 1, 0, -1));
  EXPECT_EQ(tangents[2], glm::vec4(0.6f, 0.8f, 0, -1));

  json plain = document;
  plain["materials"][0].erase("normalTexture");
  EXPECT_TRUE(load_scene(write_model(folder, plain)).meshes.at(0).tangents.empty()) << "nothing reads them";

  json wrong = document;
  wrong["accessors"].back()["count"] = 2;
  EXPECT_THROW(load_scene(write_model(folder, wrong)), InputError);
}

TEST(GltfSurfaces, MissingTangentsPointWhereUGrows) {
  const TemporaryFolder folder;
  struct {
    std::vector<float> uvs;
    glm::vec4 tangent;
  } const cases[] = {{kUpright, {1, 0, 0, 1}},
                     {{0, 0, 1, 0, 0, 1}, {1, 0, 0, -1}},   // upside down: mirrored
                     {{1, 1, 0, 1, 1, 0}, {-1, 0, 0, -1}},  // left to right: mirrored
                     {{0, 0, 0, 1, 1, 0}, {0, 1, 0, 1}}};   // turned by a quarter
  for (const auto& one : cases) {
    json document = with_normal_texture(folder, one.uvs);
    // Without NORMAL those of a file are not for its flat normals.
    add_attribute(folder, document, "TANGENT", {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1});
    const auto flat = load_scene(write_model(folder, document)).meshes.at(0).tangents;
    document["meshes"][0]["primitives"][0]["attributes"].erase("TANGENT");
    add_attribute(folder, document, "NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    const auto smooth = load_scene(write_model(folder, document)).meshes.at(0).tangents;
    for (const auto& tangents : {flat, smooth}) {
      ASSERT_EQ(tangents.size(), 3u);
      for (const glm::vec4& tangent : tangents) EXPECT_LT(glm::distance(tangent, one.tangent), 1e-6f);
    }
  }
  const auto nowhere =
      load_scene(write_model(folder, with_normal_texture(folder, {0, 0, 0, 0, 0, 0}))).meshes.at(0);
  for (const glm::vec4& tangent : nowhere.tangents) {
    EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-6f) << "coordinates that say nothing";
    EXPECT_NEAR(tangent.z, 0.0f, 1e-6f);
  }
}

TEST(GltfSurfaces, TangentsThatSayNoDirectionAreAllMadeAnew) {
  const TemporaryFolder folder;
  for (const std::vector<float>& one : {std::vector<float>{0, 0, 0, 1}, std::vector<float>{0, 0, -5, 1}}) {
    json document = with_normal_texture(folder, kUpright);
    add_attribute(folder, document, "NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    std::vector<float> tangents{0, 1, 0, 1, 0, 1, 0, 1};
    tangents.insert(tangents.end(), one.begin(), one.end());
    add_attribute(folder, document, "TANGENT", tangents);
    const Scene scene = load_scene(write_model(folder, document));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(contains(scene.warnings[0], "1 tangent of length zero or along their normals"));
    for (const glm::vec4& tangent : scene.meshes.at(0).tangents)
      EXPECT_LT(glm::distance(tangent, glm::vec4(1, 0, 0, 1)), 1e-6f);
  }
}

TEST(GltfSurfaces, MorphTargetsWithoutTangentsTurnThemWithTheirShape) {
  // A target that turns the triangle by a quarter about y: x becomes -z, z becomes x.
  for (const bool flat : {false, true}) {
    const TemporaryFolder folder;
    json document = with_normal_texture(folder, kUpright);
    json& primitive = document["meshes"][0]["primitives"][0];
    add_attribute(folder, document, "SHIFT", {0, 0, 0, -1, 0, -1, 0, 0, 0});
    add_attribute(folder, document, "TURN", {1, 0, -1, 1, 0, -1, 1, 0, -1});
    json target = {{"POSITION", primitive["attributes"]["SHIFT"]}};
    if (!flat) {
      target["NORMAL"] = primitive["attributes"]["TURN"];
      add_attribute(folder, document, "NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    }
    primitive["attributes"].erase("SHIFT");
    primitive["attributes"].erase("TURN");
    primitive["targets"] = json::array({target});
    document["meshes"][0]["weights"] = {1};
    const TriangleMesh turned = load_scene(write_model(folder, document)).meshes.at(0);
    ASSERT_EQ(turned.tangents.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(glm::distance(turned.normals[i], glm::vec3(1, 0, 0)), 1e-6f) << (flat ? "flat" : "smooth");
      EXPECT_LT(glm::distance(turned.tangents[i], glm::vec4(0, 0, -1, 1)), 1e-6f)
          << (flat ? "flat" : "smooth");
    }
  }
}

TEST(GltfSurfaces, VerticesThatDifferInColourAloneShareTheirTangent) {
  // Two triangles of a smooth fold that share no vertex, and one whose coordinates say nothing.
  BuiltMesh built;
  TriangleMesh& mesh = built.mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, -1}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 0, -1}, {0, 2, 0}};
  mesh.normals.assign(7, {0, 0, 1});
  mesh.uvs = {{0, 1}, {1, 1}, {0, 0}, {0, 1}, {0, 0}, {-2, 1.5f}, {0, -1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {3, 4, 6}};
  make_tangents(built, 0);
  ASSERT_EQ(mesh.tangents.size(), 7u) << "no twins";
  EXPECT_EQ(mesh.tangents[0], mesh.tangents[3]);
  EXPECT_EQ(mesh.tangents[2], mesh.tangents[4]);
  EXPECT_GT(glm::distance(mesh.tangents[1], mesh.tangents[5]), 0.01f) << "the triangles do differ";
  for (const glm::vec4& tangent : mesh.tangents) EXPECT_EQ(tangent.w, 1.0f);
}

TEST(GltfSurfaces, AVertexWhereMirroredCoordinatesMeetOthersBecomesTwo) {
  // A square of two triangles whose picture is mirrored at the diagonal that they share.
  BuiltMesh built;
  TriangleMesh& mesh = built.mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {1, 1}};
  mesh.colours.assign(4, glm::vec4(0.5f));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  built.sources = {7, 8, 9, 10};
  make_tangents(built, 0);
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(built.sources, (std::vector<std::uint32_t>{7, 8, 9, 10, 7, 9}));
  ASSERT_EQ(mesh.tangents.size(), 6u);
  ASSERT_EQ(mesh.uvs.size(), 6u);
  ASSERT_EQ(mesh.colours.size(), 6u);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{4, 5, 3}));
  for (const std::uint32_t i : mesh.triangles[0]) EXPECT_EQ(mesh.tangents[i], glm::vec4(1, 0, 0, 1)) << i;
  for (const std::uint32_t i : mesh.triangles[1]) EXPECT_EQ(mesh.tangents[i], glm::vec4(0, 1, 0, -1)) << i;
}

}  // namespace
}  // namespace herr::test
