// How far times can be trusted, from rows by hand.
#include "server/study/findings/study_timing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace herr {
namespace {

StudyRow row_of(const std::string& flags, std::vector<double> log_ratios) {
  StudyRow row;
  row.flags = flags;
  row.log_ratios = std::move(log_ratios);
  row.cpu_ms = 180, row.cores_ms = 200;
  row.preemptions = 3;
  return row;
}

TEST(StudyTiming, SpreadIsOfPairsAboutTheMiddleOfTheirSettingAndAboutOneForTheDefault) {
  // Deviations 0.04 four times, of the default from 0, and 0.04 four times, of the other from 0.5.
  const std::vector<StudyRow> rows{row_of("", {0.04, 0.04, 0.04, -0.04}),
                                   row_of("--filter nearest", {0.46, 0.54, 0.46, 0.54}), StudyRow()};
  const StudyTiming timing = timing_of(rows);
  EXPECT_EQ(timing.pairs, 8);
  EXPECT_NEAR(timing.spread, std::expm1(1.4826 * 0.04), 1e-12);
  EXPECT_EQ(timing.preemptions, 6);
  ASSERT_TRUE(timing.cpu_share);
  EXPECT_NEAR(*timing.cpu_share, 0.9, 1e-12);
  EXPECT_EQ(timing.sentence, timing_text(timing));
  EXPECT_EQ(timing_of({}).spread, 0);
  EXPECT_FALSE(timing_of({}).cpu_share);
}

StudyTiming timing(double spread, double preemptions, std::optional<double> cpu_share) {
  StudyTiming timing;
  timing.spread = spread, timing.preemptions = preemptions, timing.cpu_share = cpu_share;
  return timing;
}

TEST(StudyTiming, SaysInOneLineHowUncertainRatiosAreAndOfABusyMachineWhatToDo) {
  const std::string quiet = "repeats of one setting differ by 2.0 %";
  EXPECT_EQ(timing_text(timing(0.02, 100, 0.95)), quiet) << "preempted, but it had the cores";
  EXPECT_EQ(timing_text(timing(0.02, 0, 0.5)), quiet) << "nobody took a core: its threads waited";
  EXPECT_EQ(
      timing_text(timing(0.062, 240, 0.61)),
      "the machine was busy, and ratios are uncertain by 6.2 %, as repeats of one setting differ (threads "
      "had 61 % of their cores, 240 preemptions): take smaller differences of time for none, or study "
      "again when the machine is quiet");
  EXPECT_NE(timing_text(timing(0.01, 240, 0.61)).find("uncertain by 1.0 %"), std::string::npos);
  EXPECT_NE(timing_text(timing(0.2, 0, {})).find("threads had n/a of"), std::string::npos);
}

}  // namespace
}  // namespace herr
