// How far instances reach, kept up to date as they move: the box of each, of all, and of the catchers.
// Before: scenes/. After: light_records (how far a sun shines, how dark a catcher may be).
#pragma once

#include <span>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// Around a box that a matrix places; inverted where it is.
Bounds box_around(const Bounds& box, const glm::dmat4x3& place);

// A moved instance costs the eight corners of its mesh's box, however many vertices that has.
class InstanceBoxes {
 public:
  explicit InstanceBoxes(const Scene& scene);
  // After these have changed. Allocates only for more instances than ever before.
  void update(std::span<const ChangedSlot> changed);

  // Of instances that are there; inverted (lower > upper) where none is.
  const Bounds& all() const { return all_; }
  const std::vector<Bounds>& catchers() const { return catchers_; }
  const Bounds& of(std::size_t slot) const { return boxes_[slot]; }

 private:
  void measure(std::size_t slot);
  void sum_up();

  const Scene& scene_;
  std::vector<Bounds> mesh_boxes_;  // in object space
  std::vector<Bounds> boxes_;       // per instance, in the world
  std::vector<Bounds> catchers_;
  Bounds all_;
};

}  // namespace herr
