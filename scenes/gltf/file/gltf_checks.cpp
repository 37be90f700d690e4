#include "scenes/gltf/file/gltf_checks.h"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "scenes/gltf/file/gltf_limits.h"
#include "scenes/gltf/format/extension_losses.h"
#include "scenes/gltf/format/known_extensions.h"
#include "scenes/gltf/format/meshopt_views.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr std::int64_t kMaxOffset = 1ll << 40;  // far above any file that is accepted; sums cannot overflow

std::vector<std::string> text_list(const JsonObject& object, const char* key) {
  std::vector<std::string> texts;
  if (!object.has(key)) return texts;
  const nlohmann::json& list = object.value(key);
  if (!list.is_array()) object.fail(key, "is not an array", "write an array of names");
  for (const nlohmann::json& item : list) {
    if (!item.is_string()) object.fail(key, "holds something that is not a name", "write an array of names");
    texts.push_back(item.get_ref<const std::string&>());
  }
  return texts;
}

void check_asset(const JsonObject& root) {
  const JsonObject asset = root.object("asset");
  const std::string version = asset.text("version");
  if (version.rfind("2.", 0) != 0) {
    asset.fail("version", "is \"" + printable(version) + "\"", "export the model as glTF 2.0");
  }
  const std::string lowest = asset.text_or("minVersion", "2.0");
  if (lowest != "2.0") asset.fail("minVersion", "is \"" + printable(lowest) + "\"", "export as glTF 2.0");
}

// Returns what is used and not required.
std::vector<std::string> check_extensions(const JsonObject& root) {
  for (const std::string& name : text_list(root, "extensionsRequired")) {
    if (is_read_extension(name)) continue;
    root.fail("extensionsRequired", "names " + printable(name) + ", which is not supported",
              extension_remedy(printable(name)));
  }
  return text_list(root, "extensionsUsed");
}

void check_uri(const JsonObject& object) {
  if (object.text("uri").empty()) object.fail("uri", "is empty", "name a file or embed the data");
}

void check_buffers(const std::vector<JsonObject>& buffers) {
  for (const JsonObject& buffer : buffers) {
    buffer.integer("byteLength", 1, kMaxExternalBytes);
    if (buffer.has("uri")) check_uri(buffer);
  }
}

// One run of bytes [offset, offset + length) must lie within `available`. All terms are below 2^41.
void check_extent(const JsonObject& object, const char* key, std::int64_t end, std::int64_t available,
                  const std::string& of_what) {
  if (end <= available) return;
  object.fail(
      key,
      "reaches byte " + std::to_string(end) + " of " + of_what + ", which has " + std::to_string(available),
      "export the model again");
}

void check_views(const std::vector<JsonObject>& views, const std::vector<JsonObject>& buffers) {
  const auto last = static_cast<std::int64_t>(buffers.size()) - 1;
  for (const JsonObject& view : views) {
    const std::int64_t buffer = view.integer("buffer", 0, last);
    const std::int64_t offset = view.integer_or("byteOffset", 0, kMaxOffset, 0);
    const std::int64_t length = view.integer("byteLength", 1, kMaxOffset);
    view.integer_or("byteStride", 4, 252, 4);
    check_extent(view, "byteLength", offset + length,
                 buffers[static_cast<std::size_t>(buffer)].integer("byteLength", 1, kMaxExternalBytes),
                 "buffers[" + std::to_string(buffer) + "]");
  }
}

std::int64_t component_bytes(const JsonObject& object, const char* key) {
  switch (object.integer(key, 5120, 5126)) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      object.fail(key, "is not a component type of glTF", "export the model again");
  }
}

// Bytes from one element to the next, and of the last one, which may go without its padding: columns of
// matrices start at multiples of four bytes.
struct ElementSize {
  std::int64_t step, last;
};

ElementSize element_size(const JsonObject& accessor, std::int64_t component) {
  const std::string type = accessor.text("type");
  if (type == "SCALAR") return {component, component};
  const bool matrix = type.rfind("MAT", 0) == 0;
  const bool known =
      type.size() == 4 && (matrix || type.rfind("VEC", 0) == 0) && type[3] >= '2' && type[3] <= '4';
  if (!known) accessor.fail("type", "is \"" + printable(type) + "\"", "use SCALAR, VEC2..4 or MAT2..4");
  const std::int64_t rows = type[3] - '0';
  if (!matrix) return {rows * component, rows * component};
  const std::int64_t column = (rows * component + 3) / 4 * 4;
  return {rows * column, (rows - 1) * column + rows * component};
}

// `count` elements at `offset` of the view that `object` names must lie within that view.
void check_run(const JsonObject& object, const std::vector<JsonObject>& views, std::int64_t count,
               const ElementSize& size, bool may_stride) {
  const std::int64_t index = object.integer("bufferView", 0, static_cast<std::int64_t>(views.size()) - 1);
  const JsonObject& view = views[static_cast<std::size_t>(index)];
  const std::int64_t offset = object.integer_or("byteOffset", 0, kMaxOffset, 0);
  const std::int64_t stride = may_stride ? view.integer_or("byteStride", 4, 252, size.step) : size.step;
  if (stride < size.step) view.fail("byteStride", "is smaller than an element", "export the model again");
  // count <= 32e6 and stride <= 252: far below 2^63.
  check_extent(object, may_stride ? "count" : "bufferView", offset + (count - 1) * stride + size.last,
               view.integer("byteLength", 1, kMaxOffset), "bufferViews[" + std::to_string(index) + "]");
}

void check_accessors(const std::vector<JsonObject>& accessors, const std::vector<JsonObject>& views) {
  for (const JsonObject& accessor : accessors) {
    const std::int64_t count = accessor.integer("count", 1, kMaxElements);
    const ElementSize size = element_size(accessor, component_bytes(accessor, "componentType"));
    accessor.boolean_or("normalized", false);
    if (accessor.has("bufferView")) check_run(accessor, views, count, size, true);
    if (!accessor.has("sparse")) continue;
    const JsonObject sparse = accessor.object("sparse");
    const std::int64_t replaced = sparse.integer("count", 1, count);
    const JsonObject indices = sparse.object("indices");
    const std::int64_t index_size = component_bytes(indices, "componentType");
    check_run(indices, views, replaced, {index_size, index_size}, false);
    check_run(sparse.object("values"), views, replaced, size, false);
  }
}

void check_images(const JsonObject& root, const std::vector<JsonObject>& views) {
  for (const JsonObject& image : root.objects("images")) {
    if (image.has("bufferView")) {
      if (image.has("uri")) image.fail("uri", "stands beside bufferView", "keep one of the two");
      image.integer("bufferView", 0, static_cast<std::int64_t>(views.size()) - 1);
    } else {
      check_uri(image);
    }
  }
}

}  // namespace

std::vector<std::string> check_gltf_document(const nlohmann::json& document,
                                             const std::filesystem::path& file, bool binary) {
  const JsonObject root(document, file, "");
  check_asset(root);
  const std::vector<std::string> used = check_extensions(root);
  const std::vector<JsonObject> buffers = root.objects("buffers");
  const std::vector<JsonObject> views = root.objects("bufferViews");
  check_buffers(buffers);
  check_views(views, buffers);
  check_meshopt_views(buffers, views);
  needed_buffers(buffers, views, binary);
  check_accessors(root.objects("accessors"), views);
  check_images(root, views);
  check_gltf_references(document, file);
  check_gltf_further_references(document, file);
  return extension_losses(document, used);
}

}  // namespace herr
