// Whose fault a late frame is.
#include "server/statistics/miss_cause.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

// Two threads, a period of 10 ms, a frame of 16 ms.
MissFacts late(double cpu_ms, std::int64_t preemptions) {
  MissFacts facts;
  facts.frame_ms = 16;
  facts.period_ms = 10;
  facts.cpu_ms = cpu_ms;
  facts.preemptions = preemptions;
  facts.threads = 2;
  return facts;
}

TEST(MissCauseTest, IsTheMachineWherePreemptedWorkWouldHaveFit) {
  // 18 ms on two cores: 9 ms of the 10; on a core for 18 of 2 x 16 = 56 %.
  EXPECT_EQ(cause_of_miss(late(18, 3)), MissCause::machine);
}

TEST(MissCauseTest, IsTheWorkWhereAnyPartOfTheRuleFails) {
  EXPECT_EQ(cause_of_miss(late(18, 0)), MissCause::work) << "nobody took a core: its threads waited";
  EXPECT_EQ(cause_of_miss(late(22, 3)), MissCause::work) << "11 ms of work on each core do not fit into 10";
  MissFacts busy = late(18, 3);
  busy.frame_ms = 11;  // on a core for 18 of 22: 82 %
  EXPECT_EQ(cause_of_miss(busy), MissCause::work);
  MissFacts beside = late(18, 3);
  beside.beside_ms = 1.5;  // decoding a camera image: 1.5 + 9 do not fit
  EXPECT_EQ(cause_of_miss(beside), MissCause::work);
}

TEST(MissCauseTest, IsTheWorkWhereTheKernelDoesNotTell) {
  MissFacts facts = late(18, 3);
  facts.cpu_ms.reset();
  EXPECT_EQ(cause_of_miss(facts), MissCause::work);
  facts = late(18, 3);
  facts.preemptions.reset();
  EXPECT_EQ(cause_of_miss(facts), MissCause::work);
}

}  // namespace
}  // namespace herr
