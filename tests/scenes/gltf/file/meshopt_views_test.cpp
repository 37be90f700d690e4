// EXT_meshopt_compression: what was packed comes out again, and damaged or contradicting streams are refused.
// The streams are made here by meshoptimizer's encoders.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

constexpr const char* kName = "EXT_meshopt_compression";
constexpr int kSide = 7;  // vertices along a side of the grid
constexpr std::size_t kVertices = kSide * kSide;

std::string packed_vertices(const std::string& bytes, std::size_t stride) {
  const std::size_t count = bytes.size() / stride;
  std::string stream(meshopt_encodeVertexBufferBound(count, stride), '\0');
  stream.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(stream.data()), stream.size(),
                                           bytes.data(), count, stride));
  return stream;
}

std::string packed_indices(const std::vector<std::uint32_t>& indices, bool triangles) {
  std::string stream(triangles ? meshopt_encodeIndexBufferBound(indices.size(), kVertices)
                               : meshopt_encodeIndexSequenceBound(indices.size(), kVertices),
                     '\0');
  auto* to = reinterpret_cast<unsigned char*>(stream.data());
  stream.resize(triangles ? meshopt_encodeIndexBuffer(to, stream.size(), indices.data(), indices.size())
                          : meshopt_encodeIndexSequence(to, stream.size(), indices.data(), indices.size()));
  return stream;
}

// A grid in the plane z = 0; all coordinates are quarters, which every packing keeps exactly.
std::vector<float> grid_positions() {
  std::vector<float> positions;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      positions.insert(positions.end(), {0.25f * static_cast<float>(x), 0.25f * static_cast<float>(y), 0.0f});
  }
  return positions;
}

std::vector<std::uint32_t> grid_indices() {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t a = y * kSide + x, b = a + kSide;
      indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  }
  return indices;
}

// A model whose views are packed, one stream behind the other in packed.bin; their own buffer has no data.
class PackedModel {
 public:
  PackedModel() {
    document = json::parse(R"({
      "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "extensionsUsed": ["EXT_meshopt_compression"], "extensionsRequired": ["EXT_meshopt_compression"],
      "meshes": [{"primitives": [{"attributes": {}}]}], "accessors": [], "bufferViews": [],
      "buffers": [{"byteLength": 1, "uri": "packed.bin"}, {"byteLength": 1}]})");
  }

  // Returns the accessor.
  int add(const std::string& stream, std::size_t count, std::size_t stride, const char* mode,
          const char* filter, int component, const char* type) {
    const std::size_t length = count * stride;
    json view{{"buffer", 1}, {"byteOffset", plain_}, {"byteLength", length}};
    if (std::string(mode) == "ATTRIBUTES") view["byteStride"] = stride;
    view["extensions"][kName] = {{"buffer", 0},    {"byteOffset", streams_.size()},
                                 {"count", count}, {"byteLength", stream.size()},
                                 {"mode", mode},   {"byteStride", stride}};
    if (filter != nullptr) view["extensions"][kName]["filter"] = filter;
    document["bufferViews"].push_back(view);
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", count},
                                     {"type", type}});
    streams_ += stream;
    plain_ += length;
    return static_cast<int>(document["accessors"].size()) - 1;
  }

  json& primitive() { return document["meshes"][0]["primitives"][0]; }
  json& packed(std::size_t view) { return document["bufferViews"][view]["extensions"][kName]; }
  std::string& streams() { return streams_; }

  std::filesystem::path write(const TemporaryFolder& folder) {
    document["buffers"][0]["byteLength"] = streams_.size();
    document["buffers"][1]["byteLength"] = plain_;
    folder.write("packed.bin", streams_);
    return folder.write("model.gltf", document.dump());
  }

  json document;

 private:
  std::string streams_;
  std::size_t plain_ = 0;
};

PackedModel packed_grid(bool triangles, std::size_t index_size) {
  PackedModel model;
  const std::vector<std::uint32_t> indices = grid_indices();
  model.primitive()["attributes"]["POSITION"] = model.add(packed_vertices(bytes_of(grid_positions()), 12),
                                                          kVertices, 12, "ATTRIBUTES", nullptr, 5126, "VEC3");
  model.primitive()["indices"] =
      model.add(packed_indices(indices, triangles), indices.size(), index_size,
                triangles ? "TRIANGLES" : "INDICES", "NONE", index_size == 2 ? 5123 : 5125, "SCALAR");
  return model;
}

