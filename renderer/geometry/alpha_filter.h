// Hit filters: whether a ray stops at a triangle of a surface with holes, or at its back. Embree asks for
// each hit of the meshes that need it, and of no other. Before: mesh_geometry registers. After: every ray, of
// whatever kind, passes the holes of masked surfaces.
#pragma once

#include "renderer/embree/embree_api.h"
#include "renderer/geometry/shading_scene.h"

namespace herr {

// The records of all instances, by Embree's id; filled in when they are built.
struct InstanceTable {
  const InstanceRecord* records = nullptr;
};

// Registers the filters; `instances` must outlive the geometry.
// - Masked: a hit counts where alpha reaches the cutoff.
// - Blended: rays from eyes stop where alpha is at least 1/255, those with kSecondLook at 1/2; occlusion rays
//   with kPassesThrough never stop, but multiply what passes, others stop at 1/2.
// - Back faces of front-only surfaces: passed by rays with kCullBackFaces.
void filter_hits(RTCGeometry geometry, const InstanceTable& instances);

// Alpha of a surface at barycentric (u, v) of triangle `triangle`: factor x texture x vertices. `width2`: the
// squared width of the ray there, in object space; 0 reads the full texture.
float alpha_at(const DetailRecord& detail, std::uint32_t triangle, float u, float v, float width2);

}  // namespace herr
