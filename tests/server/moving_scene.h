// A scene without files of its own in which something happens all the time, for tests of the frame loops.
#pragma once

#include <filesystem>

#include "tests/server/small_session.h"

namespace herr {

// For a session of some 0.2 s: a cart on a path, a ball that is moved, a box that comes, turns to a mirror
// and goes, a lamp that changes its colour (three channels for the catcher's ratio).
inline void write_moving_scene(const std::filesystem::path& file) {
  write_text(file, R"({"format_version": 1, "name": "moving",
"shapes": [
  {"name": "ball", "sphere": {"centre": [0.4, 1, -2], "radius": 0.3}},
  {"name": "box", "box": {"min": [-0.8, 0.6, -2.2], "max": [-0.3, 1.2, -1.8]}, "present": false},
  {"name": "cart", "box": {"centre": [0, 0.2, 0], "half_extents": [0.4, 0.2, 0.2]},
   "path": {"loop": true, "keys": [{"t_s": 0, "translation": [-1, 0.5, -2.5]},
                                   {"t_s": 0.5, "translation": [1, 0.5, -2.5]}]}}],
"catchers": [{"name": "floor", "quad": [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5]]}],
"lights": [{"name": "lamp", "centre": [0, 3, 1], "size": [0.5, 0.1, 0.5], "intensity_w_sr": [10, 10, 10]}],
"ambient": [0.2, 0.2, 0.2],
"timeline": [
  {"t_s": 0.03, "op": "move", "name": "ball", "translation": [0.3, 1.1, -2]},
  {"t_s": 0.06, "op": "spawn", "of": "box", "name": "box"},
  {"t_s": 0.09, "op": "set_material", "name": "box", "material": {"mirror": 1, "roughness": 0}},
  {"t_s": 0.12, "op": "set_light", "name": "lamp", "intensity_w_sr": [14, 9, 6]},
  {"t_s": 0.15, "op": "remove", "name": "box"}]})");
}

}  // namespace herr
