#include "scenes/samples/generator/glb/glb_writer.h"

#include <cstring>
#include <fstream>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

namespace herr::samples {

namespace {

using Json = nlohmann::ordered_json;

// Numbers of the glTF specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertexTarget = 34962, kIndexTarget = 34963;

// The document and its binary chunk, while they grow together.
struct GlbDraft {
  Json document;
  std::vector<char> binary;

  // Appends bytes, aligned to 4 as accessors require; returns the index of their buffer view.
  std::size_t add_view(std::span<const std::byte> bytes, int target) {
    binary.resize((binary.size() + 3) / 4 * 4, 0);
    Json view{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    const auto* first = reinterpret_cast<const char*>(bytes.data());
    binary.insert(binary.end(), first, first + bytes.size());
    document["bufferViews"].push_back(view);
    return document["bufferViews"].size() - 1;
  }

  std::size_t add_accessor(std::size_t view, int component, std::size_t count, const char* type) {
    document["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return document["accessors"].size() - 1;
  }
};

Json as_json(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

std::size_t add_positions(GlbDraft& draft, const std::vector<glm::vec3>& positions) {
  const std::size_t view = draft.add_view(std::as_bytes(std::span(positions)), kVertexTarget);
  const std::size_t accessor = draft.add_accessor(view, kFloat, positions.size(), "VEC3");
  glm::vec3 lower = positions.front(), upper = positions.front();
  for (const glm::vec3& p : positions) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  draft.document["accessors"][accessor]["min"] = as_json(lower);
  draft.document["accessors"][accessor]["max"] = as_json(upper);
  return accessor;
}

std::size_t add_material(GlbDraft& draft, const GlbMaterial& material) {
  Json pbr{{"baseColorFactor", {material.base_colour.x, material.base_colour.y, material.base_colour.z, 1.0}},
           {"metallicFactor", material.metallic},
           {"roughnessFactor", material.roughness}};
  if (material.picture) {
    const std::vector<std::uint8_t> png = encode_png(*material.picture);
    const std::size_t view = draft.add_view(std::as_bytes(std::span(png)), 0);
    draft.document["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
    draft.document["textures"].push_back({{"source", draft.document["images"].size() - 1}});
    pbr["baseColorTexture"] = {{"index", draft.document["textures"].size() - 1}};
  }
  // Leaves, rings and shells are thin: both of their sides are seen.
  Json entry{{"name", material.name}, {"pbrMetallicRoughness", pbr}, {"doubleSided", true}};
  if (material.emission != glm::vec3(0.0f)) entry["emissiveFactor"] = as_json(material.emission);
  draft.document["materials"].push_back(entry);
  return draft.document["materials"].size() - 1;
}

Json add_primitive(GlbDraft& draft, const GlbPart& part) {
  const Mesh& mesh = part.mesh;
  Json attributes{{"POSITION", add_positions(draft, mesh.positions)}};
  const std::size_t normals = draft.add_view(std::as_bytes(std::span(mesh.normals)), kVertexTarget);
  attributes["NORMAL"] = draft.add_accessor(normals, kFloat, mesh.normals.size(), "VEC3");
  if (part.material.picture) {
    const std::size_t uvs = draft.add_view(std::as_bytes(std::span(mesh.uvs)), kVertexTarget);
    attributes["TEXCOORD_0"] = draft.add_accessor(uvs, kFloat, mesh.uvs.size(), "VEC2");
  }
  const std::size_t indices = draft.add_view(std::as_bytes(std::span(mesh.triangles)), kIndexTarget);
  const std::size_t accessor = draft.add_accessor(indices, kUnsignedInt, 3 * mesh.triangles.size(), "SCALAR");
  return {
      {"attributes", attributes}, {"indices", accessor}, {"material", add_material(draft, part.material)}};
}

// A chunk: length, type, content padded to a multiple of 4.
void put_chunk(std::string& file, const char (&type)[5], std::string content, char padding) {
  content.resize((content.size() + 3) / 4 * 4, padding);
  const auto length = static_cast<std::uint32_t>(content.size());
  file.append(reinterpret_cast<const char*>(&length), 4).append(type, 4).append(content);
}

std::string glb_bytes(GlbDraft& draft) {
  draft.document["buffers"] = Json::array({{{"byteLength", (draft.binary.size() + 3) / 4 * 4}}});
  std::string chunks;
  put_chunk(chunks, "JSON", draft.document.dump(), ' ');
  put_chunk(chunks, "BIN\0", {draft.binary.begin(), draft.binary.end()}, '\0');
  const std::uint32_t version = 2, length = static_cast<std::uint32_t>(12 + chunks.size());
  std::string file = "glTF";
  file.append(reinterpret_cast<const char*>(&version), 4).append(reinterpret_cast<const char*>(&length), 4);
  return file + chunks;
}

}  // namespace

std::size_t triangle_count(const GlbObject& object) {
  std::size_t count = 0;
  for (const GlbPart& part : object.parts) count += part.mesh.triangles.size();
  return count;
}

void write_glb(const std::filesystem::path& file, const GlbObject& object) {
  GlbDraft draft;
  draft.document["asset"] = {{"version", "2.0"}, {"generator", "herr-make-scenes"}};
  draft.document["scene"] = 0;
  draft.document["scenes"] = Json::array({{{"nodes", {0}}}});
  draft.document["nodes"] = Json::array({{{"name", object.name}, {"mesh", 0}}});
  Json primitives = Json::array();
  for (const GlbPart& part : object.parts) primitives.push_back(add_primitive(draft, part));
  draft.document["meshes"] = Json::array({{{"name", object.name}, {"primitives", primitives}}});
  const std::string bytes = glb_bytes(draft);

  std::filesystem::path unfinished = file;
  unfinished += ".part";
  std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error("cannot write " + unfinished.string());
  std::filesystem::rename(unfinished, file);
}

}  // namespace herr::samples
