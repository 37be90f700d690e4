#include "renderer/probes/probe_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace herr {
namespace {

constexpr double kThinnestShare = 1.0 / 16.0;  // of the longest edge
constexpr double kPointExtent_m = 1e-3;  // of a scene that is a single point, and so has no length of its own

// The cells of a grid along one axis: one before the first probe, those between two, one after the last. Cell
// i ends at probe i. In the outer ones look-ups take the outermost probes alone.
int cells_along(int probes) {
  return probes + 1;
}

// The bits of x, two zeros between each two: x < 2^16.
std::uint64_t spread_bits(int x) {
  std::uint64_t spread = 0;
  for (unsigned bit = 0; bit < 16; ++bit) {
    spread |= (static_cast<std::uint64_t>(x) >> bit & 1) << (3 * bit);
  }
  return spread;
}

// Marks the cells that a triangle may reach into: those of its bounding box that its plane cuts.
class CellMarks {
 public:
  explicit CellMarks(const ProbeGrid& grid) : grid_(grid) {
    for (int axis = 0; axis < 3; ++axis) cells_[axis] = cells_along(grid.counts[axis]);
    marked_.assign(static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) *
                       static_cast<std::size_t>(cells_.z),
                   false);
  }

  void add(const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 lower = glm::min(corners[0], glm::min(corners[1], corners[2])),
                     upper = glm::max(corners[0], glm::max(corners[1], corners[2]));
    glm::ivec3 first, last;
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = cell_of(lower[axis] - kSlack * grid_.spacing[axis], axis);
      last[axis] = cell_of(upper[axis] + kSlack * grid_.spacing[axis], axis);
    }
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double reach = (0.5 + kSlack) * glm::dot(glm::abs(normal), grid_.spacing);
    for (int z = first.z; z <= last.z; ++z) {
      for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
          const glm::dvec3 middle = glm::dvec3{x, y, z} * grid_.spacing;
          const bool outer = is_outer({x, y, z});
          if (!outer && std::abs(glm::dot(normal, middle - corners[0])) > reach) continue;
          marked_[index(x, y, z)] = true;
        }
      }
    }
  }

  // Every cell that a box reaches into; corners relative to the grid.
  void add_box(const glm::dvec3& lower, const glm::dvec3& upper) {
    glm::ivec3 first, last;
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = cell_of(lower[axis] - kSlack * grid_.spacing[axis], axis);
      last[axis] = cell_of(upper[axis] + kSlack * grid_.spacing[axis], axis);
    }
    for (int z = first.z; z <= last.z; ++z) {
      for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) marked_[index(x, y, z)] = true;
      }
    }
  }

  // Is one of the cells that have this probe at a corner marked?
  bool any_around(const glm::ivec3& probe) const {
    for (int corner = 0; corner < 8; ++corner) {
      if (marked_[index(probe.x + (corner & 1), probe.y + (corner >> 1 & 1), probe.z + (corner >> 2))])
        return true;
    }
    return false;
  }

 private:
  static constexpr double kSlack = 1e-3;  // of a cell: look-ups round in float

  int cell_of(double x, int axis) const {
    const double cell = std::floor(x / grid_.spacing[axis] + 0.5);
    return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(cells_[axis] - 1)));
  }
  // Outer cells go on beyond the grid: the plane test of a cell of one spacing does not hold there.
  bool is_outer(const glm::ivec3& cell) const {
    return glm::any(glm::equal(cell, glm::ivec3{0})) || glm::any(glm::equal(cell, cells_ - 1));
  }
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_.y) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(cells_.x) +
           static_cast<std::size_t>(x);
  }

  const ProbeGrid& grid_;
  glm::ivec3 cells_{1};
  std::vector<bool> marked_;
};

}  // namespace

ProbeGrid grid_over(const Bounds& box, const glm::ivec3& counts) {
  ProbeGrid grid;
  grid.counts = counts;
  glm::dvec3 extent = box.upper - box.lower;
  const glm::dvec3 middle = 0.5 * (box.lower + box.upper);
  double longest = std::max({extent.x, extent.y, extent.z});
  if (!(longest > 0)) longest = kPointExtent_m;
  extent = glm::max(extent, glm::dvec3{kThinnestShare * longest});
  grid.lower = middle - 0.5 * extent;
  grid.spacing = extent / glm::dvec3(counts);
  return grid;
}

std::array<int, 3> probe_counts_at(const std::array<int, 3>& counts, double density) {
  std::array<int, 3> scaled{};
  for (;; density *= 0.99) {
    std::int64_t product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scaled[axis] = std::max(1, static_cast<int>(std::lround(counts[axis] * density)));
      product *= scaled[axis];
    }
    if (product <= kMostProbes) return scaled;
  }
}

ProbeGrid probe_grid_of(const Scene& scene, double density) {
  const std::array<int, 3> n = probe_counts_at(scene.probes.counts, density);
  return grid_over(scene.probes.box ? *scene.probes.box : scene_bounds(scene), {n[0], n[1], n[2]});
}

std::vector<std::int32_t> neighbour_order(const ProbeGrid& grid) {
  std::vector<std::pair<std::uint64_t, std::int32_t>> codes;
  for (int i = 0; i < grid.size(); ++i) {
    const glm::ivec3 at = grid.place(i);
    codes.emplace_back(spread_bits(at.x) | spread_bits(at.y) << 1 | spread_bits(at.z) << 2, i);
  }
  std::sort(codes.begin(), codes.end());
  std::vector<std::int32_t> order;
  for (const auto& [code, probe] : codes) order.push_back(probe);
  return order;
}

std::vector<bool> probes_near_geometry(const ProbeGrid& grid, const Scene& scene) {
  // What moves may come anywhere.
  if (scene.changes) return std::vector<bool>(static_cast<std::size_t>(grid.size()), true);
  CellMarks marks(grid);
  std::vector<glm::dvec3> positions;
  for (const Instance& instance : scene.instances) {
    if (instance.kind != ShapeKind::mesh) {
      const Bounds box = instance_bounds(scene, instance);
      marks.add_box(box.lower - grid.lower, box.upper - grid.lower);
      continue;
    }
    const TriangleMesh& mesh = scene.meshes[instance.mesh];
    positions.clear();
    for (const glm::vec3& p : mesh.positions) {
      positions.push_back(glm::dvec3(instance.world_from_object * glm::dvec4(glm::dvec3(p), 1.0)) -
                          grid.lower);
    }
    for (const auto& t : mesh.triangles) marks.add({positions[t[0]], positions[t[1]], positions[t[2]]});
  }
  std::vector<bool> near(static_cast<std::size_t>(grid.size()));
  for (int i = 0; i < grid.size(); ++i) near[static_cast<std::size_t>(i)] = marks.any_around(grid.place(i));
  return near;
}

}  // namespace herr
