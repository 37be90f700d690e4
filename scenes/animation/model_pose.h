// A model at a time: where its nodes stand, and what that does to its meshes.
// Before: AnimatedModel. After: world places instances and hands poses of deformations to the renderer.
#pragma once

#include <vector>

#include "scenes/model/animated_model.h"

namespace herr {

// The clip's time at a time of the session: round its length, or held at its ends.
double clip_time_s(const Playback& playback, double length_s, double time_s);

// The value of a channel, `components` numbers, held before its first and after its last time. Rotations are
// interpolated along the shorter arc and come out of unit length.
void sample_channel(const AnimationChannel& channel, double time_s, float* out);

// Allocates nothing after its construction, but for a pose that is bent for the first time.
class ModelPose {
 public:
  // `model` must outlive it. Posed as at time 0.
  explicit ModelPose(const AnimatedModel& model);

  void pose(double time_s);
  const glm::dmat4x3& model_from_node(int node) const { return matrices_[static_cast<std::size_t>(node)]; }
  // Fills `out`; its version changes when anything differs from what it held.
  void bend(const MeshDeformation& deformation, DeformationPose& out) const;

 private:
  const AnimatedModel& model_;
  std::vector<ModelNode> nodes_;  // with what the clip makes of them
  std::vector<glm::dmat4x3> matrices_;
  std::vector<float> sampled_;
};

}  // namespace herr
