#include "scenes/gltf/mesh_builder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "scenes/gltf/file/accessor_reader.h"
#include "scenes/gltf/file/gltf_limits.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Triangles of a run of vertex indices. Every second triangle of a strip is turned, so that all face one way.
std::vector<Triangle> triangles_of(const std::vector<std::uint32_t>& run, int mode) {
  std::vector<Triangle> triangles;
  if (run.size() < 3) return triangles;
  if (mode == 4) {
    triangles.reserve(run.size() / 3);
    for (std::size_t i = 0; i + 2 < run.size(); i += 3) triangles.push_back({run[i], run[i + 1], run[i + 2]});
    return triangles;
  }
  triangles.reserve(run.size() - 2);
  for (std::size_t i = 0; i + 2 < run.size(); ++i) {
    if (mode == 6) triangles.push_back({run[i + 1], run[i + 2], run[0]});
    if (mode == 5) triangles.push_back({run[i], run[i + 1 + i % 2], run[i + 2 - i % 2]});
  }
  return triangles;
}

// Numbers the vertices that some triangle uses 0, 1, ... in their old order; returns the old index of each.
std::vector<std::uint32_t> compact(std::vector<Triangle>& triangles, std::size_t vertex_count) {
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> new_index(vertex_count, kUnused);
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) new_index[vertex] = 0;
  }
  std::vector<std::uint32_t> old_index;
  for (std::size_t i = 0; i < vertex_count; ++i) {
    if (new_index[i] == kUnused) continue;
    new_index[i] = static_cast<std::uint32_t>(old_index.size());
    old_index.push_back(static_cast<std::uint32_t>(i));
  }
  for (Triangle& triangle : triangles) {
    for (std::uint32_t& vertex : triangle) vertex = new_index[vertex];
  }
  return old_index;
}

std::vector<float> read_attribute(const GltfModel& model, int accessor, int components, std::size_t count,
                                  const char* name, MeshBudget& budget) {
  if (accessor_of(model, accessor).count != count) {
    throw InputError(model.file, 0,
                     std::string("accessors[") + std::to_string(accessor) + "] has another count as " + name +
                         " than POSITION has",
                     "export the model again");
  }
  spend(budget.decoded_elements, count, model, "vertices");
  return read_floats(model, accessor, components);
}

glm::vec3 cross_of(const TriangleMesh& mesh, const Triangle& triangle) {
  // In double: tiny triangles have cross products that vanish in float.
  const glm::dvec3 a(mesh.positions[triangle[0]]);
  const glm::dvec3 cross =
      glm::cross(glm::dvec3(mesh.positions[triangle[1]]) - a, glm::dvec3(mesh.positions[triangle[2]]) - a);
  const double length = glm::length(cross);
  return length > 0 ? glm::vec3(cross / length) : glm::vec3(0.0f);
}

// Makes every normal unit; those that have no direction take one from a triangle that
// uses them. Returns how many.
std::int64_t repair_normals(TriangleMesh& mesh) {
  std::vector<std::uint8_t> broken(mesh.normals.size(), 0);
  std::int64_t count = 0;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const glm::dvec3 normal(mesh.normals[i]);
    const double length = glm::length(normal);
    broken[i] = length < 1e-6 ? 1 : 0;
    count += broken[i];
    mesh.normals[i] = broken[i] != 0 ? glm::vec3(0, 1, 0) : glm::vec3(normal / length);
  }
  if (count == 0) return 0;
  for (const Triangle& triangle : mesh.triangles) {
    const glm::vec3 face = cross_of(mesh, triangle);
    if (face == glm::vec3(0.0f)) continue;
    for (const std::uint32_t vertex : triangle) {
      if (broken[vertex] != 0) mesh.normals[vertex] = face;
    }
  }
  return count;
}

// Colours of the vertices that are kept, RGB or RGBA; none when all are white.
std::vector<glm::vec4> read_vertex_colours(const GltfModel& model, int accessor, std::size_t count,
                                           const std::vector<std::uint32_t>& old_index, MeshBudget& budget) {
  const int channels = accessor_of(model, accessor).components == 4 ? 4 : 3;
  const auto width = static_cast<std::size_t>(channels);
  const std::vector<float> values = read_attribute(model, accessor, channels, count, "COLOR_0", budget);
  std::vector<glm::vec4> colours;
  colours.reserve(old_index.size());
  bool white = true;
  for (const std::size_t i : old_index) {
    const float* v = &values[width * i];
    const glm::vec4 colour(v[0], v[1], v[2], channels == 4 ? v[3] : 1.0f);
    colours.push_back(glm::clamp(colour, 0.0f, 1.0f));
    white = white && colours.back() == glm::vec4(1.0f);
  }
  if (white) colours.clear();
  return colours;
}

// Tangents of the vertices that are kept: unit, w = 1 or -1. `unusable`: how many have no length or
// lie along their normals.
std::vector<glm::vec4> read_tangents(const GltfModel& model, int accessor, std::size_t count,
                                     const std::vector<std::uint32_t>& old_index,
                                     const std::vector<glm::vec3>& normals, MeshBudget& budget,
                                     std::int64_t& unusable) {
  const std::vector<float> values = read_attribute(model, accessor, 4, count, "TANGENT", budget);
  std::vector<glm::vec4> tangents;
  tangents.reserve(old_index.size());
  for (const std::size_t i : old_index) {
    const glm::dvec3 along(values[4 * i], values[4 * i + 1], values[4 * i + 2]),
        normal(normals[tangents.size()]);
    const double length = glm::length(along);
    const bool usable = length >= 1e-6 && glm::length(glm::cross(normal, along)) >= 1e-3 * length;
    unusable += usable ? 0 : 1;
    tangents.emplace_back(usable ? glm::vec3(along / length) : glm::vec3(0.0f),
                          values[4 * i + 3] < 0 ? -1.0f : 1.0f);
  }
  return tangents;
}

