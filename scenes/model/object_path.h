// The path of an object: keys of its placement over time, and what lies between them.
// Before: scene_document_paths reads it. After: world places the object. Source: Shoemake 1985 (slerp).
#pragma once

#include <vector>

#include "scenes/model/placement.h"

namespace herr {

struct PathKey {
  double time_s = 0;  // since the session's start
  Placement placement;
};

// Where an object stands on it depends on the time alone.
struct ObjectPath {
  std::vector<PathKey> keys;  // times >= 0 and growing; from one to the next each scale keeps its sign
  bool loop = false;          // time is taken modulo the last key's; false: the last key holds

  bool empty() const { return keys.empty(); }
  // At any finite time, of a path with keys. Before the first key: there. Translation and scale lie on
  // straight lines between two keys, the rotation on the shorter arc; at a key, and between two that are the
  // same, it is the key's placement to the last bit. No scale leaves the range of its two keys.
  Placement at(double time_s) const;
};

}  // namespace herr
