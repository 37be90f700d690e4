// Two angles or two tangents as a direction: x to the right of the ray's axes, y up, z forward; a map's axes
// say where these point. Before: numbers of a row. After: gaze_reader.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "sessions/import/map/column_map.h"

namespace herr {

// Of unit length. None from 88.8 degrees on, where a tangent says nothing.
std::optional<glm::dvec3> direction_from_tangents(double x, double y);

// Of unit length. None where the angles are of another unit: of tangents from 88.8 degrees on, else an
// azimuth beyond 360 or an elevation beyond 180.
std::optional<glm::dvec3> direction_from_angles(AngleKind kind, double azimuth_rad, double elevation_rad);

}  // namespace herr
