#include "scenes/gltf/file/gltf_bytes.h"

#include <cstring>
#include <string>
#include <utility>

#include "scenes/gltf/format/meshopt_views.h"
#include "scenes/gltf/format/uri_text.h"
#include "sessions/files/contained_folder.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::size_t kHeader = 12, kChunkHeader = 8;

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;  // little-endian, as is every machine that Embree runs on
  std::memcpy(&word, bytes.data() + offset, sizeof(word));
  return word;
}

// Files have the name that the URI stands for; writers that escape nothing mean the URI as it is written.
std::vector<unsigned char> read_file_of(const std::string& uri, const JsonObject& owner, GltfBytes& bytes) {
  std::string name = percent_decoded(uri);
  std::vector<unsigned char> data;
  try {
    data = read_named_file(owner.file(), name, bytes.bytes_left);
  } catch (const InputError&) {
    if (name == uri) throw;
    try {
      data = read_named_file(owner.file(), uri, bytes.bytes_left);
      name = uri;
    } catch (const InputError&) {
      data.clear();  // the first name is the one to complain of
    }
    if (data.empty()) throw;
  }
  bytes.bytes_left -= static_cast<std::int64_t>(data.size());
  bytes.files.insert(owner.file().parent_path() / name);
  return data;
}

std::vector<unsigned char> read_data_uri(const std::string& uri, const JsonObject& owner) {
  UriData data = data_of_uri(uri);
  if (data.problem != nullptr)
    owner.fail("uri", std::string("embeds data that cannot be read: it ") + data.problem,
               "export the model again");
  return std::move(data.bytes);
}

std::vector<unsigned char> read_buffer(const JsonObject& buffer, const GltfChunks& chunks, GltfBytes& bytes) {
  const auto wanted = static_cast<std::size_t>(buffer.integer("byteLength", 1, kMaxExternalBytes));
  std::vector<unsigned char> data;
  std::size_t found = 0;
  if (!buffer.has("uri")) {
    if (chunks.binary.empty())
      buffer.fail("uri", "is missing, and the file has no binary chunk", "export the model again");
    found = chunks.binary.size();
    const std::string_view first = chunks.binary.substr(0, wanted);
    data.assign(first.begin(), first.end());
  } else {
    const std::string uri = buffer.text("uri");
    data = is_data_uri(uri) ? read_data_uri(uri, buffer) : read_file_of(uri, buffer, bytes);
    found = data.size();
  }
  if (found < wanted) {
    buffer.fail("byteLength",
                "is " + std::to_string(wanted) + ", and its data have " + std::to_string(found) + " bytes",
                "export or copy the model again");
  }
  data.resize(wanted);
  return data;
}

GltfImage read_image(const JsonObject& image, GltfBytes& bytes) {
  GltfImage to;
  to.name = image.text_or("name", "");
  if (image.has("bufferView")) {
    to.view = static_cast<int>(image.integer("bufferView", 0, kMaxElements));
    return to;
  }
  const std::string uri = image.text("uri");
  if (!is_data_uri(uri)) {
    if (to.name.empty()) to.name = uri;
    to.encoded = read_file_of(uri, image, bytes);
    return to;
  }
  try {
    to.encoded = read_data_uri(uri, image);
  } catch (const InputError&) {
    to.failure = std::current_exception();
  }
  return to;
}

}  // namespace

GltfChunks chunks_of(std::string_view bytes, const std::filesystem::path& file) {
  if (!bytes.starts_with("glTF")) return {false, bytes, {}};
  const auto broken = [&](const std::string& problem) {
    return InputError(file, 0, "is not a valid binary glTF: " + problem, "export or copy the model again");
  };
  if (bytes.size() < kHeader + kChunkHeader) throw broken("it ends within its header");
  if (word_at(bytes, 4) != 2) throw broken("its container version is not 2");
  if (word_at(bytes, 8) > bytes.size()) throw broken("it was cut off");
  bytes = bytes.substr(0, word_at(bytes, 8));
  if (bytes.size() < kHeader + kChunkHeader) throw broken("it says that it ends within its header");
  if (word_at(bytes, 16) != kJsonChunk) throw broken("its first chunk is not JSON");
  GltfChunks chunks{true, {}, {}};
  const std::size_t length = word_at(bytes, kHeader);
  std::string_view rest = bytes.substr(kHeader + kChunkHeader);
  if (length > rest.size()) throw broken("its JSON chunk is longer than the file");
  chunks.json = rest.substr(0, length);
  rest.remove_prefix(length);
  if (rest.empty()) return chunks;
  if (rest.size() < kChunkHeader) throw broken("it ends within the header of its second chunk");
  // Chunks of other kinds are for other readers.
  if (word_at(rest, 4) != kBinaryChunk) return chunks;
  const std::size_t held = word_at(rest, 0);
  rest.remove_prefix(kChunkHeader);
  if (held > rest.size()) throw broken("its binary chunk is longer than the file");
  chunks.binary = rest.substr(0, held);
  return chunks;
}

GltfBytes read_gltf_bytes(const JsonObject& root, const GltfChunks& chunks) {
  GltfBytes bytes;
  const std::vector<JsonObject> buffers = root.objects("buffers");
  const std::vector<bool> needed = needed_buffers(buffers, root.objects("bufferViews"), chunks.is_binary);
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    bytes.buffers.emplace_back();
    if (needed[i]) bytes.buffers.back() = read_buffer(buffers[i], chunks, bytes);
  }
  for (const JsonObject& image : root.objects("images")) bytes.images.push_back(read_image(image, bytes));
  return bytes;
}

}  // namespace herr
