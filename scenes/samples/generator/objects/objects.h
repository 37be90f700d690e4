// The nine objects of the `general` sample, the room of its camera feed and the boards of `quality`, each in
// metres, standing on y = 0. Before: shapes/ and pictures/. After: main checks and writes them. Each lives in
// the .cpp of its name.
#pragma once

#include "scenes/samples/generator/glb/glb_writer.h"

namespace herr::samples {

GlbObject teapot();            // 0.45 m across, Newell's patches
GlbObject vase();              // 1.05 m, turned, painted
GlbObject statue();            // a robed figure with a raised arm on a plinth, 2.1 m
GlbObject plant();             // thin curved leaves in a pot, 1.5 m
GlbObject hare();              // a sitting hare as a noisy scan, on a column, 1.75 m
GlbObject knot();              // torus knot of polished steel on a stand, 1.7 m
GlbObject shell();             // a spiral sea shell lying on its side, 0.3 m
GlbObject chair();             // turned legs and posts, 0.95 m
GlbObject armillary_sphere();  // brass rings round a globe on a turned stand, 1.3 m
GlbObject quality_boards();    // nine boards with text and line charts, 1 m around the origin
GlbObject room();              // 5 x 2.5 x 10 m, furnished; centred on the origin, floor at y = 0

}  // namespace herr::samples
