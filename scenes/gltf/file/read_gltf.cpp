#include "scenes/gltf/file/read_gltf.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "scenes/gltf/file/gltf_checks.h"
#include "scenes/gltf/file/gltf_lights.h"
#include "scenes/gltf/file/gltf_limits.h"
#include "scenes/gltf/file/gltf_materials.h"
#include "scenes/gltf/file/gltf_motion.h"
#include "scenes/gltf/file/gpu_instances.h"
#include "sessions/files/contained_folder.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/files/strict_json.h"

namespace herr {

std::string gltf_warning(const GltfModel& model, const std::string& text) {
  return printable(model.file.string()) + ": " + text;
}

namespace {

// What tinygltf's callbacks share: the glTF file, what is left of the byte budget, and why a read failed.
struct Reading {
  explicit Reading(const std::filesystem::path& file) : gltf_file(file) {}
  std::filesystem::path gltf_file;
  std::int64_t bytes_left = kMaxExternalBytes;
  std::set<std::filesystem::path> files;
  std::vector<std::exception_ptr>
      failures;  // one for each file that could not be read, in the order of the document
};

// tinygltf asks for existence in several folders; the first must be the answer, so that
// reading reports the reason.
bool file_exists(const std::string&, void*) {
  return true;
}

std::string keep_path(const std::string& path, void*) {
  return path;
}

bool read_external(std::vector<unsigned char>* out, std::string* error, const std::string& path, void* user) {
  auto& reading = *static_cast<Reading*>(user);
  // An exception must not cross tinygltf, which holds no guards: it is kept and thrown again afterwards.
  try {
    if (path.rfind("data:", 0) == 0) {
      throw InputError(reading.gltf_file, 0, "embeds data as " + printable(path.substr(0, path.find(','))),
                       "embed it as data:application/octet-stream;base64 or "
                       "data:image/png;base64");
    }
    *out = read_named_file(reading.gltf_file, path, reading.bytes_left);
    reading.bytes_left -= static_cast<std::int64_t>(out->size());
    reading.files.insert(reading.gltf_file.parent_path() / path);
    return true;
  } catch (const std::exception& failure) {
    reading.failures.push_back(std::current_exception());
    if (error != nullptr) *error = failure.what();
    return false;
  }
}

bool refuse_to_write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

// Keeps the encoded bytes; images in buffer views are found there again, so they are not copied.
bool keep_encoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

bool is_binary(std::string_view bytes) {
  return bytes.starts_with("glTF");
}

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;  // little-endian, as is every machine that Embree runs on
  std::memcpy(&word, bytes.data() + offset, sizeof(word));
  return word;
}

// The JSON text of a file: all of a .gltf, the first chunk of a .glb.
std::string_view json_text(std::string_view bytes, const std::filesystem::path& file) {
  if (!is_binary(bytes)) return bytes;
  const auto broken = [&](const std::string& problem) {
    return InputError(file, 0, "is not a valid binary glTF: " + problem, "export or copy the model again");
  };
  if (bytes.size() < 20) throw broken("it ends within its header");
  if (word_at(bytes, 4) != 2) throw broken("its container version is not 2");
  if (word_at(bytes, 8) > bytes.size()) throw broken("it was cut off");
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
  if (word_at(bytes, 16) != kJsonChunk) throw broken("its first chunk is not JSON");
  const std::size_t length = word_at(bytes, 12);
  if (length > bytes.size() - 20) throw broken("its JSON chunk is longer than the file");
  return bytes.substr(20, length);
}

tinygltf::Model parse(std::string_view bytes, const std::filesystem::path& file, Reading& reading) {
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({file_exists, keep_path, read_external, refuse_to_write, &reading});
  parser.SetImageLoader(keep_encoded, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned int>(bytes.size());  // <= kMaxGltfBytes
  const bool ok =
      is_binary(bytes)
          ? parser.LoadBinaryFromMemory(&model, &error, &warning,
                                        reinterpret_cast<const unsigned char*>(bytes.data()), size, "")
          : parser.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
  // Buffers are required, so tinygltf stops at the one that could not be read; images go on without.
  if (!ok && !reading.failures.empty() && error.find("File read error") != std::string::npos) {
    std::rethrow_exception(reading.failures.back());
  }
  if (!ok) throw InputError(file, 0, "is not a valid glTF: " + printable(error), "export the model again");
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

void convert_images(tinygltf::Model& from, const Reading& reading, GltfModel& to) {
  // Images were read in order, and each that failed left one failure: the next one belongs to the next image
  // without bytes. Data in an unusual form is complained of only where a material uses the image; a file that
  // is not there, always.
  auto failure = reading.failures.begin();
  for (auto& image : from.images) {
    GltfImage converted{
        image.name.empty() ? image.uri : image.name, image.bufferView, std::move(image.image), {}};
    if (converted.view < 0 && converted.encoded.empty() && failure != reading.failures.end()) {
      converted.failure = *failure++;
      if (image.uri.rfind("data:", 0) != 0) std::rethrow_exception(converted.failure);
    }
    to.images.push_back(std::move(converted));
  }
}

GltfModel convert(tinygltf::Model&& from, const std::filesystem::path& file, const Reading& reading) {
  GltfModel to;
  to.file = file;
  for (auto& buffer : from.buffers) to.buffers.push_back(std::move(buffer.data));
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
  convert_images(from, reading, to);
  convert_nodes(from, to);
  to.files.push_back(file);
  to.files.insert(to.files.end(), reading.files.begin(), reading.files.end());
  return to;
}

}  // namespace

GltfModel read_gltf(const std::filesystem::path& file) {
  const std::string bytes = read_whole_file(file, {kMaxGltfBytes, "split or shrink the model"});
  // Everything that tinygltf trusts is proved on the same bytes first.
  const JsonLimits limits{kMaxGltfBytes, kMaxJsonDepth, kMaxJsonValues};
  const nlohmann::json document = parse_json_text(json_text(bytes, file), file, 1, limits);
  std::vector<std::string> warnings = check_gltf_document(document, file, is_binary(bytes));

  Reading reading(file);
  GltfModel model = convert(parse(bytes, file, reading), file, reading);
  read_gltf_materials(document, file, model);
  read_gltf_motion(document, file, model);
  read_gltf_lights(document, file, model);
  read_gpu_instances(document, file, model);
  model.warnings.insert(model.warnings.begin(), warnings.begin(), warnings.end());
  for (std::string& warning : model.warnings) warning = gltf_warning(model, warning);
  return model;
}

}  // namespace herr
