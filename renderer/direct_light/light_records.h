// Lights of this frame as the kernels read them, and how their samples are stratified.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "renderer/frame_plan.h"
#include "renderer/geometry/shading_scene.h"
#include "scenes/model/scene.h"

namespace herr {

// Strata per axis whose product is `samples`, as near to cubes as the box's extent allows; one on an axis of
// no thickness (all of them on x when the box is a point).
std::array<int, 3> strata_for(const glm::vec3& size, int samples);

// Fills `out` (its storage is kept) with the lights that shine, relative to `anchor`.
struct LightReach {
  double beyond_scene_m = 0;  // leaves the scene from any place in it
  double eyes_m = 0;          // from the anchor to the eyes, at most
};
void light_records(std::span<const AreaLight> lights, const glm::dvec3& anchor, LightSampling sampling,
                   const LightReach& reach, std::vector<LightRecord>& out);

// Irradiance that the real ones of these lights would give, unblocked and head on, at the point of `boxes`
// (world space) farthest from each, per channel: a scale of what catchers receive that no light near one of
// them can blow up.
glm::vec3 farthest_irradiance(std::span<const AreaLight> lights, std::span<const Bounds> boxes);

}  // namespace herr
