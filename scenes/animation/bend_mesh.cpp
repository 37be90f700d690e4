#include "scenes/animation/bend_mesh.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace herr {
namespace {

glm::mat3 linear_part(const std::array<float, 12>& m) {
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
}

}  // namespace

void bend_mesh(const MeshDeformation& deformation, const DeformationPose& pose, TriangleMesh& mesh) {
  mesh.positions = deformation.rest_positions;
  mesh.normals = deformation.rest_normals;
  mesh.tangents = deformation.rest_tangents;
  const auto width = static_cast<std::size_t>(deformation.influences);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    glm::vec3 position = mesh.positions[i], normal = mesh.normals[i], tangent{0.0f};
    if (!mesh.tangents.empty()) tangent = glm::vec3(mesh.tangents[i]);
    float side = 1.0f;  // -1: mirrored
    for (std::size_t t = 0; t < deformation.targets.size(); ++t) {
      const MorphTarget& target = deformation.targets[t];
      if (!target.positions.empty()) position += pose.weights[t] * target.positions[i];
      if (!target.normals.empty()) normal += pose.weights[t] * target.normals[i];
      if (!target.tangents.empty()) tangent += pose.weights[t] * target.tangents[i];
    }
    if (deformation.skin >= 0) {
      glm::mat3 blend{0.0f};
      glm::vec3 shift{0.0f};
      for (std::size_t k = 0; k < width; ++k) {
        const float weight = deformation.weights[width * i + k];
        const std::array<float, 12>& joint = pose.joints[deformation.joints[width * i + k]];
        blend += weight * linear_part(joint);
        shift += weight * glm::vec3(joint[9], joint[10], joint[11]);
      }
      position = blend * position + shift;
      tangent = blend * tangent;
      // The inverse transpose up to a factor: cofactors exist where the inverse does not.
      const glm::mat3 cofactors(glm::cross(blend[1], blend[2]), glm::cross(blend[2], blend[0]),
                                glm::cross(blend[0], blend[1]));
      side = glm::dot(blend[0], cofactors[0]) < 0 ? -1.0f : 1.0f;
      normal = side * (cofactors * normal);
    }
    mesh.positions[i] = position;
    const float length2 = glm::dot(normal, normal);
    if (length2 > 0) mesh.normals[i] = normal / std::sqrt(length2);
    if (mesh.tangents.empty()) continue;
    glm::vec4& bent = mesh.tangents[i];
    const float tangent2 = glm::dot(tangent, tangent);
    if (tangent2 > 0) bent = glm::vec4(tangent / std::sqrt(tangent2), bent.w);
    // A flat normal is not turned back: it is its tangent that turns.
    bent *= deformation.flat_normals ? glm::vec4(side, side, side, 1) : glm::vec4(1, 1, 1, side);
  }
  if (!deformation.flat_normals) return;
  for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
    const glm::vec3 a = mesh.positions[i];
    const glm::vec3 cross = glm::cross(mesh.positions[i + 1] - a, mesh.positions[i + 2] - a);
    const float length2 = glm::dot(cross, cross);
    if (!(length2 > 0)) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) mesh.normals[i + corner] = cross / std::sqrt(length2);
  }
}

}  // namespace herr
