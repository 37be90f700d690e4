#include "renderer/geometry/deformed_mesh.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/memory_use.h"

namespace herr {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// Four lanes on every machine: the same bits everywhere.
using Four = hn::FixedTag<float, 4>;
using V = hn::Vec<Four>;
constexpr Four kFour;

constexpr std::size_t kChunk = 4096;  // vertices or triangles of a job: some tens of microseconds
constexpr std::size_t kGroup = 32;    // triangles whose common box stands for a node of the tree
constexpr std::size_t kEvery = 8;     // groups of which one is measured

int jobs_for(std::size_t count) {
  return static_cast<int>((count + kChunk - 1) / kChunk);
}

// Bits of a 10-bit number, two zeros between each.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

double half_area(const glm::vec3& extent) {
  const glm::dvec3 e(extent);
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

V cross(V a, V b) {
  // (y, z, x, w) of both: Shuffle0132... spelled with two rotations of the first three lanes.
  alignas(16) float p[4], q[4], r[4];
  hn::Store(a, kFour, p);
  hn::Store(b, kFour, q);
  r[0] = p[1] * q[2] - p[2] * q[1];
  r[1] = p[2] * q[0] - p[0] * q[2];
  r[2] = p[0] * q[1] - p[1] * q[0];
  r[3] = 0;
  return hn::Load(kFour, r);
}

float dot3(V a, V b) {
  alignas(16) float p[4];
  hn::Store(hn::Mul(a, b), kFour, p);
  return p[0] + p[1] + p[2];
}

}  // namespace

DeformedMesh::DeformedMesh(const TriangleMesh& mesh, const MeshDeformation& deformation, MeshGeometry& built)
    : mesh_(mesh),
      deformation_(deformation),
      built_(built),
      normals_(mesh.positions.size()),
      tangents_(deformation.rest_tangents.size()),
      directions_(deformation.flat_normals ? 0 : mesh.positions.size()),
      handedness_(deformation.rest_tangents.size()) {
  rtcSetSceneFlags(built.scene.get(), RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(built.scene.get(), RTC_BUILD_QUALITY_LOW);
  geometry_ = rtcGetGeometry(built.scene.get(), 0);
  rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_REFIT);
  vertices_ = static_cast<float*>(rtcGetGeometryBufferData(geometry_, RTC_BUFFER_TYPE_VERTEX, 0));
  rtcCommitGeometry(geometry_);
  built.scene.commit();
  order_.resize(mesh.triangles.size());
  choose_groups();
}

bool DeformedMesh::bend(const DeformationPose& pose, RenderThreads& threads) {
  if (pose.version == version_) return false;
  version_ = pose.version;
  joints_.resize(pose.joints.size());
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t row = 0; row < 3; ++row)
        joints_[j].columns[column][row] = pose.joints[j][3 * column + row];
      joints_[j].columns[column][3] = 0;
    }
  }
  const std::size_t vertices = mesh_.positions.size(), triangles = mesh_.triangles.size();
  const auto bend_chunk = [&](int job, int) {
    const std::size_t first = static_cast<std::size_t>(job) * kChunk;
    bend_vertices(pose, first, std::min(first + kChunk, vertices));
  };
  threads.run(jobs_for(vertices), std::cref(bend_chunk));
  const auto bake_chunk = [&](int job, int) {
    const std::size_t first = static_cast<std::size_t>(job) * kChunk,
                      last = std::min(first + kChunk, triangles);
    if (deformation_.flat_normals) flatten_normals(first, last);
    bake(first, last);
  };
  threads.run(jobs_for(triangles), std::cref(bake_chunk));
  return true;
}

