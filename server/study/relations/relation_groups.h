// The groups of relations; relation.cpp lists them. Each asks its relations of a case, one after another.
#pragma once

#include <functional>
#include <vector>

#include "server/study/relations/relation_case.h"

namespace herr {

class RelationLog;

void measure_place(const RelationCase& subject, RelationLog& log);   // place/place_relations.cpp
void measure_stamps(const RelationCase& subject, RelationLog& log);  // place/stamps_relations.cpp
// How relations get their frames and pictures. A test hands in one with a fault.
using DrawFrame =
    std::function<void(Renderer&, const RelationCase&, const FrameQuality&, RenderedFrame& out)>;
using DrawPicture = std::function<std::vector<LinearPicture>(const RelationCase&)>;
void measure_gaze_by(const DrawFrame& draw, const RelationCase& subject, RelationLog& log);
void measure_triangles_by(const DrawPicture& draw, const RelationCase& subject, RelationLog& log);

void measure_light(const RelationCase& subject, RelationLog& log);      // light/light_relations.cpp
void measure_samples(const RelationCase& subject, RelationLog& log);    // light/samples_relations.cpp
void measure_surfaces(const RelationCase& subject, RelationLog& log);   // light/surfaces_relations.cpp
void measure_gaze(const RelationCase& subject, RelationLog& log);       // gaze/gaze_relations.cpp
void measure_triangles(const RelationCase& subject, RelationLog& log);  // triangles/triangles_relations.cpp
void measure_probes(const RelationCase& subject, RelationLog& log);     // probes/probes_relations.cpp
void measure_control(const RelationCase& subject, RelationLog& log);    // control/control_relations.cpp
void measure_threads(const RelationCase& subject, RelationLog& log);    // threads_relations.cpp

// Of the group light: a light inside, on and just above a surface (light/light_near.cpp).
void measure_light_near(const RelationCase& subject, RelationLog& log);

// Of the group control: heads that turn and eyes that jump (control/prediction_relations.cpp).
void measure_prediction(const RelationCase& subject, RelationLog& log);

}  // namespace herr
