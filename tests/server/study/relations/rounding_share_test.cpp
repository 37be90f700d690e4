// Relations allow for what rounding changes in a scene, up to a ceiling, and for no fault.
#include "server/study/relations/rounding_share.h"

#include <gtest/gtest.h>

#include <utility>

#include "server/study/relations/place/similar_case.h"
#include "tests/server/study/relations/light/lit_case.h"

namespace herr {
namespace {

TEST(RoundingShareTest, BoundsGrowToTwiceTheShareAndNeverBeyondTheCeiling) {
  const auto allowed = [](double share) {
    Relation relation;
    relation.bound = 1e-3;
    allow_for_rounding(relation, share);
    return relation;
  };
  EXPECT_EQ(allowed(4e-4).bound, 1e-3);
  EXPECT_EQ(allowed(4e-4).kind, RelationKind::exact);
  EXPECT_EQ(allowed(0.01).bound, 0.02);
  EXPECT_EQ(allowed(0.01).kind, RelationKind::measured);
  EXPECT_NE(allowed(0.01).bound_from.find("changes 1.0 %"), std::string::npos) << allowed(0.01).bound_from;
  EXPECT_EQ(allowed(0.3).bound, 0.05);
}

// As if floor and wall were two sheets each, of two colours in one place: another is seen wherever the scene
// has moved. With a fault lights stay behind too.
std::vector<LinearPicture> drawn_by_chance(RelationCase subject, bool fault) {
  const bool moved = subject.scene.instances[0].world_from_object[3] != glm::dvec3(0.0);
  if (moved) std::swap(subject.scene.materials[0].base_colour, subject.scene.materials[1].base_colour);
  if (moved && fault) subject.state.lights.clear();
  return picture_of(subject);
}

RelationResult measured(bool fault) {
  const RelationCase subject = hard_light(test::case_of(test::lit_scene()));
  Similarity far;
  far.move = {800, 267, -534};
  RoundedRelation asked;
  asked.relation.holds = "moved it looks the same";
  asked.relation.bound = 1e-3;
  asked.draw = [&](const RelationCase& any) { return drawn_by_chance(any, fault); };
  asked.twins = [&](const RelationCase& any) {
    return TwinPictures{asked.draw(similar_case(any, far)), asked.draw(any), {}};
  };
  const TwinPictures first = asked.twins(subject);
  // What this is about: far beyond any allowance.
  EXPECT_GT(share_beyond_one_step(first.got, first.wanted, subject.profile).error, kMostRounding);
  RelationLog log;
  measure_but_for_rounding(asked, subject, first, log);
  return log.results().at(0);
}

TEST(RoundingShareTest, SurfacesInOnePlaceAreAskedInOneColour) {
  const RelationResult result = measured(false);
  EXPECT_TRUE(result.holds()) << result.error << " of " << result.relation.bound << " " << result.where;
  EXPECT_EQ(result.relation.bound, 1e-3);
  EXPECT_NE(result.relation.holds.find("one matte colour"), std::string::npos);
}

TEST(RoundingShareTest, AFaultIsSeenThroughSurfacesInOnePlace) {
  EXPECT_FALSE(measured(true).holds());
}

}  // namespace
}  // namespace herr