void DeformedMesh::bend_vertices(const DeformationPose& pose, std::size_t first, std::size_t last) {
  const auto width = static_cast<std::size_t>(deformation_.influences);
  for (std::size_t i = first; i < last; ++i) {
    glm::vec3 position = deformation_.rest_positions[i], normal = deformation_.rest_normals[i];
    const bool has_tangent = !tangents_.empty();
    glm::vec3 tangent = has_tangent ? glm::vec3(deformation_.rest_tangents[i]) : glm::vec3(0.0f);
    float side = 1.0f;  // -1: mirrored
    for (std::size_t t = 0; t < deformation_.targets.size(); ++t) {
      if (pose.weights[t] == 0) continue;
      const MorphTarget& target = deformation_.targets[t];
      if (!target.positions.empty()) position += pose.weights[t] * target.positions[i];
      if (!target.normals.empty()) normal += pose.weights[t] * target.normals[i];
      if (!target.tangents.empty()) tangent += pose.weights[t] * target.tangents[i];
    }
    if (deformation_.skin >= 0) {
      V x = hn::Zero(kFour), y = x, z = x, shift = x;
      for (std::size_t k = 0; k < width; ++k) {
        const float weight = deformation_.weights[width * i + k];
        if (weight == 0) continue;
        const Joint& joint = joints_[deformation_.joints[width * i + k]];
        const V w = hn::Set(kFour, weight);
        x = hn::MulAdd(w, hn::Load(kFour, joint.columns[0]), x);
        y = hn::MulAdd(w, hn::Load(kFour, joint.columns[1]), y);
        z = hn::MulAdd(w, hn::Load(kFour, joint.columns[2]), z);
        shift = hn::MulAdd(w, hn::Load(kFour, joint.columns[3]), shift);
      }
      const V moved = hn::MulAdd(
          x, hn::Set(kFour, position.x),
          hn::MulAdd(y, hn::Set(kFour, position.y), hn::MulAdd(z, hn::Set(kFour, position.z), shift)));
      alignas(16) float p[4];
      hn::Store(moved, kFour, p);
      position = {p[0], p[1], p[2]};
      // The inverse transpose up to a factor: cofactors exist where the inverse does not.
      const V cx = cross(y, z), cy = cross(z, x), cz = cross(x, y);
      const V turned =
          hn::MulAdd(cx, hn::Set(kFour, normal.x),
                     hn::MulAdd(cy, hn::Set(kFour, normal.y), hn::Mul(cz, hn::Set(kFour, normal.z))));
      hn::Store(turned, kFour, p);
      side = dot3(x, cx) < 0 ? -1.0f : 1.0f;
      normal = side * glm::vec3(p[0], p[1], p[2]);
      if (has_tangent) {
        const V along =
            hn::MulAdd(x, hn::Set(kFour, tangent.x),
                       hn::MulAdd(y, hn::Set(kFour, tangent.y), hn::Mul(z, hn::Set(kFour, tangent.z))));
        hn::Store(along, kFour, p);
        tangent = {p[0], p[1], p[2]};
      }
    }
    vertices_[3 * i] = position.x;
    vertices_[3 * i + 1] = position.y;
    vertices_[3 * i + 2] = position.z;
    if (has_tangent) {
      const glm::vec4& rest = deformation_.rest_tangents[i];
      if (!(glm::dot(tangent, tangent) > 0)) tangent = glm::vec3(rest);
      // A flat normal is not turned back: it is its tangent that turns.
      const bool flat = deformation_.flat_normals;
      tangents_[i] = encode_octahedral(flat ? side * tangent : tangent);
      handedness_[i] = flat ? rest.w : side * rest.w;
    }
    if (deformation_.flat_normals) continue;
    const float length2 = glm::dot(normal, normal);
    directions_[i] = length2 > 0 ? normal / std::sqrt(length2) : deformation_.rest_normals[i];
    normals_[i] = encode_octahedral(length2 > 0 ? normal : directions_[i]);
  }
}

void DeformedMesh::flatten_normals(std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) {
    const auto corner = [&](std::size_t k) {
      const float* v = vertices_ + 3 * std::size_t{mesh_.triangles[t][k]};
      return glm::vec3(v[0], v[1], v[2]);
    };
    const glm::vec3 a = corner(0), normal = glm::cross(corner(1) - a, corner(2) - a);
    const bool vanished = !(glm::dot(normal, normal) > 0);
    for (const std::uint32_t vertex : mesh_.triangles[t])
      normals_[vertex] = encode_octahedral(vanished ? deformation_.rest_normals[vertex] : normal);
  }
}

