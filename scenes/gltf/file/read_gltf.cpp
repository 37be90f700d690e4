#include "scenes/gltf/file/read_gltf.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "scenes/gltf/file/gltf_bytes.h"
#include "scenes/gltf/file/gltf_checks.h"
#include "scenes/gltf/file/gltf_lights.h"
#include "scenes/gltf/file/gltf_limits.h"
#include "scenes/gltf/file/gltf_materials.h"
#include "scenes/gltf/file/gltf_motion.h"
#include "scenes/gltf/file/gpu_instances.h"
#include "scenes/gltf/format/meshopt_views.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/files/strict_json.h"

namespace herr {

std::string gltf_warning(const GltfModel& model, const std::string& text) {
  return printable(model.file.string()) + ": " + text;
}

namespace {

// tinygltf is shown a document without buffers and images, so that it opens no file and decodes nothing.
bool no_file(const std::string&, void*) {
  return false;
}

std::string same_path(const std::string& path, void*) {
  return path;
}

bool refuse_to_read(std::vector<unsigned char>*, std::string*, const std::string&, void*) {
  return false;
}

bool refuse_to_write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

tinygltf::Model parse(nlohmann::json& document, const std::filesystem::path& file) {
  for (const char* key : {"buffers", "images"}) document.erase(key);
  const std::string text = document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({no_file, same_path, refuse_to_read, refuse_to_write, nullptr});
  tinygltf::Model model;
  std::string error, warning;
  // The text has kMaxGltfBytes, and no more than 25 bytes for each of kMaxJsonValues numbers.
  if (!parser.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                  static_cast<unsigned int>(text.size()), ""))
    throw InputError(file, 0, "is not a valid glTF: " + printable(error), "export the model again");
  return model;
}

TextureWrap wrap_of(int gl_name) {
  if (gl_name == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp;
  if (gl_name == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return TextureWrap::mirror;
  return TextureWrap::repeat;
}

GltfAccessor convert(const tinygltf::Accessor& from) {
  GltfAccessor to;
  to.view = from.bufferView;
  to.offset = from.byteOffset;
  to.count = from.count;
  to.component_type = from.componentType;
  to.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(from.type));
  to.normalised = from.normalized;
  if (!from.sparse.isSparse) return to;
  to.sparse_count = static_cast<std::size_t>(from.sparse.count);
  to.sparse_index_view = from.sparse.indices.bufferView;
  to.sparse_index_offset = static_cast<std::size_t>(from.sparse.indices.byteOffset);
  to.sparse_index_type = from.sparse.indices.componentType;
  to.sparse_value_view = from.sparse.values.bufferView;
  to.sparse_value_offset = static_cast<std::size_t>(from.sparse.values.byteOffset);
  return to;
}

glm::dmat4x3 matrix_of(const tinygltf::Node& node) {
  glm::dmat4x3 matrix{1.0};
  if (node.matrix.size() == 16) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row)
        matrix[column][row] = node.matrix[static_cast<std::size_t>(4 * column + row)];
    }
    return matrix;
  }
  const auto& q = node.rotation;
  const glm::dmat3 rotation =
      q.size() == 4 ? glm::mat3_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]))) : glm::dmat3(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    matrix[axis] = rotation[axis] * (node.scale.size() == 3 ? node.scale[i] : 1.0);
    if (node.translation.size() == 3) matrix[3][axis] = node.translation[i];
  }
  return matrix;
}

GltfPrimitive convert(const tinygltf::Primitive& from) {
  GltfPrimitive to;
  to.mode = from.mode < 0 ? TINYGLTF_MODE_TRIANGLES : from.mode;
  to.indices = from.indices;
  to.material = from.material;
  const auto attribute = [&](const std::string& name) {
    const auto found = from.attributes.find(name);
    return found == from.attributes.end() ? -1 : found->second;
  };
  to.position = attribute("POSITION");
  to.normal = attribute("NORMAL");
  to.tangent = attribute("TANGENT");
  for (int set = 0, accessor = 0; (accessor = attribute("TEXCOORD_" + std::to_string(set))) >= 0; ++set) {
    to.uv_sets.push_back(accessor);
  }
  to.colour = attribute("COLOR_0");
  return to;
}

