// Broken and hostile glTF files: each must give an InputError that names the file and
// the fault, never a crash.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>

#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

struct Fault {
  const char* name;
  std::function<void(json&)> break_it;
  const char* expected;  // part of the message
};

void set(json& document, const char* pointer, json value) {
  document[json::json_pointer(pointer)] = std::move(value);
}

const std::vector<Fault>& faults() {
  static const std::vector<Fault> kFaults{
      {"accessor reads past its buffer view", [](json& d) { set(d, "/accessors/0/count", 4); },
       "accessors[0].count"},
      // offset + (count - 1) * stride + size = 2^64 would wrap to a small number.
      {"accessor offset near 2^64",
       [](json& d) { set(d, "/accessors/0/byteOffset", 18446744073709551600ull); },
       "accessors[0].byteOffset"},
      {"a thousand million vertices in 36 bytes", [](json& d) { set(d, "/accessors/0/count", 1000000000); },
       "accessors[0].count"},
      {"a thousand million vertices in no view at all",
       [](json& d) {
         set(d, "/accessors/0/count", 1000000000);
         d["accessors"][0].erase("bufferView");
       },
       "accessors[0].count"},
      {"negative offset", [](json& d) { set(d, "/bufferViews/0/byteOffset", -8); },
       "bufferViews[0].byteOffset"},
      {"view past its buffer", [](json& d) { set(d, "/bufferViews/1/byteLength", 60); },
       "bufferViews[1].byteLength"},
      {"index 2^32 + 1, which is 1 as 32 bits",
       [](json& d) { set(d, "/accessors/1/bufferView", 4294967297ll); }, "accessors[1].bufferView"},
      {"view of a buffer that does not exist", [](json& d) { set(d, "/bufferViews/0/buffer", 7); },
       "bufferViews[0].buffer"},
      {"stride smaller than an element", [](json& d) { set(d, "/bufferViews/0/byteStride", 8); },
       "bufferViews[0].byteStride"},
      {"unknown component type", [](json& d) { set(d, "/accessors/0/componentType", 5124); },
       "componentType"},
      {"unknown element type", [](json& d) { set(d, "/accessors/0/type", "VEC9"); }, "accessors[0].type"},
      {"sparse indices past their view",
       [](json& d) {
         set(d, "/accessors/0/sparse",
             {{"count", 3},
              {"indices", {{"bufferView", 1}, {"byteOffset", 2}, {"componentType", 5123}}},
              {"values", {{"bufferView", 0}}}});
       },
       "accessors[0].sparse"},
      {"sparse index past the accessor",
       [](json& d) {
         // Positions read as 16-bit integers: 1.0f is 0x3f800000, so element 3 + 3 of them is 0x3f80 = 16256.
         set(d, "/accessors/0/sparse",
             {{"count", 1},
              {"indices", {{"bufferView", 0}, {"byteOffset", 14}, {"componentType", 5123}}},
              {"values", {{"bufferView", 0}}}});
       },
       "sparse index"},
      {"image view past the buffer",
       [](json& d) {
         set(d, "/bufferViews/2", {{"buffer", 0}, {"byteOffset", 100000000}, {"byteLength", 12}});
         set(d, "/images", json::array({{{"bufferView", 2}, {"mimeType", "image/png"}}}));
       },
       "bufferViews[2].byteLength"},
      {"index of a vertex that does not exist", [](json& d) { set(d, "/accessors/0/count", 2); },
       "names vertex 2 of 2"},
      {"missing buffer", [](json& d) { set(d, "/buffers/0/uri", "absent.bin"); }, "absent.bin"},
      {"buffer outside the folder", [](json& d) { set(d, "/buffers/0/uri", "../secret.bin"); },
       "outside the folder"},
      {"the same, percent-encoded", [](json& d) { set(d, "/buffers/0/uri", "%2e%2e/secret.bin"); },
       "outside the folder"},
      {"absolute path", [](json& d) { set(d, "/buffers/0/uri", "/etc/hostname"); }, "outside the folder"},
      {"file URL", [](json& d) { set(d, "/buffers/0/uri", "file:///etc/hostname"); }, "cannot be opened"},
      {"web address", [](json& d) { set(d, "/buffers/0/uri", "http://example.com/a.bin"); },
       "cannot be opened"},
      {"a folder as buffer", [](json& d) { set(d, "/buffers/0/uri", "."); }, "is a folder, not a file"},
      {"empty name", [](json& d) { set(d, "/buffers/0/uri", ""); }, "uri"},
      {"NUL byte in a name", [](json& d) { set(d, "/buffers/0/uri", "triangle.bin%00.png"); }, "NUL"},
      {"buffer shorter than declared", [](json& d) { set(d, "/buffers/0/byteLength", 48); },
       "buffers[0].byteLength is 48, and its data have 44 bytes"},
      {"data URI with broken base64",
       [](json& d) { set(d, "/buffers/0/uri", "data:application/octet-stream;base64,AAAA****"); },
       "none of base64"},
      {"data URI of three bytes",
       [](json& d) { set(d, "/buffers/0/uri", "data:application/x-other;base64,AAAA"); },
       "its data have 3 bytes"},
      {"data URI without data", [](json& d) { set(d, "/buffers/0/uri", "data:;base64,"); }, "holds no data"},
      {"data URI without a comma", [](json& d) { set(d, "/buffers/0/uri", "data:AAAA"); }, "no comma"},
      {"node cycle",
       [](json& d) {
         set(d, "/nodes", json::array({{{"children", {1}}}, {{"children", {0}}}}));
         set(d, "/scenes/0/nodes", json::array());
       },
       "its own ancestor"},
      {"node that is its own child", [](json& d) { set(d, "/nodes/0/children", {0}); }, "ancestor"},
      {"node with two parents",
       [](json& d) {
         set(d, "/nodes", json::array({{{"children", {2}}}, {{"children", {2}}}, json::object()}));
       },
       "already is a child"},
      {"scene that shows a child",
       [](json& d) {
         set(d, "/nodes", json::array({{{"children", {1}}}, {{"mesh", 0}}}));
         set(d, "/scenes/0/nodes", {1});
       },
       "child of another"},
      {"scene that does not exist", [](json& d) { set(d, "/scene", 7); }, "scene"},
      {"node that does not exist", [](json& d) { set(d, "/scenes/0/nodes", {5}); }, "scenes[0].nodes"},
      {"scale 0",
       [](json& d) {
         set(d, "/nodes/0/scale", {1, 0, 1});
       },
       "scale of 0 on the y axis"},
      {"scale 1e-25",
       [](json& d) {
         set(d, "/nodes/0/scale", {1e-25, 1e-25, 1e-25});
       },
       "scale of 0"},
      // 9e-13 cubed is 7.3e-37, below 1e-36.
      {"scale 9e-13",
       [](json& d) {
         set(d, "/nodes/0/scale", {9e-13, 9e-13, 9e-13});
       },
       "determinant"},
      {"matrix that flattens",
       [](json& d) {
         set(d, "/nodes/0/matrix", {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
       },
       "plane"},
      {"matrix that projects",
       [](json& d) {
         set(d, "/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
       },
       "not affine"},
      {"matrix of 15 numbers",
       [](json& d) {
         set(d, "/nodes/0/matrix", json::array({1, 0, 0}));
       },
       "nodes[0].matrix"},
      {"rotation of length zero",
       [](json& d) {
         set(d, "/nodes/0/rotation", {0, 0, 0, 0});
       },
       "rotation"},
      {"translation beyond the limit",
       [](json& d) {
         set(d, "/nodes/0/translation", {1e20, 0, 0});
       },
       "1e12"},
      {"required extension", [](json& d) { set(d, "/extensionsRequired", {"KHR_draco_mesh_compression"}); },
       "KHR_draco_mesh_compression"},
      {"glTF 1.0", [](json& d) { set(d, "/asset/version", "1.0"); }, "asset.version"},
      {"no asset", [](json& d) { d.erase("asset"); }, "asset"},
      {"mesh that does not exist", [](json& d) { set(d, "/nodes/0/mesh", 3); }, "nodes[0].mesh"},
      {"material that does not exist", [](json& d) { set(d, "/meshes/0/primitives/0/material", 0); },
       "material is 0, and there is none that it could name"},
      {"texture index -1",
       [](json& d) {
         set(d, "/materials",
             json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", -1}}}}}}}));
       },
       "baseColorTexture"},
      {"primitive mode 9", [](json& d) { set(d, "/meshes/0/primitives/0/mode", 9); }, "mode"},
      {"positions of two components", [](json& d) { set(d, "/accessors/0/type", "VEC2"); }, "components"},
      {"indices that are floats", [](json& d) { set(d, "/meshes/0/primitives/0/indices", 0); },
       "does not hold unsigned integers"},
      {"colour beyond 1",
       [](json& d) {
         set(d, "/materials", json::array({{{"pbrMetallicRoughness", {{"baseColorFactor", {2, 1, 1, 1}}}}}}));
       },
       "baseColorFactor"},
      {"meshes that are no array", [](json& d) { set(d, "/meshes", json::object()); }, "meshes"},
  };
  return kFaults;
}

TEST(GltfFaults, EveryFaultIsAnInputErrorThatNamesTheFileAndTheFault) {
  for (const Fault& fault : faults()) {
    const TemporaryFolder folder;
    json document = triangle_document();
    fault.break_it(document);
    const std::string message = error_of(write_model(folder, document));
    EXPECT_TRUE(contains(message, fault.expected)) << fault.name << ": \"" << message << '"';
    EXPECT_TRUE(contains(message, "model.gltf")) << fault.name << ": \"" << message << '"';
    EXPECT_FALSE(contains(message, "\n")) << fault.name;
  }
}

TEST(GltfFaults, TheUnbrokenDocumentLoads) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of(write_model(folder, triangle_document())), "");
}

TEST(GltfFaults, AFileOutsideTheFolderIsRefusedThoughItExistsAndFits) {
  const TemporaryFolder folder;
  folder.write("secret.bin", triangle_bytes());
  folder.write("models/triangle.bin", triangle_bytes());
  json document = triangle_document();
  document["buffers"][0]["uri"] = "../secret.bin";
  EXPECT_TRUE(contains(error_of(folder.write("models/model.gltf", document.dump())), "outside the folder"));
  // A link is no way around it.
  std::filesystem::create_symlink(folder.path() / "secret.bin", folder.path() / "models/link.bin");
  document["buffers"][0]["uri"] = "link.bin";
  EXPECT_TRUE(contains(error_of(folder.write("models/model.gltf", document.dump())), "outside the folder"));
}

TEST(GltfFaults, APipeAsBufferIsRefusedWithoutWaitingForAWriter) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder.path() / "pipe.bin").c_str(), 0600), 0);
  json document = triangle_document();
  document["buffers"][0]["uri"] = "pipe.bin";
  EXPECT_TRUE(contains(error_of(write_model(folder, document)), "not a regular file"));
}

