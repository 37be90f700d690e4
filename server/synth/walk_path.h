// Where somebody walks who goes up and down a room: straight to a point of it, a turn on the spot, on to the
// next point. Before: the room's size. After: head_motion adds the steps.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace herr {

// A rectangle of the floor.
struct WalkArea {
  glm::dvec3 centre{0.0};            // at the height of the eyes, metres
  glm::dvec2 half_extent{2.0, 2.0};  // along x and z, metres
};

class WalkPath {
 public:
  // A closed tour of 64 points, a pure function of seed and time; its memory does not grow with time.
  WalkPath(std::uint64_t seed, const WalkArea& area);

  struct State {
    glm::dvec3 position{0.0};
    double heading_rad = 0;  // about +Y from -Z
    double speed_m_s = 0;
  };
  // Speed and turning speed are continuous. `time_s` >= 0.
  State at(double time_s) const;

 private:
  // Walks from one point to the next, then turns towards the one after it.
  struct Leg {
    double start_s = 0;
    glm::dvec3 from{0.0}, direction{0.0};
    double length_m = 0, speed_m_s = 0, walk_s = 0;
    double heading_rad = 0, turn_rad = 0, turn_s = 0;
  };
  std::vector<Leg> legs_;
  double tour_s_ = 0;
};

}  // namespace herr
