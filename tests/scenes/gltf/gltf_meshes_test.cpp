// What a glTF primitive becomes: triangles of every mode, normals, coordinates, sparse
// and quantised accessors.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// A document with one buffer "data.bin" made of `parts`, each one view and accessor.
struct Part {
  std::string bytes;
  int component_type;
  int count;
  const char* type;
  bool normalised = false;
};

json document_of(const TemporaryFolder& folder, const std::vector<Part>& parts, const json& primitive) {
  json document = {{"asset", {{"version", "2.0"}}},
                   {"scenes", json::array({{{"nodes", {0}}}})},
                   {"nodes", json::array({{{"mesh", 0}}})},
                   {"meshes", json::array({{{"name", "m"}, {"primitives", json::array({primitive})}}})}};
  std::string all;
  for (const Part& part : parts) {
    all.resize((all.size() + 3) / 4 * 4);
    const auto view = document["bufferViews"].size();
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", all.size()}, {"byteLength", part.bytes.size()}});
    document["accessors"].push_back({{"bufferView", view},
                                     {"componentType", part.component_type},
                                     {"count", part.count},
                                     {"type", part.type},
                                     {"normalized", part.normalised}});
    all += part.bytes;
  }
  document["buffers"] = json::array({{{"byteLength", all.size()}, {"uri", "data.bin"}}});
  folder.write("data.bin", all);
  return document;
}

Scene load(const TemporaryFolder& folder, const json& document) {
  return load_scene(folder.write("model.gltf", document.dump()));
}

const std::vector<float> kFiveVertices{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
const std::vector<float> kFiveNormals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};

Scene five_vertices(int mode) {
  const TemporaryFolder folder;
  return load(folder, document_of(folder,
                                  {{bytes_of(kFiveVertices), 5126, 5, "VEC3"},
                                   {bytes_of(kFiveNormals), 5126, 5, "VEC3"}},
                                  {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"mode", mode}}));
}

TEST(GltfMeshes, AListDropsTheVerticesThatDoNotMakeATriangle) {
  const Scene scene = five_vertices(4);
  EXPECT_EQ(scene.meshes.at(0).triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(scene.meshes.at(0).positions.size(), 3u);
}

// glTF 2.0, 3.7.2.1: strip p_i = {v_i, v_(i + 1 + i % 2), v_(i + 2 - i % 2)}, fan p_i =
// {v_(i + 1), v_(i + 2), v_0}.
TEST(GltfMeshes, AStripTurnsEverySecondTriangle) {
  EXPECT_EQ(five_vertices(5).meshes.at(0).triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
}

TEST(GltfMeshes, AFanKeepsItsFirstVertex) {
  EXPECT_EQ(five_vertices(6).meshes.at(0).triangles, (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(GltfMeshes, PointsAndLinesAreLeftOutWithAWarning) {
  for (int mode = 0; mode < 4; ++mode) {
    const Scene scene = five_vertices(mode);
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(any_contains(scene.warnings, "points and lines")) << mode;
  }
}

TEST(GltfMeshes, AStripOfTwoVerticesIsLeftOutWithAWarning) {
  const TemporaryFolder folder;
  const Scene scene =
      load(folder, document_of(folder, {{bytes_of<float>({0, 0, 0, 1, 0, 0}), 5126, 2, "VEC3"}},
                               {{"attributes", {{"POSITION", 0}}}, {"mode", 5}}));
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_TRUE(any_contains(scene.warnings, "fewer than three"));
}

TEST(GltfMeshes, IndicesOfEveryWidthNameTheSameVertices) {
  const std::vector<std::pair<std::string, int>> widths{{bytes_of<std::uint8_t>({3, 1, 2}), 5121},
                                                        {bytes_of<std::uint16_t>({3, 1, 2}), 5123},
                                                        {bytes_of<std::uint32_t>({3, 1, 2}), 5125}};
  for (const auto& [bytes, type] : widths) {
    const TemporaryFolder folder;
    const Scene scene =
        load(folder, document_of(folder,
                                 {{bytes_of(kFiveVertices), 5126, 5, "VEC3"},
                                  {bytes_of(kFiveNormals), 5126, 5, "VEC3"},
                                  {bytes, type, 3, "SCALAR"}},
                                 {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}}));
    const TriangleMesh& mesh = scene.meshes.at(0);
    // Vertices 0 and 4 are not used: 1, 2, 3 become 0, 1, 2.
    EXPECT_EQ(mesh.triangles, (Triangles{{2, 0, 1}})) << type;
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
  }
}

TEST(GltfMeshes, WithoutNormalsEachTriangleIsFlat) {
  // Two triangles that share an edge at a right angle: z = 0 with normal +z, x = 0 with normal +x.
  const TemporaryFolder folder;
  const Scene scene =
      load(folder, document_of(folder,
                               {{bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1}), 5126, 4, "VEC3"},
                                {bytes_of<std::uint16_t>({0, 1, 2, 0, 3, 2}), 5123, 6, "SCALAR"}},
                               {{"attributes", {{"POSITION", 0}}}, {"indices", 1}}));
  const TriangleMesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.normals.size(), 6u);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {3, 4, 5}}));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(mesh.normals[static_cast<std::size_t>(i)], glm::vec3(0, 0, 1));
  // (0,0,-1) x (0,1,0) = (0*0 - (-1)*1, ...) = (1, 0, 0).
  for (int i = 3; i < 6; ++i) EXPECT_EQ(mesh.normals[static_cast<std::size_t>(i)], glm::vec3(1, 0, 0));
}

