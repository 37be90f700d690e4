#include "scenes/gltf/file/gpu_instances.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "scenes/gltf/file/accessor_reader.h"
#include "scenes/gltf/file/gltf_limits.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr const char* kInstancingExtension = "EXT_mesh_gpu_instancing";

std::size_t count_of(const GltfModel& model, int accessor) {
  return model.accessors[static_cast<std::size_t>(accessor)].count;
}

}  // namespace

void read_gpu_instances(const nlohmann::json& document, const std::filesystem::path& file, GltfModel& model) {
  const JsonObject root(document, file, "");
  const std::vector<JsonObject> nodes = root.objects("nodes");
  const auto accessors = static_cast<std::int64_t>(model.accessors.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].has("extensions") || !nodes[i].object("extensions").has(kInstancingExtension)) continue;
    const JsonObject attributes =
        nodes[i].object("extensions").object(kInstancingExtension).object("attributes");
    GltfInstancing& instancing = model.nodes[i].instancing;
    std::size_t count = 0;
    const auto read = [&](const char* name, int& accessor) {
      if (!attributes.has(name)) return;
      accessor = static_cast<int>(attributes.integer(name, 0, accessors - 1));
      const std::size_t here = count_of(model, accessor);
      if (count != 0 && count != here) {
        attributes.fail(name, "has another count than the attributes beside it", "export the model again");
      }
      count = here;
      if (static_cast<std::int64_t>(count) > kMaxInstances) {
        attributes.fail(name, "has more than a million instances", "split the model");
      }
    };
    read("TRANSLATION", instancing.translation);
    read("ROTATION", instancing.rotation);
    read("SCALE", instancing.scale);
  }
}

std::vector<glm::dmat4x3> instance_transforms(const GltfModel& model, const GltfNode& node) {
  const GltfInstancing& from = node.instancing;
  const int any = std::max({from.translation, from.rotation, from.scale});
  if (any < 0) return {glm::dmat4x3(1.0)};
  std::vector<glm::dmat4x3> transforms(count_of(model, any), glm::dmat4x3(1.0));
  if (from.rotation >= 0) {
    const std::vector<float> q = read_floats(model, from.rotation, 4);
    for (std::size_t i = 0; i < transforms.size(); ++i) {
      const glm::dquat turn(q[4 * i + 3], q[4 * i], q[4 * i + 1], q[4 * i + 2]);
      if (glm::dot(turn, turn) < 1e-6) {
        throw InputError(model.file, 0,
                         "the rotation of instance " + std::to_string(i) + " of node \"" +
                             printable(node.name) + "\" is a quaternion of length zero",
                         "write a unit quaternion x, y, z, w");
      }
      const glm::dmat3 matrix = glm::mat3_cast(glm::normalize(turn));
      for (int axis = 0; axis < 3; ++axis) transforms[i][axis] = matrix[axis];
    }
  }
  if (from.scale >= 0) {
    const std::vector<float> s = read_floats(model, from.scale, 3);
    for (std::size_t i = 0; i < transforms.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) transforms[i][axis] *= s[3 * i + static_cast<std::size_t>(axis)];
    }
  }
  if (from.translation >= 0) {
    const std::vector<float> t = read_floats(model, from.translation, 3);
    for (std::size_t i = 0; i < transforms.size(); ++i) {
      transforms[i][3] = {t[3 * i], t[3 * i + 1], t[3 * i + 2]};
    }
  }
  return transforms;
}

}  // namespace herr