void convert_nodes(tinygltf::Model& from, GltfModel& to) {
  std::vector<bool> has_parent(from.nodes.size(), false);
  for (auto& node : from.nodes) {
    for (const int child : node.children) has_parent[static_cast<std::size_t>(child)] = true;
    const auto& q = node.rotation;
    const double norm2 = q.size() == 4 ? q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] : 1;
    if (norm2 < 0.998 || norm2 > 1.002) {  // |q| off by more than 1e-3
      to.warnings.push_back("the rotation of node \"" + printable(node.name) +
                            "\" is not of unit length; normalised");
    }
    to.nodes.push_back({node.name,
                        node.mesh,
                        -1,
                        node.children,
                        matrix_of(node),
                        {},
                        -1,
                        false,
                        {},
                        glm::dvec3(1.0),
                        {},
                        {}});
  }
  if (!from.scenes.empty()) {
    const int scene = std::max(from.defaultScene, 0);
    to.roots = from.scenes[static_cast<std::size_t>(scene)].nodes;
    return;
  }
  // A file without scenes is a library of nodes: all of it is shown.
  for (std::size_t i = 0; i < from.nodes.size(); ++i) {
    if (!has_parent[i]) to.roots.push_back(static_cast<int>(i));
  }
}

GltfModel convert(tinygltf::Model&& from, const std::filesystem::path& file, GltfBytes&& bytes) {
  GltfModel to;
  to.file = file;
  to.buffers = std::move(bytes.buffers);
  to.images = std::move(bytes.images);
  for (const auto& view : from.bufferViews) {
    to.views.push_back({view.buffer, view.byteOffset, view.byteLength, view.byteStride});
  }
  for (const auto& accessor : from.accessors) to.accessors.push_back(convert(accessor));
  for (const auto& mesh : from.meshes) {
    GltfMesh& converted = to.meshes.emplace_back();
    converted.name = mesh.name;
    for (const auto& primitive : mesh.primitives) converted.primitives.push_back(convert(primitive));
  }
  for (const auto& texture : from.textures) {
    GltfTexture& converted = to.textures.emplace_back();
    converted.image = texture.source;
    if (texture.sampler < 0) continue;
    const auto& sampler = from.samplers.at(static_cast<std::size_t>(texture.sampler));
    converted.wrap_u = wrap_of(sampler.wrapS);
    converted.wrap_v = wrap_of(sampler.wrapT);
    converted.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  }
  convert_nodes(from, to);
  to.files.push_back(file);
  to.files.insert(to.files.end(), bytes.files.begin(), bytes.files.end());
  return to;
}

// Each compressed view gets a buffer of its own with what it holds.
void unpack_views(std::vector<std::vector<unsigned char>>&& decoded, GltfModel& model) {
  for (std::size_t i = 0; i < decoded.size(); ++i) {
    if (decoded[i].empty()) continue;
    model.views[i].buffer = static_cast<int>(model.buffers.size());
    model.views[i].offset = 0;
    model.buffers.push_back(std::move(decoded[i]));
  }
}

struct Proved {
  std::vector<std::string> warnings;
  GltfBytes bytes;
  std::vector<std::vector<unsigned char>> decoded;  // of compressed views
};

Proved prove(const nlohmann::json& document, const GltfChunks& chunks, const std::filesystem::path& file) {
  Proved proved;
  proved.warnings = check_gltf_document(document, file, chunks.is_binary);
  const JsonObject root(document, file, "");
  proved.bytes = read_gltf_bytes(root, chunks);
  proved.decoded = decoded_views(root.objects("bufferViews"), proved.bytes.buffers, proved.bytes.bytes_left);
  return proved;
}

// A document whose compressed views are at fault, and that brings their bytes uncompressed as well, is shown
// by those.
Proved prove_or_show_plain(nlohmann::json& document, const GltfChunks& chunks,
                           const std::filesystem::path& file) {
  try {
    return prove(document, chunks, file);
  } catch (const InputError& error) {
    if (!document.is_object() || !use_plain_views(document, chunks.is_binary)) throw;
    try {
      Proved plain = prove(document, chunks, file);
      plain.warnings.push_back(error.problem() + "; the uncompressed form beside it is shown");
      return plain;
    } catch (const InputError&) {
      throw error;  // NOLINT: the first one says what is wrong with the document as it is
    }
  }
}

}  // namespace

GltfModel read_gltf(const std::filesystem::path& file) {
  const std::string content = read_whole_file(file, {kMaxGltfBytes, "split or shrink the model"});
  const GltfChunks chunks = chunks_of(content, file);
  // Everything that tinygltf trusts is proved on the same document first.
  const JsonLimits limits{kMaxGltfBytes, kMaxJsonDepth, kMaxJsonValues};
  nlohmann::json document = parse_json_text(chunks.json, file, 1, limits);
  Proved proved = prove_or_show_plain(document, chunks, file);
  GltfModel model = convert(parse(document, file), file, std::move(proved.bytes));
  unpack_views(std::move(proved.decoded), model);
  read_gltf_materials(document, file, model);
  read_gltf_motion(document, file, model);
  read_gltf_visibility(document, file, model);
  read_gltf_lights(document, file, model);
  read_gpu_instances(document, file, model);
  model.warnings.insert(model.warnings.begin(), proved.warnings.begin(), proved.warnings.end());
  for (std::string& warning : model.warnings) warning = gltf_warning(model, warning);
  return model;
}

}  // namespace herr