void DeformedMesh::bake(std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) {
    std::array<glm::vec3, 3> places, directions{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh_.triangles[t][corner];
      built_.baked.records[t].normal[corner] = normals_[vertex];
      const float* v = vertices_ + 3 * std::size_t{vertex};
      places[corner] = {v[0], v[1], v[2]};
      if (!directions_.empty()) directions[corner] = directions_[vertex];
    }
    built_.baked.records[t].curvature_and_rounding =
        curvature_and_rounding(shading_curvature(places, directions), most_rounded_length(places));
    if (tangents_.empty()) continue;
    TangentRecord& record = built_.baked.tangents[t];
    for (std::size_t corner = 0; corner < 3; ++corner)
      record.tangent[corner] = tangents_[mesh_.triangles[t][corner]];
    const auto& corners = mesh_.triangles[t];
    record.handedness =
        common_handedness(handedness_[corners[0]], handedness_[corners[1]], handedness_[corners[2]]);
  }
}

bool DeformedMesh::commit() {
  const bool anew = spread() > kWorstGrowth * spread_when_built_;
  if (anew) rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_LOW);
  rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(geometry_);
  built_.scene.commit();
  if (!anew) return false;
  // The next commits refit again.
  rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_REFIT);
  choose_groups();
  return true;
}

// Sorts triangles along a curve through space, as the tree does, and keeps every eighth run of neighbours.
void DeformedMesh::choose_groups() {
  glm::vec3 lower(1e30f), upper(-1e30f);
  for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
    const glm::vec3 p(vertices_[3 * i], vertices_[3 * i + 1], vertices_[3 * i + 2]);
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  const glm::vec3 scale = 1023.0f / glm::max(upper - lower, glm::vec3(1e-20f));
  for (std::size_t t = 0; t < order_.size(); ++t) {
    const float* v = vertices_ + 3 * std::size_t{mesh_.triangles[t][0]};
    const glm::vec3 cell = glm::clamp((glm::vec3(v[0], v[1], v[2]) - lower) * scale, 0.0f, 1023.0f);
    const std::uint64_t code = spread_bits(static_cast<std::uint32_t>(cell.x)) |
                               spread_bits(static_cast<std::uint32_t>(cell.y)) << 1 |
                               spread_bits(static_cast<std::uint32_t>(cell.z)) << 2;
    order_[t] = code << 32 | t;
  }
  std::sort(order_.begin(), order_.end());
  sampled_.clear();
  for (std::size_t group = 0; group * kGroup < order_.size(); group += kEvery) {
    const std::size_t end = std::min((group + 1) * kGroup, order_.size());
    for (std::size_t i = group * kGroup; i < end; ++i)
      sampled_.push_back(static_cast<std::uint32_t>(order_[i] & 0xffffffffu));
  }
  spread_when_built_ = spread();
}

double DeformedMesh::spread() const {
  glm::vec3 lowest(1e30f), highest(-1e30f);
  double sum = 0;
  for (std::size_t i = 0; i < sampled_.size(); i += kGroup) {
    glm::vec3 lower(1e30f), upper(-1e30f);
    for (std::size_t k = i; k < std::min(i + kGroup, sampled_.size()); ++k) {
      for (const std::uint32_t vertex : mesh_.triangles[sampled_[k]]) {
        const float* v = vertices_ + 3 * std::size_t{vertex};
        const glm::vec3 p(v[0], v[1], v[2]);
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
      }
    }
    sum += half_area(upper - lower);
    lowest = glm::min(lowest, lower);
    highest = glm::max(highest, upper);
  }
  const double whole = half_area(highest - lowest);
  return whole > 0 ? sum / whole : 0;
}

std::int64_t DeformedMesh::bytes() const {
  return bytes_of(joints_) + bytes_of(normals_) + bytes_of(directions_) + bytes_of(tangents_) +
         bytes_of(handedness_) + bytes_of(sampled_) + bytes_of(order_);
}

}  // namespace herr
