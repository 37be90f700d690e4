// What free cores would hold, from the CPU time of frames on a busy machine: an estimate.
#include "server/study/rate/free_cores.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/study/rate/rate_json.h"
#include "tests/server/study/rate/simulated_rate.h"

namespace herr {
namespace {

constexpr double kPeriod_ms = 10;

// 20 ms of a frame, of which 18 are rendering; 14 ms of CPU time on two cores are 7 ms: 11 were waits.
TEST(FreeFrame, TakesItsCpuTimeSpreadOverItsCoresAndWhatIsBesideIt) {
  EXPECT_EQ(free_frame_ms(20, 18, 14, 2), 9);
  EXPECT_EQ(free_frame_ms(20, 18, 36, 2), 20) << "nobody waited";
  EXPECT_EQ(free_frame_ms(20, 18, 36.5, 2), 20) << "clocks differ a little; no longer than it took";
  EXPECT_EQ(free_frame_ms(20, 18, 14, 1), 16);
}

MeasuredRate measured(const RateSetting& setting,
                      const std::vector<std::pair<double, double>>& p95_and_free) {
  MeasuredRate rate;
  rate.setting = setting;
  for (const auto& [p95_ms, free_ms] : p95_and_free) {
    rate.trials.push_back(test::trial_of(p95_ms));
    rate.trials.back().free_p95_ms = free_ms;
    rate.trials.back().machine.late = 2;
    rate.trials.back().machine.late_by_machine = 2;
  }
  rate.p95_ms = rate.trials.front().p95_ms;
  return rate;
}

// The smallest is not held where it was measured; on free cores 4, 7 and 9 ms would be in time, 12 would not.
// Of the second three trials gave 9, 6 and 7: 7.
RateAnswer busy_answer() {
  RateAnswer answer;
  answer.period_ms = kPeriod_ms;
  answer.tried = {measured({98, 192, 1, 0.1}, {{14, 4}}),
                  measured({150, 240, 1, 0.2}, {{20, 9}, {18, 6}, {19, 7}}),
                  measured({200, 300, 1, 0.3}, {{30, 9}}), measured({300, 400, 1, 0.4}, {{50, 12}}),
                  measured({400, 500, 1, 0.5}, {{60, 9.5}})};
  answer.refused = answer.tried.front();
  return answer;
}

TEST(FreeCores, HoldTheLargestMeasuredBelowTheFirstThatTheyDoNot) {
  const auto free = free_cores_of(busy_answer());
  ASSERT_TRUE(free && free->holds && free->refused);
  EXPECT_EQ(free->holds->setting, (RateSetting{200, 300, 1, 0.3}));
  EXPECT_EQ(free->holds->p95_ms, 9);
  EXPECT_EQ(free->refused->setting, (RateSetting{300, 400, 1, 0.4})) << "9.5 ms of a larger one is luck";
  EXPECT_EQ(free_cores_text(*free),
            "a setting that holds is polar 400x300, light samples 1, profile scale 0.3 (about 9.00 ms), the "
            "next measured, which does not, polar 600x400, light samples 1, profile scale 0.4 (about 12.00 "
            "ms)");
  RateAnswer second = busy_answer();
  second.tried.resize(2);
  EXPECT_EQ(free_cores_of(second)->holds->p95_ms, 7) << "the median";
  EXPECT_EQ(free_cores_text(*free_cores_of(second)),
            "even the largest that was measured holds, polar 300x240, light samples 1, profile scale 0.2 "
            "(about 7.00 ms)");
  second.period_ms = 3;
  EXPECT_EQ(
      free_cores_text(*free_cores_of(second)),
      "not even the smallest that was measured holds, polar 196x192, light samples 1, profile scale 0.1 "
      "(about 4.00 ms)");
}

TEST(FreeCores, AreEstimatedOnlyOfABusyMachineThatTellsCpuTimes) {
  RateAnswer quiet = busy_answer();
  for (MeasuredRate& each : quiet.tried) {
    for (RateTrial& trial : each.trials) trial.machine.late_by_machine = 0;
  }
  EXPECT_FALSE(free_cores_of(quiet));
  RateAnswer unknown = busy_answer();
  unknown.tried.back().trials.back().free_p95_ms.reset();
  EXPECT_FALSE(free_cores_of(unknown));
  EXPECT_FALSE(free_cores_of({}));
}

TEST(FreeCores, AreAWarningAndAFieldAndNeverTheAnswer) {
  const RateAnswer answer = busy_answer();
  const auto warnings = rate_warnings(answer);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[1].find("an estimate for cores that nobody else has, not measured: a setting that holds "
                             "is polar 400x300"),
            0u)
      << warnings[1];
  EXPECT_EQ(rate_exit_code(answer), 4);
  const auto json = rate_json({100, "xr1", "", ""}, answer);
  EXPECT_EQ(json["holds"], false);
  EXPECT_EQ(json["held"], nullptr);
  EXPECT_EQ(json["estimate_for_free_cores"]["holds"]["polar"], "400x300");
  EXPECT_EQ(json["estimate_for_free_cores"]["holds_not"]["p95_ms"], 12);
  EXPECT_EQ(json["tried"][1]["runs"][2]["free_p95_ms"], 7);

  const RateChain chain{{{{}, answer}, {{{"probes", "off"}}, answer}}, {}};
  const auto of_steps = rate_warnings(chain);
  ASSERT_EQ(of_steps.size(), 3u);
  EXPECT_NE(of_steps[1].find("not measured, of what was asked: "), std::string::npos) << of_steps[1];
  EXPECT_NE(of_steps[2].find("not measured, with --no-probes: "), std::string::npos) << of_steps[2];
}

}  // namespace
}  // namespace herr
