// The camera of a look: a viewport whose shorter side a sphere about the model nearly fills. Before:
// bounding_sphere. After: look_picture renders it.
#pragma once

#include "scenes/changes/bounding_sphere.h"
#include "server/look/look_options.h"
#include "sessions/format/display_profile.h"
#include "sessions/format/pose.h"

namespace herr {

// The sphere's silhouette is at most this share of the shorter side.
inline constexpr double kFilledShare = 0.95;

struct LookCamera {
  DisplayProfile profile;  // one viewport
  Pose world_from_camera;  // looks along -Z, +Y up
  double distance = 0;     // from the sphere's middle
};

// At options.distance 1 the silhouette of a sphere of radius r, seen over the half angle a, has kFilledShare
// of the tangent of a: sin(atan(kFilledShare tan a)) = r / distance.
LookCamera look_camera(const LookOptions& options, const LookDirection& from, const BoundingSphere& sphere);

}  // namespace herr