TEST(GltfFaults, ExtrasNested60000DeepAreRefused) {
  const TemporaryFolder folder;
  std::string text = triangle_document().dump();
  const std::string deep = std::string(60000, '[') + std::string(60000, ']');
  text.insert(text.find("\"version\""), "\"extras\":" + deep + ",");
  EXPECT_TRUE(contains(error_of(folder.write("model.gltf", text)), "model.gltf"));
}

TEST(GltfFaults, ANodeChainOf100000LoadsWithoutRecursion) {
  const TemporaryFolder folder;
  json document = triangle_document();
  constexpr int kDepth = 100000;
  json nodes = json::array();
  for (int i = 0; i + 1 < kDepth; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}});
  document["nodes"] = std::move(nodes);
  EXPECT_EQ(error_of(write_model(folder, document)), "");
}

TEST(GltfFaults, ANumberThatIsNotJsonIsAnError) {
  const TemporaryFolder folder;
  for (const char* number : {"NaN", "Infinity", "1e999"}) {
    json document = triangle_document();
    document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, "HERE", 0, 0, 1};
    std::string text = document.dump();
    text.replace(text.find("\"HERE\""), 6, number);
    EXPECT_TRUE(contains(error_of(folder.write("model.gltf", text)), "model.gltf")) << number;
  }
}

