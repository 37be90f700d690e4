// Where the bytes of a glTF come from: names with signs in them, data longer than they are said to be.
#include <gtest/gtest.h>

#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

// The triangle of scene_files.h is read: its three corners as they are written there.
void expect_triangle(const std::filesystem::path& file) {
  ASSERT_EQ(error_of(file), "");
  const Scene scene = load_scene(file);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].positions,
            (std::vector<glm::vec3>{glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}));
}

json document_of(const std::string& uri) {
  json document = triangle_document();
  document["buffers"][0]["uri"] = uri;
  return document;
}

TEST(GltfBytes, FilesHaveTheNameThatTheirUriStandsFor) {
  const std::pair<const char*, const char*> names[] = {{"a+b%23c.bin", "a+b#c.bin"},
                                                       {"a b.bin", "a b.bin"},
                                                       {"a%20b.bin", "a b.bin"},
                                                       {"100%.bin", "100%.bin"},
                                                       {"%zz+%4.bin", "%zz+%4.bin"},
                                                       // written without escapes: the name as it stands
                                                       {"50%25.bin", "50%25.bin"},
                                                       {"%41.bin", "%41.bin"}};
  for (const auto& [uri, name] : names) {
    const TemporaryFolder folder;
    folder.write(name, triangle_bytes());
    expect_triangle(folder.write("model.gltf", document_of(uri).dump()));
  }
}

TEST(GltfBytes, OfTwoFilesTheOneThatTheEscapesMeanIsRead) {
  const TemporaryFolder folder;
  folder.write("A.bin", triangle_bytes());
  folder.write("%41.bin", std::string(44, 'x'));
  const auto file = folder.write("model.gltf", document_of("%41.bin").dump());
  expect_triangle(file);
  EXPECT_EQ(load_scene(file).files.at(1).filename(), "A.bin");
}

TEST(GltfBytes, ANameThatLeadsNowhereIsToldAsItsUriMeansIt) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(error_of(folder.write("model.gltf", document_of("no%20such.bin").dump())),
                       "names \"no such.bin\", which cannot be opened"));
}

TEST(GltfBytes, OfLongerBuffersTheFirstBytesCount) {
  const TemporaryFolder folder;
  const std::string longer = triangle_bytes() + std::string(1000, 'x');
  folder.write("longer.bin", longer);
  expect_triangle(folder.write("file.gltf", document_of("longer.bin").dump()));
  // The bytes of the triangle in escaped text; what follows them is left out.
  std::string uri = "data:application/octet-stream,";
  constexpr const char* kDigits = "0123456789abcdef";
  for (const char byte : longer) {
    const auto value = static_cast<unsigned char>(byte);
    uri += {'%', kDigits[value / 16], kDigits[value % 16]};
  }
  expect_triangle(folder.write("data.gltf", document_of(uri).dump()));
}

// Chunks are padded to multiples of four; writers pad to more, for alignment.
TEST(GltfBytes, OfALongerBinaryChunkTheFirstBytesCountAndOtherChunksAreLeftAlone) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["buffers"][0].erase("uri");
  const auto word = [](std::size_t value) {
    return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)});
  };
  const auto chunk = [&](const char* kind, const std::string& data) {
    return word(data.size()) + std::string(kind, 4) + data;
  };
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string body =
      chunk("JSON", text) + chunk("BIN\0", triangle_bytes() + std::string(64, '\0')) + chunk("NOTE", "abcd");
  expect_triangle(folder.write("model.glb", "glTF" + word(2) + word(12 + body.size()) + body));
  document["buffers"][0]["byteLength"] = 109;
  text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string less = chunk("JSON", text) + chunk("BIN\0", triangle_bytes() + std::string(64, '\0'));
  EXPECT_TRUE(contains(error_of(folder.write("less.glb", "glTF" + word(2) + word(12 + less.size()) + less)),
                       "buffers[0].byteLength is 109, and its data have 108 bytes"));
}

}  // namespace
}  // namespace herr::test
