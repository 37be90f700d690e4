// The groups of relations; relation.cpp lists them. Each asks its relations of a case, one after another.
#pragma once

#include "server/study/relations/relation_case.h"

namespace herr {

class RelationLog;

void measure_place(const RelationCase& subject, RelationLog& log);      // place_relations.cpp
void measure_stamps(const RelationCase& subject, RelationLog& log);     // stamps_relations.cpp
void measure_light(const RelationCase& subject, RelationLog& log);      // light_relations.cpp
void measure_samples(const RelationCase& subject, RelationLog& log);    // samples_relations.cpp
void measure_surfaces(const RelationCase& subject, RelationLog& log);   // surfaces_relations.cpp
void measure_gaze(const RelationCase& subject, RelationLog& log);       // gaze_relations.cpp
void measure_triangles(const RelationCase& subject, RelationLog& log);  // triangles_relations.cpp
void measure_probes(const RelationCase& subject, RelationLog& log);     // probes_relations.cpp
void measure_control(const RelationCase& subject, RelationLog& log);    // control_relations.cpp
void measure_threads(const RelationCase& subject, RelationLog& log);    // threads_relations.cpp
void measure_prediction(const RelationCase& subject,
                        RelationLog& log);  // part of control: prediction_relations.cpp

}  // namespace herr