TEST(GltfFaults, VerticesThatAreNotFiniteNameTheirElement) {
  const TemporaryFolder folder;
  const auto file = write_model(folder, triangle_document());
  std::string bytes = triangle_bytes();
  const float broken[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          1e30f};
  for (const float value : broken) {
    std::memcpy(&bytes[4 * 4], &value, 4);  // y of vertex 1
    folder.write("triangle.bin", bytes);
    EXPECT_TRUE(
        contains(error_of(file), "accessors[0] holds a value that is not finite or too large, in element 1"));
  }
}

TEST(GltfFaults, AModelThatReachesTooFarThroughItsScaleIsRefused) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["nodes"][0]["scale"] = {1e12, 1e12, 1e12};
  document["nodes"][0]["translation"] = {1e11, 0, 0};
  EXPECT_TRUE(contains(error_of(write_model(folder, document)), "farther than 1e12 m"));
}

TEST(GltfFaults, ABinaryFileCutAtAnyByteIsAnInputError) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["buffers"][0].erase("uri");
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)});
  };
  const std::string body =
      word(text.size()) + "JSON" + text + word(44) + std::string("BIN\0", 4) + triangle_bytes();
  const std::string whole = "glTF" + word(2) + word(12 + body.size()) + body;
  EXPECT_EQ(error_of(folder.write("model.glb", whole)), "");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_TRUE(contains(error_of(folder.write("model.glb", whole.substr(0, length))), "model.glb"))
        << length;
  }
}

TEST(GltfFaults, AFileThatIsMissingAFolderOrOfAnotherFormatIsSaidSo) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(error_of(folder.path() / "absent.glb"), "No such file"));
  std::filesystem::create_directory(folder.path() / "folder.glb");
  EXPECT_TRUE(contains(error_of(folder.path() / "folder.glb"), "is a folder, not a file"));
  EXPECT_TRUE(contains(error_of(folder.write("bunny.obj", "v 0 0 0\n")), ".scene.json, .gltf, .glb or .vox"));
  EXPECT_TRUE(contains(error_of(folder.write("empty.gltf", "")), "empty.gltf"));
}

}  // namespace
}  // namespace herr::test
