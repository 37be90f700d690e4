#include "scenes/gltf/format/meshopt_views.h"

#include <meshoptimizer.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "scenes/gltf/format/known_extensions.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";
constexpr const char* kLaterExtension = "KHR_meshopt_compression";
constexpr std::int64_t kFarthestByte = 1ll << 40;  // as of plain views: sums cannot overflow
constexpr std::int64_t kMostElements = 1ll << 30;

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

struct MeshoptView {
  std::size_t buffer = 0, offset = 0, length = 0;  // of the stream
  std::size_t stride = 0, count = 0;               // of what it holds
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
};

std::optional<JsonObject> extension_of(const JsonObject& object, const char* name) {
  if (!object.has("extensions")) return std::nullopt;
  const JsonObject extensions = object.object("extensions");
  if (!extensions.has(name)) return std::nullopt;
  return extensions.object(name);
}

MeshoptMode mode_of(const JsonObject& from) {
  const std::string mode = from.text("mode");
  if (mode == "ATTRIBUTES") return MeshoptMode::attributes;
  if (mode == "TRIANGLES") return MeshoptMode::triangles;
  if (mode == "INDICES") return MeshoptMode::indices;
  from.fail("mode", "is \"" + printable(mode) + "\"", "write ATTRIBUTES, TRIANGLES or INDICES");
}

MeshoptFilter filter_of(const JsonObject& from) {
  const std::string filter = from.text_or("filter", "NONE");
  if (filter == "NONE") return MeshoptFilter::none;
  if (filter == "OCTAHEDRAL") return MeshoptFilter::octahedral;
  if (filter == "QUATERNION") return MeshoptFilter::quaternion;
  if (filter == "EXPONENTIAL") return MeshoptFilter::exponential;
  from.fail("filter", "is \"" + printable(filter) + "\"",
            "write NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
}

// Which strides the mode and the filter can have.
void check_stride(const JsonObject& from, const MeshoptView& view) {
  const std::size_t stride = view.stride;
  const auto need = [&](bool right, const char* words) {
    if (!right)
      from.fail("byteStride", "is " + std::to_string(stride) + ", not " + words, "pack the model again");
  };
  if (view.mode != MeshoptMode::attributes) {
    need(stride == 2 || stride == 4, "2 or 4, as indices have it");
    if (view.filter != MeshoptFilter::none)
      from.fail("filter", "stands beside indices", "remove it, or pack the model again");
    return;
  }
  need(stride % 4 == 0, "a multiple of 4");
  if (view.filter == MeshoptFilter::octahedral)
    need(stride == 4 || stride == 8, "4 or 8, as octahedral vectors have it");
  if (view.filter == MeshoptFilter::quaternion) need(stride == 8, "8, as quaternions have it");
}

MeshoptView read_view(const JsonObject& from, std::int64_t buffers) {
  MeshoptView view;
  view.buffer = static_cast<std::size_t>(from.integer("buffer", 0, buffers - 1));
  view.offset = static_cast<std::size_t>(from.integer_or("byteOffset", 0, kFarthestByte, 0));
  view.length = static_cast<std::size_t>(from.integer("byteLength", 1, kFarthestByte));
  view.stride = static_cast<std::size_t>(from.integer("byteStride", 1, 256));
  view.count = static_cast<std::size_t>(from.integer("count", 1, kMostElements));
  view.mode = mode_of(from);
  view.filter = filter_of(from);
  check_stride(from, view);
  if (view.mode == MeshoptMode::triangles && view.count % 3 != 0)
    from.fail("count", "is " + std::to_string(view.count) + ", not a multiple of 3", "pack the model again");
  return view;
}

void check_against_parent(const JsonObject& parent, const JsonObject& from, const MeshoptView& view) {
  const auto stride = static_cast<std::int64_t>(view.stride);
  if (parent.integer_or("byteStride", 4, 252, stride) != stride)
    parent.fail("byteStride", "is not that of " + std::string(kMeshoptExtension), "pack the model again");
  const std::int64_t length = parent.integer("byteLength", 1, kFarthestByte);
  if (length == static_cast<std::int64_t>(view.count * view.stride)) return;
  from.fail("count",
            "is " + std::to_string(view.count) + " elements of " + std::to_string(view.stride) +
                " bytes, and its view has " + std::to_string(length) + " bytes",
            "pack the model again");
}

// No stream that holds the view is shorter, so that a small file cannot ask for much memory: two bits for
// each byte of 16 elements, one byte for each triangle, one for each index.
std::size_t least_stream_bytes(const MeshoptView& view) {
  if (view.mode == MeshoptMode::attributes) return view.count * view.stride / 64;
  return view.mode == MeshoptMode::triangles ? view.count / 3 : view.count;
}

int decode(const MeshoptView& view, const unsigned char* stream, std::vector<unsigned char>& out) {
  switch (view.mode) {
    case MeshoptMode::triangles:
      return meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, stream, view.length);
    case MeshoptMode::indices:
      return meshopt_decodeIndexSequence(out.data(), view.count, view.stride, stream, view.length);
    case MeshoptMode::attributes:
      break;
  }
  return meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, stream, view.length);
}

