#include "scenes/samples/generator/shapes/surface_nets.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace herr::samples {

namespace {

constexpr std::uint32_t kNoVertex = 0xffffffffu;

struct Lattice {
  glm::ivec3 cells{0};
  glm::vec3 lower{0.0f};
  float cell_m = 0.0f;
  std::vector<float> values;  // at the corners

  std::size_t corner(const glm::ivec3& c) const {
    const auto row = static_cast<std::size_t>(cells.x) + 1, column = static_cast<std::size_t>(cells.y) + 1;
    return (static_cast<std::size_t>(c.z) * column + static_cast<std::size_t>(c.y)) * row +
           static_cast<std::size_t>(c.x);
  }
  glm::vec3 position(const glm::ivec3& c) const { return lower + cell_m * glm::vec3(c); }
};

Lattice sample(const DistanceField& field, const NetBounds& bounds) {
  Lattice lattice;
  lattice.cells = glm::ivec3(glm::ceil((bounds.upper - bounds.lower) / bounds.cell_m));
  lattice.lower = bounds.lower;
  lattice.cell_m = bounds.cell_m;
  lattice.values.resize(lattice.corner(lattice.cells) + 1);
  for (int z = 0; z <= lattice.cells.z; ++z) {
    for (int y = 0; y <= lattice.cells.y; ++y) {
      for (int x = 0; x <= lattice.cells.x; ++x) {
        lattice.values[lattice.corner({x, y, z})] = field(lattice.position({x, y, z}));
      }
    }
  }
  return lattice;
}

glm::vec3 gradient(const DistanceField& field, const glm::vec3& p, float step) {
  const glm::vec3 x(step, 0, 0), y(0, step, 0), z(0, 0, step);
  return glm::vec3(field(p + x) - field(p - x), field(p + y) - field(p - y), field(p + z) - field(p - z)) /
         (2.0f * step);
}

// Mean of the points where the surface crosses the cell's edges; false when it crosses none.
bool crossing_mean(const Lattice& lattice, const glm::ivec3& cell, glm::vec3& mean) {
  glm::vec3 sum(0.0f);
  int crossings = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int edge = 0; edge < 4; ++edge) {
      glm::ivec3 from = cell;
      from[(axis + 1) % 3] += edge & 1;
      from[(axis + 2) % 3] += edge >> 1;
      glm::ivec3 to = from;
      to[axis] += 1;
      const float a = lattice.values[lattice.corner(from)], b = lattice.values[lattice.corner(to)];
      if ((a < 0.0f) == (b < 0.0f)) continue;
      sum += glm::mix(lattice.position(from), lattice.position(to), a / (a - b));
      ++crossings;
    }
  }
  if (crossings == 0) return false;
  mean = sum / static_cast<float>(crossings);
  return true;
}

Vertex surface_vertex(const DistanceField& field, const NetBounds& bounds, glm::vec3 p) {
  const float step = 0.25f * bounds.cell_m;
  const glm::vec3 start = p;
  for (int iteration = 0; iteration < 3; ++iteration) {
    const glm::vec3 slope = gradient(field, p, step);
    const float slope2 = glm::dot(slope, slope);
    if (slope2 < 1e-4f) break;
    p -= field(p) / slope2 * slope;
  }
  // Newton may jump across a crease: then the net's own vertex is the better one.
  if (!(glm::distance(p, start) < bounds.cell_m)) p = start;
  const glm::vec3 slope = gradient(field, p, step);
  const float length = glm::length(slope);
  const glm::vec3 normal = length > 1e-6f ? slope / length : glm::vec3(0.0f, 1.0f, 0.0f);
  // Projected along a slant: no seam, and the sides do not repeat the front.
  const glm::vec3 share = (p - bounds.lower) / (bounds.upper - bounds.lower);
  return {p, normal, {glm::mix(share.x, share.z, 0.35f), 1.0f - share.y}};
}

void add_quad(Mesh& mesh, std::array<std::uint32_t, 4> q, bool flip) {
  if (flip) std::swap(q[1], q[3]);
  // Split along the shorter diagonal.
  if (glm::distance(mesh.positions[q[0]], mesh.positions[q[2]]) <
      glm::distance(mesh.positions[q[1]], mesh.positions[q[3]])) {
    add_triangle(mesh, q[0], q[1], q[2]);
    add_triangle(mesh, q[0], q[2], q[3]);
  } else {
    add_triangle(mesh, q[1], q[2], q[3]);
    add_triangle(mesh, q[1], q[3], q[0]);
  }
}

// One quad for each lattice edge that the surface crosses, between the four cells around the edge.
void connect(Mesh& mesh, const Lattice& lattice, const std::vector<std::uint32_t>& vertex_of) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 next(0), last(0);
    next[(axis + 1) % 3] = 1;
    last[(axis + 2) % 3] = 1;
    for (int z = last.z + next.z; z < lattice.cells.z; ++z) {
      for (int y = last.y + next.y; y < lattice.cells.y; ++y) {
        for (int x = last.x + next.x; x < lattice.cells.x; ++x) {
          const glm::ivec3 from(x, y, z);
          glm::ivec3 to = from;
          to[axis] += 1;
          const bool inside = lattice.values[lattice.corner(from)] < 0.0f;
          if (inside == (lattice.values[lattice.corner(to)] < 0.0f)) continue;
          add_quad(mesh,
                   {vertex_of[lattice.corner(from - next - last)], vertex_of[lattice.corner(from - last)],
                    vertex_of[lattice.corner(from)], vertex_of[lattice.corner(from - next)]},
                   !inside);
        }
      }
    }
  }
}

}  // namespace

Mesh surface_nets(const DistanceField& field, const NetBounds& bounds) {
  const Lattice lattice = sample(field, bounds);
  Mesh mesh;
  std::vector<std::uint32_t> vertex_of(lattice.values.size(), kNoVertex);
  for (int z = 0; z < lattice.cells.z; ++z) {
    for (int y = 0; y < lattice.cells.y; ++y) {
      for (int x = 0; x < lattice.cells.x; ++x) {
        glm::vec3 mean;
        if (!crossing_mean(lattice, {x, y, z}, mean)) continue;
        vertex_of[lattice.corner({x, y, z})] = add_vertex(mesh, surface_vertex(field, bounds, mean));
      }
    }
  }
  connect(mesh, lattice, vertex_of);
  return mesh;
}

}  // namespace herr::samples