TEST(GltfMeshes, NormalsAreMadeUnitAndThoseOfLengthZeroComeFromTheirTriangle) {
  const TemporaryFolder folder;
  const Scene scene =
      load(folder, document_of(folder,
                               {{bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}), 5126, 3, "VEC3"},
                                {bytes_of<float>({0, 0, 5, 0, 3, 4, 0, 0, 0}), 5126, 3, "VEC3"}},
                               {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}));
  const TriangleMesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0.6f, 0.8f));
  EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, 1));
  EXPECT_TRUE(any_contains(scene.warnings, "1 normal of length zero"));
}

TEST(GltfMeshes, DegenerateTrianglesAreKeptWithUnitNormals) {
  const TemporaryFolder folder;
  const Scene scene =
      load(folder, document_of(folder, {{bytes_of<float>(std::vector<float>(9, 2.0f)), 5126, 3, "VEC3"}},
                               {{"attributes", {{"POSITION", 0}}}}));
  ASSERT_EQ(triangle_count(scene, true), 1);
  for (const glm::vec3& normal : scene.meshes[0].normals) EXPECT_EQ(glm::length(normal), 1.0f);
}

TEST(GltfMeshes, QuantisedValuesDecodeAsTheSpecificationSays) {
  // Normalised: byte c -> max(c / 127, -1), short c -> max(c / 32767, -1); unsigned c / 255, c / 65535.
  const TemporaryFolder folder;
  json document = document_of(
      folder,
      {{bytes_of<std::int16_t>({32767, -32768, -32767, 0, 0, 0, 0, 32767, 0}), 5122, 3, "VEC3", true},
       {bytes_of<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, -128}), 5120, 3, "VEC3", true}},
      {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}});
  document["extensionsRequired"] = {"KHR_mesh_quantization"};
  const TriangleMesh mesh = load(folder, document).meshes.at(0);
  EXPECT_EQ(mesh.positions[0], glm::vec3(1, -1, -1));
  EXPECT_EQ(mesh.positions[2], glm::vec3(0, 1, 0));
  EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, -1));
}

TEST(GltfMeshes, SparseValuesReplaceZerosOrStoredOnes) {
  const TemporaryFolder folder;
  json document = document_of(folder,
                              {{bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}), 5126, 3, "VEC3"},
                               {bytes_of<std::uint8_t>({1, 2}), 5121, 2, "SCALAR"},
                               {bytes_of<float>({7, 8, 9, 4, 5, 6}), 5126, 2, "VEC3"}},
                              {{"attributes", {{"POSITION", 0}}}});
  document["accessors"][0]["sparse"] = {{"count", 2},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", 2}}}};
  for (const bool stored : {true, false}) {
    if (!stored) document["accessors"][0].erase("bufferView");
    const TriangleMesh mesh = load(folder, document).meshes.at(0);
    EXPECT_EQ(mesh.positions[0], glm::vec3(0, 0, 0));
    EXPECT_EQ(mesh.positions[1], glm::vec3(7, 8, 9));
    EXPECT_EQ(mesh.positions[2], glm::vec3(4, 5, 6));
  }
}

TEST(GltfMeshes, InterleavedVerticesAreReadWithTheirStride) {
  const TemporaryFolder folder;
  // Position and normal in turn: stride 24, normals at 12.
  json document = document_of(
      folder, {{bytes_of<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1}), 5126, 3, "VEC3"}},
      {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}});
  document["bufferViews"][0]["byteStride"] = 24;
  document["accessors"].push_back(document["accessors"][0]);
  document["accessors"][1]["byteOffset"] = 12;
  const TriangleMesh mesh = load(folder, document).meshes.at(0);
  EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 0));
  EXPECT_EQ(mesh.positions[2], glm::vec3(0, 1, 0));
  EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, 1));
}

TEST(GltfMeshes, AFileWithoutAnythingToShowLoadsWithAWarning) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(folder.write("model.gltf", R"({"asset": {"version": "2.0"}})"));
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_TRUE(any_contains(scene.warnings, "shows nothing"));
  EXPECT_EQ(scene.lights.size(), 1u);
}

TEST(GltfMeshes, OptionalExtensionsThatAreUnknownAreWarnings) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["extensionsUsed"] = {"KHR_materials_iridescence"};
  const Scene scene = load_scene(write_model(folder, document));
  EXPECT_TRUE(any_contains(scene.warnings, "KHR_materials_iridescence"));
}

}  // namespace
}  // namespace herr::test