void apply_filter(const MeshoptView& view, std::vector<unsigned char>& out) {
  switch (view.filter) {
    case MeshoptFilter::none:
      break;
    case MeshoptFilter::octahedral:
      meshopt_decodeFilterOct(out.data(), view.count, view.stride);
      break;
    case MeshoptFilter::quaternion:
      meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
      break;
    case MeshoptFilter::exponential:
      meshopt_decodeFilterExp(out.data(), view.count, view.stride);
      break;
  }
}

}  // namespace

void check_meshopt_views(const std::vector<JsonObject>& buffers, const std::vector<JsonObject>& views) {
  for (const JsonObject& parent : views) {
    const auto from = extension_of(parent, kMeshoptExtension);
    if (!from) continue;
    const MeshoptView view = read_view(*from, static_cast<std::int64_t>(buffers.size()));
    const std::int64_t available = buffers[view.buffer].integer("byteLength", 1, kFarthestByte);
    const auto end = static_cast<std::int64_t>(view.offset + view.length);
    if (end > available) {
      from->fail("byteLength",
                 "reaches byte " + std::to_string(end) + " of buffers[" + std::to_string(view.buffer) +
                     "], which has " + std::to_string(available),
                 "pack the model again");
    }
    check_against_parent(parent, *from, view);
  }
}

bool use_plain_views(nlohmann::json& document, bool binary) {
  if (requires_extension(document, kMeshoptExtension)) return false;
  const auto views = document.find("bufferViews"), buffers = document.find("buffers");
  if (views == document.end() || buffers == document.end() || !buffers->is_array()) return false;
  bool any = false;
  for (nlohmann::json& view : *views) {
    if (!view.is_object() || !view.contains("extensions") || !view["extensions"].is_object()) continue;
    if (!view["extensions"].contains(kMeshoptExtension)) continue;
    if (!view.contains("buffer") || !view["buffer"].is_number_unsigned()) continue;
    const auto own = view["buffer"].get<std::size_t>();
    const bool holds_bytes = own < buffers->size() && (*buffers)[own].is_object() &&
                             ((*buffers)[own].contains("uri") || (binary && own == 0));
    if (holds_bytes) any = view["extensions"].erase(kMeshoptExtension) > 0 || any;
  }
  return any;
}

std::vector<bool> needed_buffers(const std::vector<JsonObject>& buffers, const std::vector<JsonObject>& views,
                                 bool binary) {
  const auto last = static_cast<std::int64_t>(buffers.size()) - 1;
  std::vector<bool> read(buffers.size()), stands_in(buffers.size());
  for (const JsonObject& view : views) {
    const auto packed = extension_of(view, kMeshoptExtension);
    const auto own = static_cast<std::size_t>(view.integer("buffer", 0, last));
    if (packed) {
      stands_in[own] = true;
      read[static_cast<std::size_t>(packed->integer("buffer", 0, last))] = true;
    } else {
      read[own] = true;
    }
  }
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    // Only the first buffer of a .glb is its own binary chunk.
    if (buffers[i].has("uri") || (binary && i == 0)) {
      read[i] = read[i] || !stands_in[i];
    } else if (read[i] || !stands_in[i]) {
      const bool later = extension_of(buffers[i], kLaterExtension).has_value();
      buffers[i].fail(
          "uri", later ? std::string("is missing: its data are packed by ") + kLaterExtension : "is missing",
          later ? extension_remedy(kLaterExtension) : "name the file that holds the buffer");
    }
  }
  return read;
}

std::vector<std::vector<unsigned char>> decoded_views(const std::vector<JsonObject>& views,
                                                      const std::vector<std::vector<unsigned char>>& buffers,
                                                      std::int64_t bytes_left) {
  std::vector<std::vector<unsigned char>> decoded(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto from = extension_of(views[i], kMeshoptExtension);
    if (!from) continue;
    const MeshoptView view = read_view(*from, static_cast<std::int64_t>(buffers.size()));
    bytes_left -= static_cast<std::int64_t>(view.count * view.stride);
    if (bytes_left < 0) {
      from->fail("count", "makes the unpacked buffers larger than a model may be",
                 "split or shrink the model");
    }
    const bool whole = view.length >= least_stream_bytes(view);
    if (whole) decoded[i].resize(view.count * view.stride);
    if (!whole || decode(view, buffers[view.buffer].data() + view.offset, decoded[i]) != 0)
      from->fail(nullptr, "is damaged: its stream cannot be decoded", "copy or pack the model again");
    apply_filter(view, decoded[i]);
  }
  return decoded;
}

}  // namespace herr
