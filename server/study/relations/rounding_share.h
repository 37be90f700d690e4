// Relations of pictures that only rounding may tell apart: where in this scene rounding alone changes more
// pixels than the derived bound allows, what it changes is measured, and the relation is held to twice that,
// at most to a ceiling. Before: pictures that a relation compares. After: groups of relations.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_case.h"
#include "server/study/relations/relation_groups.h"

namespace herr {

// Of pixels: no relation is held to more, whatever rounding changes.
inline constexpr double kMostRounding = 0.05;

struct TwinPictures {
  std::vector<LinearPicture> got, wanted;
  std::string names;  // of the pair that is worst, where there are several; may be empty
};
using TwinsOfCase = std::function<TwinPictures(const RelationCase&)>;

// Share of the pixels of `here`, the case's picture, that change when the case is moved as a whole by half a
// step of the anchor: places round as far away from it then as a head may stand, and nothing else happens.
// 0 where the case cannot be moved.
double rounding_share(const RelationCase& subject, const std::vector<LinearPicture>& here,
                      const DrawPicture& draw);

// To twice the share where that is more than the bound, and to the ceiling at most.
void allow_for_rounding(Relation& relation, double share);

// What measure_but_for_rounding asks.
struct RoundedRelation {
  Relation relation;    // with its derived bound, of pixels beyond one 8-bit step
  std::string caption;  // of pictures
  TwinsOfCase twins;    // of any case
  // What a case is made into, where that rounds anew; empty: nothing. Rounding is measured of both.
  std::function<RelationCase(const RelationCase&)> likeness;
  DrawPicture draw;  // of either
};
// Beyond the derived bound it is held to what rounding changes. Beyond the ceiling, if rounding changes as
// much, it is asked of the scene with every surface of one matte colour, by the derived bound: which of two
// surfaces in one place is seen does not matter then, and any fault of places, sight or light still does.
void measure_but_for_rounding(RoundedRelation asked, const RelationCase& subject, const TwinPictures& first,
                              RelationLog& log);

}  // namespace herr
