// Where a scene stands, which way it faces and how large it is changes nothing: moved, turned and scaled it
// gives the same picture.
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <vector>

#include "server/study/relations/picture_distance.h"
#include "server/study/relations/place/similar_case.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

// Of pixels, which rounding may take across an edge.
constexpr double kMovedShare = 1e-3, kScaledShare = 1e-2;
constexpr double kProbeDensity = 0.5;  // an eighth of the probes: many pictures are made

using Pictures = std::vector<LinearPicture>;

Relation of_pixels(std::string name, std::string holds, double bound, std::string bound_from) {
  Relation relation;
  relation.name = std::move(name);
  relation.holds = std::move(holds);
  relation.bound = bound;
  relation.unit = "share of pixels beyond one 8-bit step";
  relation.bound_from = std::move(bound_from);
  return relation;
}

// Asks whether the case's likeness has the picture that the case has.
void measure_likeness(const RelationCase& subject, const Pictures& here, const Similarity& similarity,
                      const Relation& relation, RelationLog& log) {
  const std::string why = why_not_similar(subject, similarity);
  if (!why.empty()) return log.not_applicable(relation, why);
  const Pictures there = picture_of(similar_case(subject, similarity));
  const PictureDistance apart = share_beyond_one_step(there, here, subject.profile);
  log.measured(relation, apart.error, apart.where,
               worst_pictures(apart, there, here, relation.name + " | as it stands | difference"));
}

// One ray for each pixel: of a polar buffer each would colour many.
RelationCase by_pixels(RelationCase subject) {
  subject.settings.foveation = Foveation::off;
  subject.settings.scale = 1;
  return subject;
}

// In a direction that is no axis.
glm::dvec3 way_of(double metres) {
  return metres * glm::normalize(glm::dvec3(3, 1, -2));
}

struct Named {
  double value;
  const char* text;
};

// In any direction: what stands where to the anchor rounds anew.
void measure_moved(const RelationCase& rays, const Pictures& here, std::span<const Named> ways,
                   const std::string& light, RelationLog& log) {
  for (const auto& [metres, text] : ways) {
    const Relation relation = of_pixels(
        std::string("moved by ") + text + " m, " + light, "scene and head moved as one give the same picture",
        kMovedShare,
        "within 24 m of the anchor floats round to 1e-6 m, and pixels are centimetres wide: a few in ten "
        "thousand of the rays that pass edges change sides");
    Similarity similarity;
    similarity.move = way_of(metres);
    measure_likeness(rays, here, similarity, relation, log);
  }
}

// By whole steps of the anchor: nothing rounds anew but what doubles round that far out.
void measure_moved_by_steps(const RelationCase& lit, const Pictures& here, RelationLog& log) {
  constexpr double kStep_m = 16;
  for (const auto& [metres, text] : {Named{1e6, "1e6"}, Named{1e8, "1e8"}}) {
    const Relation relation = of_pixels(
        std::string("moved by ") + text + " m in whole steps, all light",
        "moved by a multiple of 16 m along each axis, scene and head give the same picture", kMovedShare,
        "relative to the anchor no place changes by more than a double's rounding, 7.5e-9 m at 1e8 m, which "
        "is another float for one place in a hundred");
    Similarity similarity;
    similarity.move = kStep_m * glm::round(way_of(metres) / kStep_m);
    measure_likeness(lit, here, similarity, relation, log);
  }
}

void measure_turned(const RelationCase& rays, const Pictures& here, RelationLog& log) {
  for (int axis = 0; axis < 3; ++axis) {
    const Relation relation =
        of_pixels(std::string("turned by 90 degrees about ") + "xyz"[axis],
                  "scene and head turned as one give the same picture, in hard light", kMovedShare,
                  "places are the same floats along other axes; sums of three products round in another "
                  "order, by 1e-7 of the distance: a few in ten thousand of the rays that pass edges change "
                  "sides");
    Similarity similarity;
    similarity.turn = quarter_turn(axis);
    measure_likeness(rays, here, similarity, relation, log);
  }
}

void measure_scaled(const RelationCase& subject, const Pictures& here, const std::string& light,
                    RelationLog& log) {
  for (const auto& [factor, text] :
       {Named{1e-4, "1e-4"}, Named{1e-2, "1e-2"}, Named{1e2, "1e2"}, Named{1e5, "1e5"}}) {
    const Relation relation = of_pixels(
        std::string("scaled by ") + text + ", " + light,
        "with every length times the factor and intensities times its square the picture is the same",
        kScaledShare,
        "no power of two, so that every number rounds anew, by 6e-8 of it, in each of the dozens of steps "
        "between a ray and its light: of pixels at edges, one in a hundred at most changes sides");
    Similarity similarity;
    similarity.scale = factor;
    measure_likeness(subject, here, similarity, relation, log);
  }
}

}  // namespace

void measure_place(const RelationCase& subject, RelationLog& log) {
  static constexpr std::array kWays{Named{1e3, "1e3"}, Named{1e6, "1e6"}, Named{1e8, "1e8"}};
  RelationCase lit = all_light(subject);
  lit.settings.probes.density *= kProbeDensity;
  const RelationCase hard_rays = by_pixels(hard_light(subject)), lit_rays = by_pixels(lit);
  const Pictures hard = picture_of(hard_rays), all = picture_of(lit);
  measure_moved(hard_rays, hard, kWays, "hard light", log);
  measure_moved(lit_rays, picture_of(lit_rays), std::span(kWays).subspan(1), "all light", log);
  measure_moved_by_steps(lit, all, log);
  measure_turned(hard_rays, hard, log);
  measure_scaled(hard_rays, hard, "hard light", log);
  measure_scaled(lit, all, "all light", log);
}

}  // namespace herr
