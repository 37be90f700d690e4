// What the probes of a volume know, unpacked for people and other programs: where each stands, in which state
// it is, what light it has gathered, how far it sees. Says what look-ups read, as of the last update.
// Before: a Renderer has updated its probes. After: `herr inspect --probe-pictures` draws them. No frame uses
// this.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "renderer/probes/probe_grid.h"
#include "renderer/probes/probe_view.h"

namespace herr {

class ProbeVolume;

enum class ProbeState : std::uint8_t {
  active,  // updated when its turn comes
  dark,    // asleep: saw no light for long, looks again now and then
  far,     // no surface around it could ever ask it: costs nothing, knows nothing
};
const char* name_of(ProbeState state);

// Reads a volume that must outlive it and is not updated meanwhile.
class ProbeReader {
 public:
  explicit ProbeReader(const ProbeVolume& volume) : volume_(volume) {}

  const ProbeGrid& grid() const;
  int rays() const;  // of a probe and update
  int sets() const;  // 1: everything; 2: also what catchers alone look like
  ProbeState state(int probe) const;
  bool relocated(int probe) const;       // moved off its grid point
  glm::dvec3 position(int probe) const;  // world, metres: where it really stands
  double variability() const;            // of the last update: mean change of those updated, [0, 1]
  // Irradiance of a surface whose normal is the node's direction, W/m^2 for lights in W/sr: pi times the mean
  // incoming radiance.
  using Light = std::array<glm::vec3, LightNodes::kCount>;
  void irradiance(int set, int probe, Light& out) const;
  // Metres along each node's direction, 0 where nothing is seen, and the deviation that goes with it: of the
  // inverse of |x| + |y| + |z|, 1/m.
  struct Sight {
    std::array<float, DistanceNodes::kCount> distance_m, deviation_per_m;
  };
  void sight(int set, int probe, Sight& out) const;

 private:
  const ProbeVolume& volume_;
};

}  // namespace herr
