#include "scenes/model/scene_memory.h"

namespace herr {
namespace {

template <typename T>
std::int64_t room_of(const std::vector<T>& items) {
  return static_cast<std::int64_t>(items.capacity() * sizeof(T));
}

std::int64_t mesh_bytes(const TriangleMesh& mesh) {
  std::int64_t sum = room_of(mesh.positions) + room_of(mesh.normals) + room_of(mesh.uvs) +
                     room_of(mesh.more_uvs) + room_of(mesh.tangents) + room_of(mesh.colours) +
                     room_of(mesh.triangles) + room_of(mesh.coarser);
  for (const auto& uvs : mesh.more_uvs) sum += room_of(uvs);
  return sum;
}

std::int64_t deformation_bytes(const MeshDeformation& bends) {
  std::int64_t sum = room_of(bends.rest_positions) + room_of(bends.rest_normals) +
                     room_of(bends.rest_tangents) + room_of(bends.joints) + room_of(bends.weights) +
                     room_of(bends.targets);
  for (const MorphTarget& target : bends.targets) {
    sum += room_of(target.positions) + room_of(target.normals) + room_of(target.tangents);
  }
  return sum;
}

std::int64_t model_bytes(const AnimatedModel& model) {
  std::int64_t sum =
      room_of(model.nodes) + room_of(model.order) + room_of(model.clips) + room_of(model.skins);
  for (const ModelNode& node : model.nodes) sum += room_of(node.weights);
  for (const ModelSkin& skin : model.skins) sum += room_of(skin.joints) + room_of(skin.joint_from_mesh);
  for (const AnimationClip& clip : model.clips) {
    sum += room_of(clip.channels);
    for (const AnimationChannel& channel : clip.channels) {
      sum += room_of(channel.times_s) + room_of(channel.values);
    }
  }
  return sum;
}

}  // namespace

SceneMemory memory_of(const Scene& scene) {
  SceneMemory memory;
  memory.meshes = room_of(scene.meshes) + room_of(scene.deformations);
  for (const TriangleMesh& mesh : scene.meshes) memory.meshes += mesh_bytes(mesh);
  for (const MeshDeformation& bends : scene.deformations) memory.meshes += deformation_bytes(bends);
  memory.textures = room_of(scene.textures);
  for (const TextureImage& texture : scene.textures) memory.textures += room_of(texture.rgba);
  memory.voxels = room_of(scene.voxel_grids);
  for (const VoxelGrid& grid : scene.voxel_grids)
    memory.voxels += room_of(grid.brick_of) + room_of(grid.bricks);
  memory.environment = room_of(scene.environment_map.rgba);
  memory.objects = room_of(scene.instances) + room_of(scene.materials) + room_of(scene.lights) +
                   room_of(scene.objects) + room_of(scene.models) + room_of(scene.timeline);
  for (const PlacedObject& object : scene.objects) memory.objects += room_of(object.path.keys);
  for (const AnimatedModel& model : scene.models) memory.objects += model_bytes(model);
  return memory;
}

}  // namespace herr
