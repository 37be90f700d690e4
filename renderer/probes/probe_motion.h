// Keeps the sight of probes up to date in a scene that moves: which probes have something new around them,
// and what they see now. Maps settle as light does: x <- h x + (1 - h) new with h = exp(-dt / tau), the exact
// solution of exponential forgetting; what is left after 2.25 tau goes at once, so that no leak stays.
// Before: EmbreeScene has committed the frame's changes. After: probe rays and look-ups of the same frame.
// Exists only where the scene changes. Frames allocate nothing, unless more instances come than ever before.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/geometry/instance_boxes.h"
#include "renderer/probes/probe_placement.h"

namespace herr {

class ProbeMotion {
 public:
  // `scene` as `geometry` and `boxes` were made from; `workers`: threads of the renderer.
  ProbeMotion(const Scene& scene, const EmbreeScene& geometry, const InstanceBoxes& boxes,
              const ProbeGrid& grid, int workers);

  // Takes down what a frame changed, after the geometry and `boxes` have taken it up. What stands, and looks,
  // as it did is no change.
  void note(std::span<const ChangedSlot> slots, const SceneState& state, const EmbreeScene& geometry,
            const InstanceBoxes& boxes);
  // Lets probes look again, before the frame at `t_ns` updates them: those around a change, in turn, each
  // about every quarter of tau, `most` in a frame. The first frame, and one whose time lies before the
  // last one's, bring all up to date at once.
  void follow(ProbeVolume& volume, const EmbreeScene& geometry, RenderThreads& threads, std::int64_t t_ns,
              int most);
  // After the geometry was made anew as for a first frame: as if nothing had ever moved.
  void start_anew(const EmbreeScene& geometry, const InstanceBoxes& boxes);

  int looked() const { return static_cast<int>(looks_.size()); }       // probes, in the last frame
  int restless() const { return static_cast<int>(restless_.size()); }  // that have not settled yet

  // Behind what is there, and from the end of `bytes`, which loses it: std::invalid_argument where it does
  // not belong to this scene and grid. Maps of the probes that ever looked again are part of it.
  void save(const ProbeVolume& volume, std::vector<std::byte>& bytes) const;
  void restore(ProbeVolume& volume, std::span<const std::byte>& bytes);
  std::int64_t bytes() const;

 private:
  // What matters of an instance to those that look at it.
  struct Shown {
    glm::dmat4x3 place{1.0};
    std::uint32_t mesh = 0, material = 0, kind = 0, present = 0;
    Bounds box;
  };
  struct Look {
    std::int32_t probe = 0;
    float kept = 0;
    bool moved = false, elsewhere = false;
  };

  Shown shown_at(std::size_t slot, const InstanceBoxes& boxes) const;
  void note_instance(std::size_t slot, const InstanceBoxes& boxes);
  void note_bend(std::size_t deformation, const SceneState& state, const EmbreeScene& geometry);
  void unsettle(const Bounds& box, std::int64_t since_ns, std::int64_t t_ns);
  void unsettle_all(std::int64_t t_ns);
  void choose(std::int64_t t_ns, double dt_s, double tau_s, int most);
  void look(ProbeVolume& volume, const EmbreeScene& geometry, RenderThreads& threads);
  void settle_down(ProbeVolume& volume, std::int64_t t_ns);

  const Scene& scene_;
  const ProbeGrid& grid_;
  std::vector<Shown> shown_;                   // per slot, as of the last note()
  std::vector<std::uint64_t> poses_;           // per deformation: digest of its pose
  std::vector<Bounds> shapes_;                 // per deformation, in object space
  std::vector<Bounds> changed_;                // boxes where something was or is, since the last follow()
  std::vector<std::int64_t> changed_ns_;       // per probe: the last change around it
  std::vector<std::int64_t> blended_ns_;       // per probe: to when its map has settled
  std::vector<std::uint8_t> touched_, waits_;  // per probe: looked again ever; is in restless_
  std::vector<std::int32_t> restless_;
  std::int32_t together_ = 0;                     // the most in restless_ since it was empty
  std::vector<Look> looks_;                       // of this frame
  std::vector<ProbeSurveyor> surveyors_;          // per worker
  std::vector<std::vector<std::uint32_t>> maps_;  // per worker
};

}  // namespace herr
