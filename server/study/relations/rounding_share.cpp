#include "server/study/relations/rounding_share.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "scenes/model/similar_scene.h"
#include "server/study/relations/one_albedo.h"
#include "server/study/report/figure_text.h"

namespace herr {
namespace {

// Of the anchor along each axis, and in extents of a scene that is small against it.
constexpr double kHalfStep_m = 7, kHalfStepOfSmall = 5;
constexpr double kScatterOfShares = 2;  // two moves tell a share that others may exceed
constexpr float kOneColour = 0.5f;

// Heads follow the scene.
RelationCase moved_case(RelationCase subject, const Similarity& move) {
  subject.scene = similar_scene(std::move(subject.scene), move);
  for (AreaLight& light : subject.state.lights) light = similar_light(std::move(light), move);
  return subject;
}

void log_twins(const RoundedRelation& asked, const TwinPictures& twins, PictureDistance apart,
               RelationLog& log) {
  if (!twins.names.empty()) apart.where = twins.names + ": " + apart.where;
  const std::string caption = twins.names.empty() ? asked.caption : twins.names + " | difference";
  log.measured(asked.relation, apart.error, apart.where,
               worst_pictures(apart, twins.got, twins.wanted, caption));
}

}  // namespace

double rounding_share(const RelationCase& subject, const std::vector<LinearPicture>& here,
                      const DrawPicture& draw) {
  const Bounds box = scene_bounds(subject.scene);
  const double extent_m = glm::length(box.upper - box.lower);
  double share = 0;
  for (const double side : {1.0, -1.0}) {
    Similarity near;
    near.move = side * std::min(kHalfStep_m, kHalfStepOfSmall * extent_m) * glm::dvec3(1, -0.9, 0.95);
    if (!why_not_similar(subject.scene, near).empty()) continue;
    const std::vector<LinearPicture> moved = draw(moved_case(subject, near));
    share = std::max(share, share_beyond_one_step(moved, here, subject.profile).error);
  }
  return share;
}

void allow_for_rounding(Relation& relation, double share) {
  const double measured = std::min(kScatterOfShares * share, kMostRounding);
  if (measured <= relation.bound) return;
  relation.kind = RelationKind::measured;
  relation.bound = measured;
  relation.bound_from +=
      "; more in this scene, of surfaces that coincide, blend, mirror or refract: half a step of the anchor "
      "away, where nothing is far, rounding changes " +
      figure(100 * share, 2) + " % of these pixels, and elsewhere twice as many, never more than " +
      figure(100 * kMostRounding, 2) + " %";
}

void measure_but_for_rounding(RoundedRelation asked, const RelationCase& subject, const TwinPictures& first,
                              RelationLog& log) {
  PictureDistance apart = share_beyond_one_step(first.got, first.wanted, subject.profile);
  if (apart.error <= asked.relation.bound) return log_twins(asked, first, std::move(apart), log);
  double share = rounding_share(subject, asked.draw(subject), asked.draw);
  if (asked.likeness && kScatterOfShares * share < kMostRounding) {
    const RelationCase there = asked.likeness(subject);
    share = std::max(share, rounding_share(there, asked.draw(there), asked.draw));
  }
  const Relation derived = asked.relation;
  allow_for_rounding(asked.relation, share);
  const bool by_chance = apart.error > kMostRounding && kScatterOfShares * share > kMostRounding;
  if (!by_chance) return log_twins(asked, first, std::move(apart), log);
  asked.relation = derived;
  asked.relation.holds += ", with every surface of one matte colour";
  asked.relation.bound_from +=
      "; in one colour, since in its own rounding alone changes " + figure(100 * share, 2) +
      " % of this scene's pixels half a step of the anchor away: surfaces coincide, blend, mirror or refract";
  const TwinPictures plain = asked.twins(of_albedo(subject, kOneColour));
  log_twins(asked, plain, share_beyond_one_step(plain.got, plain.wanted, subject.profile), log);
}

}  // namespace herr
