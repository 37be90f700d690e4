// Quaternions that look as if they were written w, x, y, z. Before: the JSON of a scene document. After: a
// warning of load_scene.
#pragma once

#include <string>

#include "sessions/files/strict_json.h"

namespace herr {

// One line about every `rotation_xyzw` and `orientation_xyzw` of the document, by order_doubt(); empty: none
// looks so.
std::string w_first_warning(const JsonObject& root);

}  // namespace herr
