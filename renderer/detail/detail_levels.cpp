#include "renderer/detail/detail_levels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>

namespace herr {
namespace {

bool has_choice(const Scene& scene, const Instance& instance) {
  return instance.kind == ShapeKind::mesh && !scene.meshes[instance.mesh].coarser.empty();
}

// The largest stretch of a matrix, from above: the square root of the largest row sum of |M^T M|, which it
// is exactly where the columns are orthogonal.
double largest_stretch(const glm::dmat4x3& m) {
  const glm::dmat3 linear(m[0], m[1], m[2]);
  const glm::dmat3 gram = glm::transpose(linear) * linear;
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    largest = std::max(largest, std::abs(gram[i].x) + std::abs(gram[i].y) + std::abs(gram[i].z));
  }
  return std::sqrt(largest);
}

DetailBall ball_of(const TriangleMesh& mesh) {
  glm::vec3 lower = mesh.positions.front(), upper = lower;
  for (const glm::vec3& p : mesh.positions) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  const glm::dvec3 centre = 0.5 * (glm::dvec3(lower) + glm::dvec3(upper));
  DetailBall ball;
  ball.centre = centre;
  for (const glm::vec3& p : mesh.positions) {
    ball.radius_m = std::max(ball.radius_m, glm::distance(glm::dvec3(p), centre));
  }
  return ball;
}

}  // namespace

std::size_t detailed_instances(const Scene& scene) {
  return static_cast<std::size_t>(std::count_if(scene.instances.begin(), scene.instances.end(),
                                                [&](const Instance& i) { return has_choice(scene, i); }));
}

DetailLevels::DetailLevels(const Scene& scene) : scene_(scene) {
  measure();
}

void DetailLevels::measure() {
  items_.clear();
  for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
    const Instance& instance = scene_.instances[i];
    if (!has_choice(scene_, instance)) continue;
    const TriangleMesh& mesh = scene_.meshes[instance.mesh];
    Item item{i, ball_of(mesh), {}, 0};
    for (const CoarserMesh& form : mesh.coarser) item.errors_m.push_back(form.error_m);
    items_.push_back(std::move(item));
  }
}

DetailBall DetailLevels::placed(const DetailBall& ball, const glm::dmat4x3& world_from_object) {
  const double scale = largest_stretch(world_from_object);
  return {world_from_object * glm::dvec4(ball.centre, 1.0), scale * ball.radius_m, scale};
}

std::uint32_t DetailLevels::mesh_of(const Item& item) const {
  const std::uint32_t full = scene_.instances[item.instance].mesh;
  if (item.level == 0) return full;
  return scene_.meshes[full].coarser[static_cast<std::size_t>(item.level) - 1].mesh;
}

std::vector<std::byte> DetailLevels::save() const {
  std::vector<std::byte> levels;
  for (const Item& item : items_) levels.push_back(static_cast<std::byte>(item.level));
  return levels;
}

void DetailLevels::set_levels(std::span<const std::byte> levels) {
  bool fits = levels.size() == items_.size();
  for (std::size_t i = 0; fits && i < items_.size(); ++i) {
    fits = static_cast<std::size_t>(levels[i]) <= items_[i].errors_m.size();
  }
  if (!fits) throw std::invalid_argument("the state has detail levels of another scene");
  for (std::size_t i = 0; i < items_.size(); ++i) items_[i].level = static_cast<int>(levels[i]);
}

}  // namespace herr
