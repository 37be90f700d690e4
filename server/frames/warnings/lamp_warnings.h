// Lamps that light nothing: of intensity 0, or inside something opaque. Before: a scene as it was loaded.
// After: picture_warnings.
#pragma once

#include <string>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// One line for each kind of mistake, which names the first such lamp and counts the others; no file before
// it.
//
// Inside is, at the start of the session, a centre within a box or sphere of `shapes`, in a voxel that is
// there, or where the winding number of a mesh's triangles (sum of their signed solid angles, van Oosterom &
// Strackee 1983, over 4 pi; fronts outwards count as positive) is above 0.9: within a closed mesh it is 1,
// within a lampshade open at one side less, in a room whose walls face inwards -1. Opaque is what has neither
// transmission nor an alpha mode. What holds the middle of another instance, too, is taken for a room.
// Catchers hide virtual lamps alone: a lamp of the real room may be drawn in its wall.
std::vector<std::string> lamp_warnings(const Scene& scene);

}  // namespace herr
