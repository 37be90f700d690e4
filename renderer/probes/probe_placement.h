// Where the probes of a volume really stand, which of them can ever matter, and how far each sees: worked out
// once, when the renderer is built, with the scene as it is then.
// Before: EmbreeScene has the geometry in place. After: frames gather light; probe_motion looks again where
// something moved.
#pragma once

#include <optional>
#include <vector>

#include "renderer/geometry/embree_scene.h"
#include "renderer/probes/probe_distances.h"
#include "renderer/probes/probe_volume.h"
#include "renderer/threads/render_threads.h"

namespace herr {

// Metres from the grid's lower corner; `moved`: off the grid.
struct ProbeStanding {
  glm::dvec3 place;
  bool moved = false;
};

// Looks around in the geometry; one for each worker, which allocates at its first look only.
class ProbeSurveyor {
 public:
  // Before the looks of a frame: as the geometry is now.
  void face(const EmbreeScene& geometry, const ProbeGrid& grid);
  // Where a probe stands: at its place in the grid, or up to 0.45 of the spacing off where a surface is near.
  ProbeStanding standing(const ProbeGrid& grid, int probe);
  // The words of a distance map from `place`.
  void map(const glm::dvec3& place, unsigned mask, double nearest_m, std::uint32_t* words);

 private:
  const std::vector<float>& all_around(const glm::dvec3& place, unsigned mask);
  double nearest(const glm::dvec3& place);
  bool has_room(const glm::dvec3& place);
  bool sees(const glm::dvec3& from, const glm::dvec3& to);
  std::optional<glm::dvec3> better_place(const glm::dvec3& place, const glm::dvec3& spacing);

  RTCScene scene_ = nullptr;
  glm::dvec3 lower_{0.0};
  double clearance_m_ = 0;
  std::vector<float> fine_, few_;
  std::optional<glm::dvec3> seen_from_;  // what fine_ holds of all geometry
  DistanceScratch scratch_;
};

class ProbePlacement {
 public:
  // Fills `volume`: probes near geometry; places, up to 0.45 of the spacing off the grid where a probe stood
  // too close to a surface; distance maps for each set. `scene` is the one that `geometry` was made from.
  static void settle(ProbeVolume& volume, const Scene& scene, const EmbreeScene& geometry,
                     RenderThreads& threads);
};

}  // namespace herr
