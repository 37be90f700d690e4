// Relations of quality control and prediction hold for every run's limits, and see what is wrong.
#include <gtest/gtest.h>

#include "server/study/relations/relation.h"
#include "server/study/relations/relation_case.h"
#include "server/study/relations/relation_groups.h"

namespace herr {
namespace {

RelationCase limits_case(int polar_width, int light_samples, bool probes, double display_hz) {
  RelationCase subject;
  subject.settings.polar_width = polar_width;
  subject.settings.light_samples = light_samples;
  subject.settings.probes.on = probes;
  subject.profile = xr1_half_profile();
  subject.profile.display_hz = display_hz;
  return subject;
}

void expect_all_hold(const RelationCase& subject) {
  RelationLog log;
  measure_control(subject, log);
  ASSERT_GE(log.results().size(), 8u);
  for (const RelationResult& result : log.results()) {
    EXPECT_TRUE(result.holds()) << result.relation.name << ": " << result.error << " of "
                                << result.relation.bound << " " << result.where;
  }
}

TEST(ControlRelationsTest, HoldForRunsOfAnyWidthAndAnyNumberOfSamples) {
  for (const int width : {1, 8, 197, 8192}) {
    for (const int samples : {1, 4096}) {
      const bool probes = samples > 1;
      SCOPED_TRACE(testing::Message() << width << " columns, " << samples << " samples, probes " << probes);
      expect_all_hold(limits_case(width, samples, probes, 90));
    }
  }
}

TEST(ControlRelationsTest, HoldForDisplaysOfAnyRate) {
  for (const double hz : {1.0, 60.0, 72.0, 1000.0}) {
    SCOPED_TRACE(hz);
    expect_all_hold(limits_case(788, 16, true, hz));
  }
}

// The head a million metres off rounds to 2^-53 of its distance: errors are told as shares of that.
TEST(ControlRelationsTest, HoldForAHeadThatIsFarAwayAndTurned) {
  RelationCase subject = limits_case(788, 1, false, 60);
  subject.sample.head.world_from_head = {glm::dvec3(1e6, -3e5, 2e6),
                                         glm::normalize(glm::dquat(0.1, 0.7, -0.3, 0.5))};
  expect_all_hold(subject);
}

TEST(ControlRelationsTest, WithoutPolarBuffersThereIsNoWidthToControl) {
  RelationCase subject = limits_case(788, 1, false, 60);
  subject.settings.foveation = Foveation::off;
  RelationLog log;
  measure_control(subject, log);
  EXPECT_EQ(log.results().back().not_applicable, "foveation is off: one ray per viewport pixel");
}

}  // namespace
}  // namespace herr