// The run of vertex indices that a primitive draws.
std::vector<std::uint32_t> index_run(const GltfModel& model, const GltfPrimitive& primitive,
                                     std::size_t vertices, MeshBudget& budget) {
  if (primitive.indices >= 0) {
    spend(budget.decoded_elements, accessor_of(model, primitive.indices).count, model, "indices");
    return read_indices(model, primitive.indices, vertices);
  }
  std::vector<std::uint32_t> run(vertices);
  std::iota(run.begin(), run.end(), 0u);
  return run;
}

}  // namespace

// Decoded elements: positions, normals, tangents, uvs, colours and three indices per triangle, each at most
// once per vertex, and half as much again for primitives that share vertex arrays.
MeshBudget::MeshBudget()
    : triangles(kMaxFileTriangles), decoded_elements(6 * kMaxFileVertices + 6 * kMaxFileTriangles) {}

void spend(std::int64_t& budget, std::size_t amount, const GltfModel& model, const char* what) {
  budget -= static_cast<std::int64_t>(amount);
  if (budget < 0)
    throw InputError(model.file, 0, std::string("has too many ") + what, "split or simplify the model");
}

void make_flat(TriangleMesh& mesh) {
  TriangleMesh flat;
  flat.name = mesh.name;
  flat.more_uvs.resize(mesh.more_uvs.size());
  flat.positions.reserve(3 * mesh.triangles.size());
  flat.normals.reserve(3 * mesh.triangles.size());
  flat.triangles.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    const glm::vec3 cross = cross_of(mesh, triangle);
    const glm::vec3 normal = cross == glm::vec3(0.0f) ? glm::vec3(0, 1, 0) : cross;  // degenerate: never hit
    const auto first = static_cast<std::uint32_t>(flat.positions.size());
    for (const std::uint32_t vertex : triangle) {
      flat.positions.push_back(mesh.positions[vertex]);
      flat.normals.push_back(normal);
      if (!mesh.uvs.empty()) flat.uvs.push_back(mesh.uvs[vertex]);
      if (!mesh.colours.empty()) flat.colours.push_back(mesh.colours[vertex]);
      for (std::size_t set = 0; set < mesh.more_uvs.size(); ++set) {
        flat.more_uvs[set].push_back(mesh.more_uvs[set][vertex]);
      }
    }
    flat.triangles.push_back({first, first + 1, first + 2});
  }
  mesh = std::move(flat);
}

BuiltMesh build_mesh(const GltfModel& model, const GltfPrimitive& primitive,
                     const std::vector<UvSource>& sources, bool with_tangents, MeshBudget& budget) {
  BuiltMesh built;
  TriangleMesh& mesh = built.mesh;
  if (primitive.mode < 4) {
    built.warnings.push_back("points and lines are left out");
    return built;
  }
  if (primitive.position < 0) {
    built.warnings.push_back("a primitive without POSITION is left out");
    return built;
  }

  const std::size_t count = accessor_of(model, primitive.position).count;
  mesh.triangles = triangles_of(index_run(model, primitive, count, budget), primitive.mode);
  if (mesh.triangles.empty()) {
    built.warnings.push_back("a primitive with fewer than three vertices is left out");
    return built;
  }
  spend(budget.triangles, mesh.triangles.size(), model, "triangles");

  const std::vector<float> positions =
      read_attribute(model, primitive.position, 3, count, "POSITION", budget);
  const std::vector<std::uint32_t> old_index = compact(mesh.triangles, count);
  mesh.positions.reserve(old_index.size());
  for (const std::size_t i : old_index) {
    mesh.positions.emplace_back(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
  }
  mesh.more_uvs.resize(sources.empty() ? 0 : sources.size() - 1);
  for (std::size_t set = 0; set < sources.size(); ++set) {
    const int accessor = primitive.uv_sets[static_cast<std::size_t>(sources[set].set)];
    const std::vector<float> uvs = read_attribute(model, accessor, 2, count, "TEXCOORD", budget);
    std::vector<glm::vec2>& moved = set == 0 ? mesh.uvs : mesh.more_uvs[set - 1];
    moved.reserve(old_index.size());
    for (const std::size_t i : old_index) moved.push_back(sources[set].apply({uvs[2 * i], uvs[2 * i + 1]}));
  }
  if (primitive.colour >= 0) {
    mesh.colours = read_vertex_colours(model, primitive.colour, count, old_index, budget);
  }
  if (primitive.normal < 0) {
    // As make_flat orders them.
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) built.sources.push_back(old_index[vertex]);
    }
    make_flat(mesh);
    return built;
  }
  built.sources = old_index;
  const std::vector<float> normals = read_attribute(model, primitive.normal, 3, count, "NORMAL", budget);
  mesh.normals.reserve(old_index.size());
  for (const std::size_t i : old_index) {
    mesh.normals.emplace_back(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
  }
  const std::int64_t repaired = repair_normals(mesh);
  if (repaired > 0) {
    built.warnings.push_back(counted(repaired, "normal of length zero is taken from its triangles",
                                     "normals of length zero are taken from their triangles"));
  }
  if (with_tangents && primitive.tangent >= 0) {
    std::int64_t unusable = 0;
    mesh.tangents = read_tangents(model, primitive.tangent, count, old_index, mesh.normals, budget, unusable);
    if (unusable > 0) {
      built.warnings.push_back(counted(unusable, "tangent", "tangents") +
                               " of length zero or along their normals: all are made anew");
      mesh.tangents = {};
    }
  }
  return built;
}

}  // namespace herr
