#include "renderer/geometry/embree_scene.h"

#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <new>
#include <stdexcept>
#include <string>

#include "scenes/transform_checks.h"

namespace herr {
namespace {

constexpr double kAnchorGrid_m = 16.0;
constexpr double kAnchorReach_m = 24.0;
constexpr double kLargestCoordinate_m = 1e15;  // Embree asserts below 1.8e18; leaves room for rays' ends

const char* embree_isa(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return "avx512";
    case Isa::avx2:
      return "avx2";
    default:
      return "sse4.2";
  }
}

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error("Embree reports error " + std::to_string(static_cast<int>(error)));
}

// A matrix that Embree can take: finite, and no axis collapsed.
void check_transform(const glm::dmat4x3& m, const std::string& name) {
  const glm::dmat3 linear(m[0], m[1], m[2]);
  const double determinant = std::abs(glm::determinant(linear));
  const double reach = glm::length(m[0]) + glm::length(m[1]) + glm::length(m[2]) + glm::length(m[3]);
  const double scale = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
  // scenes/ refuses such transforms with the name of the file; this is the last guard before Embree.
  if (!(reach < kLargestCoordinate_m) || !(determinant >= 1e-18) ||
      !(determinant >= 0.5 * kMinVolumeShare * scale)) {
    throw std::invalid_argument("instance '" + name +
                                "' has a transform that is not finite or not invertible");
  }
}

}  // namespace

EmbreeScene::EmbreeScene(const Scene& scene, Isa isa, int threads) : scene_(scene) {
  for (const MeshInstance& instance : scene.instances)
    check_transform(instance.world_from_object, instance.name);
  const std::string config = "threads=" + std::to_string(threads) + ",isa=" + embree_isa(isa);
  device_ = rtcNewDevice(config.c_str());
  if (!device_) {
    check(nullptr);
    throw std::runtime_error("Embree cannot start with '" + config + "'");
  }
  build_meshes();
  build_instances();
}

EmbreeScene::~EmbreeScene() {
  for (RTCGeometry geometry : instance_geometries_) rtcReleaseGeometry(geometry);
  if (top_) rtcReleaseScene(top_);
  for (RTCScene bottom : bottom_) rtcReleaseScene(bottom);
  if (device_) rtcReleaseDevice(device_);
}

void EmbreeScene::commit(RTCScene scene) const {
  rtcCommitScene(scene);
  check(device_);
}

void EmbreeScene::build_meshes() {
  for (const TriangleMesh& mesh : scene_.meshes) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryMask(geometry, kAllMask);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(glm::vec3), mesh.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(mesh.triangles[0]), mesh.triangles.size());
    check(device_);
    std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
    std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]));
    rtcCommitGeometry(geometry);
    RTCScene bottom = rtcNewScene(device_);
    bottom_.push_back(bottom);
    rtcSetSceneBuildQuality(bottom, RTC_BUILD_QUALITY_HIGH);
    rtcAttachGeometryByID(bottom, geometry, 0);
    rtcReleaseGeometry(geometry);
    commit(bottom);
    baked_.push_back(bake_triangles(mesh));
  }
  for (const TextureImage& texture : scene_.textures) {
    auto& texels = texture_texels_.emplace_back(texture.rgba.size() / 4);
    std::memcpy(texels.data(), texture.rgba.data(), texels.size() * 4);
    textures_.push_back({texels.data(), texture.width_px, texture.height_px, texture.srgb,
                         static_cast<std::uint8_t>(texture.wrap_u),
                         static_cast<std::uint8_t>(texture.wrap_v)});
  }
}

void EmbreeScene::build_instances() {
  top_ = rtcNewScene(device_);
  rtcSetSceneBuildQuality(top_, RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
    const MeshInstance& instance = scene_.instances[i];
    const Material& material = scene_.materials[instance.material];
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, bottom_[instance.mesh]);
    rtcSetGeometryMask(geometry, instance.catcher ? kCatcherMask : kObjectMask);
    rtcAttachGeometryByID(top_, geometry, static_cast<unsigned>(i));
    instance_geometries_.push_back(geometry);

    InstanceRecord record;
    const BakedMesh& baked = baked_[instance.mesh];
    record.triangles = baked.records.data();
    const glm::dmat3 linear(instance.world_from_object[0], instance.world_from_object[1],
                            instance.world_from_object[2]);
    const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(linear));
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        record.normal_from_object[3 * row + column] = static_cast<float>(normal_matrix[column][row]);
      }
    }
    for (int axis = 0; axis < 2; ++axis) {
      record.uv_lower[axis] = baked.uv_lower[axis];
      record.uv_scale[axis] = baked.uv_scale[axis] / 65535.0f;
    }
    for (int channel = 0; channel < 3; ++channel) {
      record.base_colour[channel] = material.base_colour[channel];
      record.emission[channel] = material.emission[channel];
    }
    record.metallic = material.metallic;
    record.roughness = material.roughness;
    record.mirror = material.mirror;
    record.transmission = material.transmission;
    record.refractive_index = material.refractive_index;
    const float f0_root = (material.refractive_index - 1.0f) / (material.refractive_index + 1.0f);
    record.dielectric_f0 = f0_root * f0_root;
    const bool has_uvs = !scene_.meshes[instance.mesh].uvs.empty();
    const auto texture = [&](int index) {
      return index >= 0 && has_uvs ? &textures_[static_cast<std::size_t>(index)] : nullptr;
    };
    record.base_colour_texture = texture(material.base_colour_texture);
    record.metallic_roughness_texture = texture(material.metallic_roughness_texture);
    record.catcher = instance.catcher;
    instances_.push_back(record);
  }
}

void EmbreeScene::place_instances() {
  for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
    glm::dmat4x3 m = scene_.instances[i].world_from_object;
    m[3] -= anchor_;
    float columns[12];
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) columns[3 * column + row] = static_cast<float>(m[column][row]);
    }
    rtcSetGeometryTransform(instance_geometries_[i], 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    rtcCommitGeometry(instance_geometries_[i]);
  }
  commit(top_);
}

int EmbreeScene::follow(const glm::dvec3& head_position) {
  if (placed_ && glm::distance(head_position, anchor_) <= kAnchorReach_m) return 0;
  place_at(glm::round(head_position / kAnchorGrid_m) * kAnchorGrid_m);
  return 1;
}

void EmbreeScene::place_at(const glm::dvec3& anchor) {
  anchor_ = anchor;
  place_instances();
  placed_ = true;
}

}  // namespace herr
