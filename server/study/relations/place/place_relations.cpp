// Where a scene stands, which way it faces and how large it is changes nothing: moved, turned and scaled it
// gives the same picture.
#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <vector>

#include "server/study/relations/light/plain_scene.h"
#include "server/study/relations/light/seed_means.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/place/similar_case.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/study/relations/rounding_share.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

// Of pixels, which rounding may take across an edge.
constexpr double kMovedShare = 1e-3, kScaledShare = 1e-2;
constexpr std::uint32_t kTurnedSeeds = 16;
constexpr double kStandardErrors = 4, kHalfRounding = 0x1p-9;
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

// In a direction that is no axis.
glm::dvec3 way_of(double metres) {
  return metres * glm::normalize(glm::dvec3(3, 1, -2));
}

// Asks whether the case's likeness has the picture that the case has.
void measure_likeness(const RelationCase& subject, const Pictures& here, const Similarity& similarity,
                      Relation relation, RelationLog& log) {
  const std::string why = why_not_similar(subject, similarity);
  if (!why.empty()) return log.not_applicable(relation, why);
  const Similarity stand{.scale = similarity.scale, .turn = similarity.turn};
  const auto likeness = [&](const RelationCase& any) { return picture_of(similar_case(any, similarity)); };
  RoundedRelation asked{.relation = std::move(relation),
                        .caption = {},
                        .twins =
                            [&](const RelationCase& any) {
                              return TwinPictures{likeness(any), picture_of(any), {}};
                            },
                        .likeness = {},
                        .draw = picture_of};
  // Where it is without the move, which is what is asked.
  if (similarity.scale != 1 || similarity.turn != Similarity{}.turn)
    asked.likeness = [&](const RelationCase& any) { return similar_case(any, stand); };
  asked.caption = asked.relation.name + " | as it stands | difference";
  measure_but_for_rounding(std::move(asked), subject, {likeness(subject), here, {}}, log);
}

// One ray for each pixel: of a polar buffer each would colour many.
RelationCase by_pixels(RelationCase subject) {
  subject.settings.foveation = Foveation::off;
  subject.settings.scale = 1;
  return subject;
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

// Far from the origin too: what is small stands where it is small against its place.
void measure_small_and_far(const RelationCase& subject, const Pictures& here, RelationLog& log) {
  const Relation relation = of_pixels(
      "scaled by 1e-4, 1e3 m away, hard light",
      "a scene of a ten-thousandth of the size, a kilometre from the origin, gives the same picture",
      kScaledShare,
      "the anchor stands within 24 extents of a scene that is smaller than a metre: places round to "
      "2e-6 of its size, a hundredth of a pixel");
  Similarity similarity;
  similarity.scale = 1e-4;
  similarity.move = way_of(1e3);
  measure_likeness(subject, here, similarity, relation, log);
}

// Pictures by seeds from `first` on, limited to white, as rows of values. Rays pass anywhere through their
// pixels, so that edges are chance too.
SeedRows rows_of(const RelationCase& subject, std::uint32_t first) {
  const auto renderer = renderer_of(subject);
  SeedRows rows(kTurnedSeeds);
  RenderedFrame frame;
  LinearPicture picture;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    PixelPass pass;
    pass.seed = pass.sequence = first + static_cast<std::uint32_t>(i);
    pass.jitter = true;
    renderer->render_pass(subject.sample, subject.state, pass, frame);
    for (const ViewportImage& viewport : frame.viewports) {
      read_viewport(viewport, picture);
      limit_to_white(picture);
      for (const auto& plane : picture.plane) rows[i].insert(rows[i].end(), plane.begin(), plane.end());
    }
  }
  return rows;
}

// Of matte surfaces: highlights depend on how a light is cut into strata, which goes by its axes in order.
RelationCase matte_case(const RelationCase& subject) {
  RelationCase soft = by_pixels(soft_light(subject, 4));
  soft.settings.occlusion_rays = 1;
  make_matte(soft.scene);
  for (Viewport& viewport : soft.profile.viewports) {
    viewport.width_px = std::max(1, viewport.width_px / 2);
    viewport.height_px = std::max(1, viewport.height_px / 2);
  }
  return soft;
}

// About up and then ahead; about up alone where nothing else is possible.
void measure_turned_by_chance(const RelationCase& subject, RelationLog& log) {
  const RelationCase soft = matte_case(subject);
  Similarity similarity;
  similarity.turn = quarter_turn(2) * quarter_turn(1);
  if (!why_not_similar(soft, similarity).empty()) similarity.turn = quarter_turn(1);
  Relation relation;
  relation.name = "turned by 90 degrees, soft light";
  relation.holds =
      "scene and head turned as one give the same picture in the mean, of matte surfaces in soft light with "
      "ambient occlusion";
  relation.kind = RelationKind::statistical;
  relation.bound = kStandardErrors;
  relation.unit = "standard errors";
  relation.bound_from =
      "the mean over 16 seeds; values may differ by 2^-9 of themselves, which rounding to half floats "
      "explains";
  const std::string why = why_not_similar(soft, similarity);
  if (!why.empty()) return log.not_applicable(relation, why);
  const SeedRows turned = rows_of(similar_case(soft, similarity), kTurnedSeeds);
  log.measured(relation, mean_difference(turned, rows_of(soft, 0), kHalfRounding).worst());
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
  measure_turned_by_chance(subject, log);
  measure_scaled(hard_rays, hard, "hard light", log);
  measure_scaled(lit, all, "all light", log);
  measure_small_and_far(hard_rays, hard, log);
}

}  // namespace herr
