// Quaternions that look as if they were written w, x, y, z, as many programs write them. Before: the JSON of
// a scene document. After: a warning of load_scene.
#pragma once

#include <string>

#include "sessions/files/strict_json.h"

namespace herr {

// One line about every `rotation_xyzw` and `orientation_xyzw` of the document; empty: none looks so. Here w
// is last. One looks w-first when its first number is at least 0.7 and its last is 0: w-first, that is a turn
// of at most 90 degrees about x, y or a line between, as files are full of; w-last it is half a turn about a
// line near x, which few mean. [-1, 0, 0, 0] is the same half turn about x, and no program writes w as -1
// alone: it does not look so.
std::string w_first_warning(const JsonObject& root);

}  // namespace herr
