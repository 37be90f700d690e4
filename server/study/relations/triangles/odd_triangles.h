// Odd triangles among the meshes of a scene, that must not change what is seen of it. Meshes that bend stay
// as they are: their vertices follow a skin. Before: the scene of a relation case. After:
// triangles_relations.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// Meshes that an instance shows which is there, and that nothing bends.
std::vector<std::uint32_t> rigid_meshes(const Scene& scene);
// Those of them that no instance shows with a surface that blends: two layers cover more than one.
std::vector<std::uint32_t> solid_meshes(const Scene& scene);

// Each triangle of solid meshes a second time.
void add_duplicates(Scene& scene);
// Of no area, in each rigid mesh: on points, on lines, 1e-30 long, and reaching 1e6 times the mesh's own size
// away.
void add_triangles_without_area(Scene& scene);
// Into each triangle of rigid meshes a vertex very near an edge or a corner: two or one of the three parts
// are needles. The surface stays: normals and the like are interpolated as shading does. These stay whole:
// triangles so small that float coordinates would tilt a needle by more than 1/1024, and those with normals
// on two sides of an axis plane, which shading does not interpolate along straight lines. Beyond a million
// triangles one of several is divided.
void divide_into_needles(Scene& scene);
// One triangle in a rigid mesh that only one instance shows (a copy, where several do), from `from` to 1e8 m
// along `away`, a unit vector; `width` wide at its near end along `across`. All in the world.
struct FarTriangle {
  glm::dvec3 from{0.0}, away{0.0}, across{0.0};
  double width_m = 0;
};
void add_far_corner(Scene& scene, const FarTriangle& triangle);

// A level square of two triangles of matte grey about `middle`, turned so that no edge follows an axis.
void add_floor(Scene& scene, const glm::dvec3& middle, double half_width_m);

}  // namespace herr
