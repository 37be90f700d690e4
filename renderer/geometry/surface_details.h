// What a surface has beyond factors, two textures and one set of coordinates: does an instance need it, and
// its record. Used by frame_plan (is the code for it needed?) and embree_scene (build it).
#pragma once

#include <optional>
#include <span>

#include "renderer/geometry/shading_scene.h"
#include "renderer/geometry/triangle_records.h"
#include "scenes/model/scene.h"

namespace herr {

// Eyes see the fronts of its triangles only: a single-sided material. Shadows, mirrors and probes take both
// sides for solid, and so do eyes where light passes the surface.
bool culls_back_faces(const Scene& scene, const Instance& instance);
// It does, and its backs may lie before everything else that eyes see: Embree asks for each hit. Elsewhere
// back_faces-inl.h looks after the few that are met.
bool shows_backs(const Scene& scene, const Instance& instance);
// Any texture of its material is read.
bool has_textures(const Scene& scene, const Instance& instance);
// Part of its surface, or all of it, may be missing: alpha below the cutoff, or blended.
bool has_holes(const Scene& scene, const Instance& instance);
bool blends(const Scene& scene, const Instance& instance);
// Vertex colours, further textures or coordinates, highlights of another strength, unlit, alpha.
bool has_details(const Scene& scene, const Instance& instance);

// The record, where has_details. `baked`: of the instance's mesh; it and `textures` must outlive the record.
std::optional<DetailRecord> detail_record(const Scene& scene, const Instance& instance,
                                          const BakedMesh* baked, std::span<const TextureRecord> textures);

}  // namespace herr
