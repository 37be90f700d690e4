// Files for the tests of scenes/: the smallest glTF documents to vary, and what loading one says.
#pragma once

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/load_scene.h"
#include "sessions/files/input_error.h"
#include "tests/temporary_folder.h"

namespace herr::test {

template <class Value>
std::string bytes_of(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

// One triangle (0,0,0) (1,0,0) (0,1,0), indexed by 16-bit integers: positions in bytes
// 0...35, indices in 36...41.
inline std::string triangle_bytes() {
  return bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + bytes_of<std::uint16_t>({0, 1, 2, 0});
}

inline nlohmann::json triangle_document() {
  return nlohmann::json::parse(R"({
    "asset": {"version": "2.0"},
    "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "node", "mesh": 0}],
    "meshes": [{"name": "triangle", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"byteLength": 44, "uri": "triangle.bin"}]})");
}

// Writes the document as model.gltf beside triangle.bin.
inline std::filesystem::path write_model(const TemporaryFolder& folder, const nlohmann::json& document) {
  folder.write("triangle.bin", triangle_bytes());
  return folder.write("model.gltf", document.dump());
}

// The message of the InputError that loading throws; "" when it loads. Any other exception fails the test.
inline std::string error_of(const std::filesystem::path& file) {
  try {
    load_scene(file);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline bool any_contains(const std::vector<std::string>& texts, const std::string& part) {
  for (const std::string& text : texts) {
    if (contains(text, part)) return true;
  }
  return false;
}

}  // namespace herr::test
