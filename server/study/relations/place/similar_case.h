// A case moved, turned or scaled as a whole, scene and eyes together: its picture stays the same.
// Before: relation_case.h, scenes/model/similar_scene.h. After: place_relations.cpp.
#pragma once

#include <string>

#include "scenes/model/similar_scene.h"
#include "server/study/relations/relation_case.h"

namespace herr {

// Every length of it: lights' and probes', occlusion's, how far apart the eyes are, the feed's distance.
RelationCase similar_case(RelationCase subject, const Similarity& similarity);

// Why there is no such case: one sentence; empty when there is one.
std::string why_not_similar(const RelationCase& subject, const Similarity& similarity);

}  // namespace herr
