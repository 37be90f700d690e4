#include "server/frames/warnings/lamp_warnings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInside = 0.9;  // of winding numbers, which are whole for closed meshes

bool holds(const Bounds& box, const glm::dvec3& p) {
  return p.x >= box.lower.x && p.y >= box.lower.y && p.z >= box.lower.z && p.x <= box.upper.x &&
         p.y <= box.upper.y && p.z <= box.upper.z;
}

// Half the solid angle of a triangle seen from the origin, positive where its front faces away from it.
double half_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return std::atan2(glm::dot(a, glm::cross(b, c)), below);
}

double winding_number(const TriangleMesh& mesh, const glm::dmat4x3& world_from_object,
                      const glm::dvec3& point) {
  std::vector<glm::dvec3> corners;
  corners.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions)
    corners.push_back(world_from_object * glm::dvec4(glm::dvec3(p), 1.0) - point);
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += half_solid_angle(corners[a], corners[b], corners[c]);
  const bool mirrored = glm::determinant(glm::dmat3(world_from_object)) < 0;
  return (mirrored ? -sum : sum) / (2 * kPi);
}

bool is_inside(const Scene& scene, const Instance& instance, const glm::dvec3& point) {
  if (instance.kind == ShapeKind::mesh)
    return winding_number(scene.meshes[instance.mesh], instance.world_from_object, point) > kInside;
  const glm::dvec3 p =
      glm::inverse(glm::dmat3(instance.world_from_object)) * (point - instance.world_from_object[3]);
  if (instance.kind == ShapeKind::sphere) return glm::length(p) < 1;
  if (instance.kind == ShapeKind::box) return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1;
  const VoxelGrid& grid = scene.voxel_grids[instance.grid];
  const glm::ivec3 voxel(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
                         static_cast<int>(std::floor(p.z)));
  for (int axis = 0; axis < 3; ++axis)
    if (voxel[axis] < 0 || voxel[axis] >= grid.counts[axis]) return false;
  return grid.at(voxel) != 0;
}

bool is_opaque(const Material& material) {
  return material.transmission == 0 && material.transmission_texture.texture < 0 &&
         material.alpha_mode == AlphaMode::opaque;
}

class Enclosures {
 public:
  explicit Enclosures(const Scene& scene) : scene_(scene) {
    for (const Instance& instance : scene.instances) boxes_.push_back(instance_bounds(scene, instance));
  }

  // The instance that hides a lamp there; null: none.
  const Instance* around(const glm::dvec3& centre, bool is_virtual) const {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const Instance& instance = scene_.instances[i];
      if (!instance.present || (instance.catcher && !is_virtual) || !holds(boxes_[i], centre)) continue;
      if (!is_opaque(scene_.materials[instance.material])) continue;
      if (is_inside(scene_, instance, centre) && !is_room(i)) return &instance;
    }
    return nullptr;
  }

 private:
  bool is_room(std::size_t index) const {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const glm::dvec3 middle = 0.5 * (boxes_[i].lower + boxes_[i].upper);
      if (i != index && scene_.instances[i].present && holds(boxes_[index], middle) &&
          is_inside(scene_, scene_.instances[index], middle))
        return true;
    }
    return false;
  }

  const Scene& scene_;
  std::vector<Bounds> boxes_;  // per instance
};

std::string quoted(const std::string& name) {
  return name.empty() ? "" : " \"" + printable(name) + "\"";
}

std::string and_more(int others) {
  return others == 0 ? ""
                     : " (and " + std::to_string(others) + (others == 1 ? " more lamp)" : " more lamps)");
}

bool is_set_later(const Scene& scene, const AreaLight& light) {
  return std::any_of(scene.timeline.begin(), scene.timeline.end(), [&](const SceneChange& change) {
    return change.kind == ChangeKind::set_light && change.name == light.name;
  });
}

std::string dark_lamps(const Scene& scene) {
  const AreaLight* first = nullptr;
  int others = 0;
  for (const AreaLight& light : scene.lights) {
    if (light.intensity_w_sr != glm::vec3(0.0f) || is_set_later(scene, light)) continue;
    if (first == nullptr)
      first = &light;
    else
      ++others;
  }
  if (first == nullptr) return {};
  return "light" + quoted(first->name) + and_more(others) + " has intensity 0 and lights nothing" +
         (scene.changes ? " until an event sets it" : "") + "; write " +
         (first->kind == LightKind::sun ? "\"irradiance_w_m2\": [3, 3, 3]"
                                        : "\"intensity_w_sr\": [12, 12, 12]") +
         ", or leave it out";
}

std::string enclosed_lamps(const Scene& scene) {
  SceneState state;
  scene_state_at(scene, 0, state);
  const Enclosures enclosures(scene);
  std::string text;
  int others = 0;
  for (const AreaLight& light : state.lights) {
    if (light.kind == LightKind::sun) continue;
    const Instance* around = enclosures.around(light.centre, light.is_virtual);
    if (around == nullptr) continue;
    if (!text.empty()) {
      ++others;
      continue;
    }
    text = "light" + quoted(light.name) + " stands inside" + quoted(around->name) +
           ", which is opaque and hides its light; move its \"centre\" out of it";
  }
  return text.empty() ? text : text + and_more(others);
}

}  // namespace

std::vector<std::string> lamp_warnings(const Scene& scene) {
  std::vector<std::string> lines;
  for (std::string& line : std::vector<std::string>{dark_lamps(scene), enclosed_lamps(scene)})
    if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace herr