// Where the corners of each triangle stand, x and y; first the one that is least: the codec of triangles
// turns them round, and flat normals give each triangle vertices of its own.
using Corners = std::array<std::pair<float, float>, 3>;

Corners turned(Corners corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<Corners> grid_corners() {
  const std::vector<float> positions = grid_positions();
  const std::vector<std::uint32_t> indices = grid_indices();
  std::vector<Corners> corners(indices.size() / 3);
  for (std::size_t i = 0; i < indices.size(); ++i)
    corners[i / 3][i % 3] = {positions[3 * indices[i]], positions[3 * indices[i] + 1]};
  for (Corners& triangle : corners) triangle = turned(triangle);
  return corners;
}

std::vector<Corners> corners_of(const TriangleMesh& mesh) {
  std::vector<Corners> corners;
  for (const auto& triangle : mesh.triangles) {
    Corners& to = corners.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      to[c] = {mesh.positions[triangle[c]].x, mesh.positions[triangle[c]].y};
    to = turned(to);
  }
  return corners;
}

TEST(MeshoptViews, PositionsAndIndicesOfEveryModeComeOutAsTheyWentIn) {
  for (const bool triangles : {true, false}) {
    for (const std::size_t size : {2u, 4u}) {
      const TemporaryFolder folder;
      const Scene scene = load_scene(packed_grid(triangles, size).write(folder));
      ASSERT_EQ(scene.meshes.size(), 1u);
      EXPECT_EQ(corners_of(scene.meshes[0]), grid_corners());
      EXPECT_TRUE(scene.warnings.empty());
    }
  }
}

// The mantissa of 15 bits is shared by a vector: of quarters up to 1.5 it holds each.
TEST(MeshoptViews, ExponentialFloatsThatTheMantissaHoldsAreExact) {
  const std::vector<float> positions = grid_positions();
  std::string filtered(kVertices * 12, '\0');
  meshopt_encodeFilterExp(filtered.data(), kVertices, 12, 15, positions.data());
  PackedModel model;
  model.primitive()["attributes"]["POSITION"] =
      model.add(packed_vertices(filtered, 12), kVertices, 12, "ATTRIBUTES", "EXPONENTIAL", 5126, "VEC3");
  const std::vector<std::uint32_t> indices = grid_indices();
  model.primitive()["indices"] =
      model.add(packed_indices(indices, true), indices.size(), 4, "TRIANGLES", nullptr, 5125, "SCALAR");
  const TemporaryFolder folder;
  EXPECT_EQ(corners_of(load_scene(model.write(folder)).meshes.at(0)), grid_corners());
}

// Octahedral coordinates of 8 bits are off by at most 0.5/127 each, which the way back to the sphere
// stretches by no more than 2: 0.0112; each component of the result is rounded by at most 0.5/127: 0.0068. Of
// 12 bits in 16: a sixteenth.
TEST(MeshoptViews, OctahedralNormalsComeOutWithinTheirRounding) {
  std::vector<float> normals;
  for (std::size_t i = 0; i < kVertices; ++i) {
    const double turn = 0.7 * static_cast<double>(i), z = -0.9 + 1.8 * static_cast<double>(i) / kVertices;
    const double r = std::sqrt(1 - z * z);
    for (const double value : {r * std::cos(turn), r * std::sin(turn), z, 0.0})
      normals.push_back(static_cast<float>(value));
  }
  for (const std::size_t stride : {4u, 8u}) {
    std::string filtered(kVertices * stride, '\0');
    meshopt_encodeFilterOct(filtered.data(), kVertices, stride, stride == 4 ? 8 : 12, normals.data());
    PackedModel model = packed_grid(true, 2);
    const int accessor = model.add(packed_vertices(filtered, stride), kVertices, stride, "ATTRIBUTES",
                                   "OCTAHEDRAL", stride == 4 ? 5120 : 5122, "VEC3");
    model.document["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = true;
    model.primitive()["attributes"]["NORMAL"] = accessor;
    const TemporaryFolder folder;
    const Scene scene = load_scene(model.write(folder));
    for (std::size_t i = 0; i < kVertices; ++i) {
      const glm::vec3 wanted(normals[4 * i], normals[4 * i + 1], normals[4 * i + 2]);
      EXPECT_LE(glm::distance(scene.meshes.at(0).normals.at(i), wanted), stride == 4 ? 0.018f : 0.0012f) << i;
    }
  }
}

// The three smaller components of 16 bits lie within +-1/sqrt(2): a step is 2.2e-5, and a matrix of products
// of two components, each below 1, is off by less than ten of them.
TEST(MeshoptViews, QuaternionsOfInstancesTurnAsTheyDid) {
  std::vector<glm::quat> turns;
  for (int i = 0; i < 20; ++i) {
    const auto angle = 0.3f * static_cast<float>(i);
    turns.push_back(glm::angleAxis(angle, glm::normalize(glm::vec3(1, 0.1f * static_cast<float>(i), -0.5f))));
  }
  std::vector<float> values;
  for (const glm::quat& q : turns) values.insert(values.end(), {q.x, q.y, q.z, q.w});
  std::string filtered(turns.size() * 8, '\0');
  meshopt_encodeFilterQuat(filtered.data(), turns.size(), 8, 16, values.data());
  PackedModel model = packed_grid(true, 2);
  const int accessor =
      model.add(packed_vertices(filtered, 8), turns.size(), 8, "ATTRIBUTES", "QUATERNION", 5122, "VEC4");
  model.document["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = true;
  model.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = accessor;
  const TemporaryFolder folder;
  const Scene scene = load_scene(model.write(folder));
  ASSERT_EQ(scene.instances.size(), turns.size());
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const glm::dmat3 wanted = glm::mat3_cast(glm::dquat(turns[i]));
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LE(glm::distance(glm::dvec3(scene.instances[i].world_from_object[axis]), wanted[axis]), 2.2e-4)
          << i;
  }
}

TEST(MeshoptViews, ABufferForReadersWithoutTheExtensionNeedNotBeThere) {
  const TemporaryFolder folder;
  PackedModel model = packed_grid(true, 2);
  model.document["buffers"][1]["uri"] = "nowhere.bin";
  model.document["buffers"][1]["extensions"][kName]["fallback"] = true;
  EXPECT_EQ(error_of(model.write(folder)), "");
}

struct PackedFault {
  const char* name;
  std::function<void(PackedModel&)> break_it;
  const char* expected;
};

TEST(MeshoptViews, EveryFaultIsAnInputErrorThatNamesIt) {
  const std::vector<PackedFault> faults{
      {"cut stream", [](PackedModel& m) { m.packed(0)["byteLength"] = 60; }, "is damaged"},
      {"stream of indices as attributes", [](PackedModel& m) { m.streams()[0] = '\xe1'; }, "is damaged"},
      {"stream of a later version", [](PackedModel& m) { m.streams()[0] = '\xa1'; }, "is damaged"},
      {"stream past its buffer", [](PackedModel& m) { m.packed(1)["byteLength"] = 100000; },
       "byteLength reaches byte"},
      {"buffer that is not there", [](PackedModel& m) { m.packed(0)["buffer"] = 2; }, "buffer is 2"},
      {"another count than the view", [](PackedModel& m) { m.packed(0)["count"] = 48; },
       "is 48 elements of 12 bytes, and its view has 588 bytes"},
      {"another stride than the view",
       [](PackedModel& m) { m.document["bufferViews"][0]["byteStride"] = 16; }, "byteStride is not that of"},
      {"stride of 6",
       [](PackedModel& m) {
         m.packed(0)["byteStride"] = 6;
         m.packed(0)["count"] = 98;
         m.document["bufferViews"][0]["byteStride"] = 6;
       },
       "byteStride is 6, not a multiple of 4"},
      {"indices of 1 byte", [](PackedModel& m) { m.packed(1)["byteStride"] = 1; }, "not 2 or 4"},
      {"two thirds of a triangle", [](PackedModel& m) { m.packed(1)["count"] = 215; }, "not a multiple of 3"},
      {"filter of indices", [](PackedModel& m) { m.packed(1)["filter"] = "EXPONENTIAL"; },
       "stands beside indices"},
      {"filter that is unknown", [](PackedModel& m) { m.packed(0)["filter"] = "COLOR"; },
       "filter is \"COLOR\""},
      {"octahedral vectors of 12 bytes", [](PackedModel& m) { m.packed(0)["filter"] = "OCTAHEDRAL"; },
       "not 4 or 8"},
      {"quaternions of 12 bytes", [](PackedModel& m) { m.packed(0)["filter"] = "QUATERNION"; }, "not 8"},
      {"mode that is unknown", [](PackedModel& m) { m.packed(0)["mode"] = "POINTS"; }, "mode is \"POINTS\""},
      {"negative count", [](PackedModel& m) { m.packed(0)["count"] = -1; }, "count is -1"},
      {"plain view of the buffer without data",
       [](PackedModel& m) { m.document["bufferViews"][1].erase("extensions"); }, "buffers[1].uri is missing"},
      {"stream in the buffer without data", [](PackedModel& m) { m.packed(0)["buffer"] = 1; },
       "buffers[1].uri is missing"},
      {"index past the vertices", [](PackedModel& m) { m.document["accessors"][0]["count"] = 48; },
       "names vertex 48 of 48"}};
  for (const PackedFault& fault : faults) {
    const TemporaryFolder folder;
    PackedModel model = packed_grid(true, 2);
    fault.break_it(model);
    const std::string message = error_of(model.write(folder));
    EXPECT_TRUE(contains(message, fault.expected)) << fault.name << ": \"" << message << '"';
  }
}

// One byte of the streams becomes another: what comes out is an error or a scene, never a crash.
TEST(MeshoptViews, StreamsWithAnyDamagedByteAreRefusedOrRead) {
  const TemporaryFolder folder;
  const std::size_t length = packed_grid(true, 4).streams().size();
  for (std::size_t i = 0; i < length; i += 5) {
    PackedModel model = packed_grid(true, 4);
    model.streams()[i] = static_cast<char>(~model.streams()[i]);
    error_of(model.write(folder));  // any other exception fails the test
  }
}

// A model may have 2^30 bytes. A view of nearly as many, 12 * floor(2^30 / 12), and the file of the streams
// are more; one of 700 MB alone is not, but its stream is too short: it has two bits for each 16 bytes at
// least.
TEST(MeshoptViews, ASmallFileCannotAskForMuchMemory) {
  const std::pair<std::size_t, const char*> sizes[] = {
      {(1u << 30) / 12, "makes the unpacked buffers larger than a model may be"},
      {700'000'000 / 12, "is damaged"}};
  for (const auto& [count, expected] : sizes) {
    const TemporaryFolder folder;
    PackedModel model = packed_grid(true, 4);
    model.packed(0)["count"] = count;
    model.document["bufferViews"][0]["byteLength"] = 12 * count;
    const auto file = model.write(folder);
    model.document["buffers"][1]["byteLength"] = 1u << 30;
    folder.write("model.gltf", model.document.dump());
    EXPECT_TRUE(contains(error_of(file), expected)) << error_of(file);
  }
}

TEST(MeshoptViews, BrokenOnesThatAreOptionalGiveWayToThePlainFormBesideThem) {
  const auto broken = [](bool stream) {
    PackedModel model = packed_grid(true, 4);
    std::string plain = bytes_of(grid_positions());
    plain += bytes_of(grid_indices());
    model.document["buffers"][1]["uri"] = "plain.bin";
    if (stream) std::fill(model.streams().begin(), model.streams().end(), '\x7f');
    if (!stream) model.packed(0)["count"] = 3;
    return std::pair{model, plain};
  };
  for (const bool stream : {true, false}) {
    auto [model, plain] = broken(stream);
    const TemporaryFolder folder;
    folder.write("plain.bin", plain);
    EXPECT_TRUE(contains(error_of(model.write(folder)), kName)) << "required";
    model.document.erase("extensionsRequired");
    const Scene scene = load_scene(model.write(folder));
    EXPECT_EQ(scene.meshes.at(0).triangles.size(), grid_corners().size());
    EXPECT_TRUE(any_contains(scene.warnings, "the uncompressed form beside it is shown"));
    model.document["buffers"][1].erase("uri");
    EXPECT_TRUE(contains(error_of(model.write(folder)), kName)) << "nothing stands beside it";
  }
}

}  // namespace
}  // namespace herr::test
