// The groups of relations; relation.cpp lists them. Each asks its relations of a case, one after another.
#pragma once

#include "server/study/relations/relation_case.h"

namespace herr {

class RelationLog;

void measure_place(const RelationCase& subject, RelationLog& log);

}  // namespace herr
