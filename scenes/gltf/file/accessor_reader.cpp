#include "scenes/gltf/file/accessor_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "scenes/model/transform_checks.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

[[noreturn]] void fail(const GltfModel& model, int accessor, const std::string& problem) {
  throw InputError(model.file, 0, "accessors[" + std::to_string(accessor) + "] " + problem,
                   "export the model again");
}

std::size_t component_bytes(int type) {
  if (type == kByte || type == kUByte) return 1;
  return type == kShort || type == kUShort ? 2 : 4;
}

// Data need not be aligned in memory, so values are copied out.
template <class Value>
Value load(const unsigned char* bytes) {
  Value value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

std::uint32_t load_unsigned(const unsigned char* bytes, int type) {
  if (type == kUByte) return *bytes;
  if (type == kUShort) return load<std::uint16_t>(bytes);
  return load<std::uint32_t>(bytes);
}

// Normalised integers as the specification defines them: signed ones are clamped so that both ends reach 1.
float load_float(const unsigned char* bytes, int type, bool normalised) {
  switch (type) {
    case kByte: {
      const auto value = static_cast<float>(load<std::int8_t>(bytes));
      return normalised ? std::max(value / 127.0f, -1.0f) : value;
    }
    case kUByte:
      return static_cast<float>(*bytes) / (normalised ? 255.0f : 1.0f);
    case kShort: {
      const auto value = static_cast<float>(load<std::int16_t>(bytes));
      return normalised ? std::max(value / 32767.0f, -1.0f) : value;
    }
    case kUShort:
      return static_cast<float>(load<std::uint16_t>(bytes)) / (normalised ? 65535.0f : 1.0f);
    case kUInt:
      return static_cast<float>(load<std::uint32_t>(bytes));
    default:
      return load<float>(bytes);
  }
}

const unsigned char* view_bytes(const GltfModel& model, int view) {
  const GltfBufferView& from = model.views[static_cast<std::size_t>(view)];
  return model.buffers[static_cast<std::size_t>(from.buffer)].data() + from.offset;
}

// Calls visit(element, bytes) for each stored element: the dense ones first, then the sparse replacements.
template <class Visit>
void for_each_element(const GltfModel& model, int index, const Visit& visit) {
  const GltfAccessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const std::size_t size =
      component_bytes(accessor.component_type) * static_cast<std::size_t>(accessor.components);
  if (accessor.view >= 0) {
    const std::size_t stride = model.views[static_cast<std::size_t>(accessor.view)].stride;
    const unsigned char* bytes = view_bytes(model, accessor.view) + accessor.offset;
    for (std::size_t i = 0; i < accessor.count; ++i) visit(i, bytes + i * (stride != 0 ? stride : size));
  }
  if (accessor.sparse_count == 0) return;
  const unsigned char* indices = view_bytes(model, accessor.sparse_index_view) + accessor.sparse_index_offset;
  const unsigned char* values = view_bytes(model, accessor.sparse_value_view) + accessor.sparse_value_offset;
  const std::size_t index_size = component_bytes(accessor.sparse_index_type);
  for (std::size_t i = 0; i < accessor.sparse_count; ++i) {
    const std::uint32_t element = load_unsigned(indices + i * index_size, accessor.sparse_index_type);
    if (element >= accessor.count) fail(model, index, "has a sparse index past its end");
    visit(element, values + i * size);
  }
}

}  // namespace

std::vector<float> read_floats(const GltfModel& model, int index, int components) {
  const GltfAccessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (accessor.components != components) {
    fail(model, index,
         "has " + std::to_string(accessor.components) + " components per element, not " +
             std::to_string(components));
  }
  const auto width = static_cast<std::size_t>(components);
  const std::size_t step = component_bytes(accessor.component_type);
  std::vector<float> values(accessor.count * width, 0.0f);
  for_each_element(model, index, [&](std::size_t element, const unsigned char* bytes) {
    for (std::size_t c = 0; c < width; ++c) {
      const float value = load_float(bytes + c * step, accessor.component_type, accessor.normalised);
      // Written so that NaN fails as well.
      if (!(std::abs(value) <= static_cast<float>(kFarthest_m))) {
        fail(model, index,
             "holds a value that is not finite or too large, in element " + std::to_string(element));
      }
      values[element * width + c] = value;
    }
  });
  return values;
}

std::vector<std::uint32_t> read_indices(const GltfModel& model, int index, std::size_t vertex_count) {
  const GltfAccessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const int type = accessor.component_type;
  if (accessor.components != 1 || (type != kUByte && type != kUShort && type != kUInt)) {
    fail(model, index, "is used for indices but does not hold unsigned integers");
  }
  std::vector<std::uint32_t> values(accessor.count, 0);
  for_each_element(model, index, [&](std::size_t element, const unsigned char* bytes) {
    const std::uint32_t value = load_unsigned(bytes, type);
    if (value >= vertex_count) {
      fail(model, index,
           "names vertex " + std::to_string(value) + " of " + std::to_string(vertex_count) + ", in element " +
               std::to_string(element));
    }
    values[element] = value;
  });
  return values;
}

}  // namespace herr
