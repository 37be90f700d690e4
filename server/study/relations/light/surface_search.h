// The first surface along a ray through a scene, without Embree: for relations that put a light beside what
// is seen. All instances are opaque, catchers as well. Before: Scene. After: light_near.cpp.
#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// A ray in some space; its parameter is the distance in the world.
struct SearchRay {
  glm::dvec3 origin, direction;
};

struct SeenSpot {
  double distance_m = std::numeric_limits<double>::infinity();
  glm::dvec3 place{0}, normal{0};  // the normal looks to where the ray is from
  bool shaded_as_it_lies = true;   // normals at corners lie within some 45 degrees of the triangle's
};

class SurfaceSearch {
 public:
  explicit SurfaceSearch(const Scene& scene);  // which must outlive it

  std::optional<SeenSpot> first_along(const SearchRay& ray) const;
  // Whether nothing lies between a spot and a place above it.
  bool is_open(const SeenSpot& spot, const glm::dvec3& place) const;

 private:
  const Scene& scene_;
  std::vector<Bounds> boxes_;  // of instances, in the world
};

}  // namespace herr
