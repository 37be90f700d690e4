// What an environment picture looks like in highlights: made once, before the first frame that needs it.
// Before: Scene::environment_map, the frame plan. After: reflectance/gloss-inl.h and the rays of probes look
// it up. Sources: the levels are the first factor of Karis's split sum ("Real Shading in Unreal Engine 4",
// 2013), bright sources stand apart from them as in Debevec's light probe sampling (2005).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "renderer/environment/picture_pyramid.h"
#include "renderer/tiles/environment_record.h"

namespace herr {

class FilteredEnvironment {
 public:
  // `probe_rays`: rays that each probe sends; 0: no probes. Takes some 0.5 s on two cores for a large
  // picture.
  FilteredEnvironment(const EnvironmentImage& picture, int probe_rays, const ParallelFor& parallel);

  // As kernels read it, the picture turned by `turn` (EnvironmentRecord::turn). Valid as long as this is.
  FilteredRecord record(float turn) const;
  std::int64_t bytes() const;

  // What rays of probes see in a direction of the world: R, G, B without the bright sources, and the mean of
  // what those send, each as wide as what a ray stands for.
  glm::dvec4 seen_by_rays(const glm::dvec3& direction, float turn) const;
  // Light that a surface facing the direction receives, over pi: without the bright sources, and theirs.
  glm::dvec3 even_rest(const glm::dvec3& normal, float turn) const;
  glm::dvec3 even_sources(const glm::dvec3& normal, float turn) const;

 private:
  void filter_levels(const std::vector<SkyPicture>& from, const ParallelFor& parallel);
  FilteredRecord record_;
  std::vector<float> texels_;
  std::vector<BrightDisc> parts_;
  SkyPicture without_small_, even_, even_rest_;
  SkyPicture coarse_,
      coarse_rest_;  // as rays of probes see it: whole; the rest, and the brightness of sources
};

}  // namespace herr
