// The search as a run over simulated machines, and what it says.
#include "server/study/rate/rate_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/study/rate/rate_json.h"
#include "server/study/rate/rate_text.h"
#include "tests/server/study/rate/simulated_rate.h"

namespace herr {
namespace {

constexpr double kHz = 90, kPeriod_ms = 1000.0 / 90;

const std::vector<RateSetting>& ladder() {
  static const std::vector<RateSetting> all = rate_ladder({788, 768, 256, 1});
  return all;
}

RateTrial trial_on(const test::RateCost& cost, const RateSetting& setting) {
  RateTrial trial = test::trial_of(test::cost_ms(cost, setting));
  const double scale2 = setting.profile_scale * setting.profile_scale;
  trial.stages[Stage::viewports] = 0.9 * scale2 * cost.pixels_ms;
  trial.stages[Stage::first_hits] = trial.frame_ms - trial.stages[Stage::viewports];
  trial.stages[Stage::idle] = 1000;  // a wait is no stage that prevents anything
  return trial;
}

std::optional<RateAnswer> answer_on(const test::RateCost& cost, double period_ms = kPeriod_ms) {
  return run_rate_search(
      ladder(), period_ms, [&](const RateSetting& setting, bool) { return trial_on(cost, setting); },
      [](const RateSetting&, const RateTrial&) {});
}

// The largest by looking at all of them.
const RateSetting* largest_on(const test::RateCost& cost, double period_ms) {
  const RateSetting* largest = nullptr;
  for (const RateSetting& setting : ladder()) {
    if (test::cost_ms(cost, setting) <= period_ms) largest = &setting;
  }
  return largest;
}

TEST(RateRun, FindsWhatLookingAtAllOfThemFinds) {
  for (const double factor : {1e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0}) {
    SCOPED_TRACE(factor);
    const test::RateCost cost{factor, 50 * factor, 20 * factor, 30 * factor};
    const auto answer = answer_on(cost);
    ASSERT_TRUE(answer);
    const RateSetting* wanted = largest_on(cost, kPeriod_ms);
    ASSERT_EQ(answer->held.has_value(), wanted != nullptr);
    if (wanted != nullptr) {
      EXPECT_EQ(answer->held->setting, *wanted);
    }
    EXPECT_EQ(answer->refused.has_value(), !(wanted != nullptr && *wanted == ladder().back()));
  }
}

TEST(RateRun, TheLongestStageThatIsNoWaitPreventsMore) {
  const auto pixels = answer_on({0.1, 1, 0.1, 40});
  EXPECT_EQ(longest_stage(pixels->limit().trials).name, "viewports");
  const auto rays = answer_on({0.1, 40, 0.1, 1});
  EXPECT_EQ(longest_stage(rays->limit().trials).name, "first_hits");
  RateTrial trial = test::trial_of(10);
  trial.sample_ms = 6, trial.stages[Stage::other] = 5;
  EXPECT_EQ(longest_stage({trial}).name, "sample");
  EXPECT_EQ(longest_stage({trial}).ms, 6);
}

TEST(RateRun, StopsWhenAMeasurementIsAskedTo) {
  int trials = 0;
  const auto measure = [&](const RateSetting& setting, bool) -> std::optional<RateTrial> {
    if (++trials == 3) return std::nullopt;
    return trial_on({}, setting);
  };
  EXPECT_FALSE(run_rate_search(ladder(), kPeriod_ms, measure, [](const RateSetting&, const RateTrial&) {}));
  EXPECT_EQ(trials, 3);
}

// Halves twice and is then told that the time is up: what is known brackets what looking at all finds.
TEST(RateRun, EndedByTheTimeKnowsWhatWasMeasuredAndHowMuchIsOpen) {
  const test::RateCost cost{0.01, 0.5, 0.2, 0.3};
  const RateSetting* wanted = largest_on(cost, kPeriod_ms);
  ASSERT_NE(wanted, nullptr);
  for (const int runs : {1, 2, 4}) {
    SCOPED_TRACE(runs);
    int trials = 0;
    const auto answer = run_rate_search(
        ladder(), kPeriod_ms,
        [&](const RateSetting& setting, bool) {
          ++trials;
          return trial_on(cost, setting);
        },
        [](const RateSetting&, const RateTrial&) {}, [&] { return trials >= runs; });
    ASSERT_TRUE(answer);
    EXPECT_EQ(trials, runs);
    EXPECT_TRUE(answer->ended_early);
    EXPECT_GT(answer->open, 0u);
    EXPECT_LT(answer->open, ladder().size());
    if (answer->held) {
      EXPECT_LE(test::cost_ms(cost, answer->held->setting), test::cost_ms(cost, *wanted));
    }
    if (answer->refused) {
      EXPECT_GT(test::cost_ms(cost, answer->refused->setting), kPeriod_ms);
    }
    EXPECT_EQ(rate_exit_code(*answer), answer->held ? 5 : 4);
  }
  EXPECT_FALSE(answer_on(cost)->ended_early);
  EXPECT_EQ(answer_on(cost)->open, 0u);
}

TEST(RateRun, WhenNotEvenTheSmallestHoldsItIsMeasuredToTheEnd) {
  const auto answer = run_rate_search(
      ladder(), kPeriod_ms,
      [&](const RateSetting& setting, bool to_the_end) {
        EXPECT_EQ(to_the_end, setting == ladder().front());
        return test::trial_of(to_the_end ? 43.0 : 60.0, to_the_end ? 100 : 3);
      },
      [](const RateSetting&, const RateTrial&) {});
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->held);
  EXPECT_EQ(answer->refused->p95_ms, 43);
  EXPECT_EQ(answer->refused->frames(), 300);
  EXPECT_EQ(answer->tried.front().frames(), 300) << "all of it is among what was tried";
}

RateTrial plain_trial(double p95_ms, double longest_ms) {
  RateTrial trial = test::trial_of(p95_ms);
  trial.frame_ms = 9;
  trial.stages[Stage::first_hits] = longest_ms;
  return trial;
}

RateAnswer plain_answer() {
  RateAnswer answer;
  answer.period_ms = kPeriod_ms;
  answer.held = MeasuredRate{
      {394, 384, 1, 0.5}, {plain_trial(10, 3), plain_trial(10.5, 3), plain_trial(10.6, 3)}, 10.5};
  answer.refused = MeasuredRate{{404, 390, 1, 0.51}, {plain_trial(11.5, 3.25)}, 11.5};
  answer.tried = {*answer.held, *answer.refused};
  return answer;
}

TEST(RateText, IsTwoSentencesAndALineToPaste) {
  EXPECT_EQ(
      rate_text({kHz, "xr1", "herr replay walk", ""}, plain_answer()),
      "90 Hz leaves 11.11 ms for a frame, and the largest setting with which this machine holds that is "
      "polar "
      "788x384, light samples 1, profile scale 0.5 of xr1: the 95th percentile of 300 frames in 3 runs "
      "(their "
      "median) is 10.50 ms.\n"
      "The stage that prevents more is first_hits, 3.25 ms of the mean 9.00 ms of a frame of the next "
      "larger, "
      "polar 808x390, light samples 1, profile scale 0.51 of xr1, whose 95th percentile is 11.50 ms.\n"
      "To a viewer: 25 % of the pixels of the viewports (profile scale squared).\n\n"
      "herr replay walk\n");
  EXPECT_EQ(rate_exit_code(plain_answer()), 0);
  EXPECT_TRUE(rate_warnings(plain_answer()).empty());
}

TEST(RateText, WhenEvenTheLargestHoldsNoStageIsBlamed) {
  RateAnswer answer = plain_answer();
  answer.refused.reset();
  EXPECT_EQ(
      rate_text({kHz, "xr1", "herr replay walk", ""}, answer),
      "90 Hz leaves 11.11 ms for a frame, and this machine holds that even with the largest setting that was "
      "tried, polar 788x384, light samples 1, profile scale 0.5 of xr1: the 95th percentile of 300 frames in "
      "3 "
      "runs (their median) is 10.50 ms.\n"
      "No stage prevents more (the longest is first_hits, 3.00 ms of the mean 9.00 ms); --polar, "
      "--light-samples, --profile and --profile-scale say the most that is tried.\n"
      "To a viewer: 25 % of the pixels of the viewports (profile scale squared).\n\n"
      "herr replay walk\n");
  EXPECT_EQ(rate_exit_code(answer), 0);
}

// 1000 / 43 = 23.26: 23.2 is what it is enough for.
TEST(RateText, WhenNotEvenTheSmallestHoldsThereIsNothingToPaste) {
  RateAnswer answer;
  answer.period_ms = kPeriod_ms;
  answer.refused = MeasuredRate{{98, 192, 1, 0.1}, {plain_trial(43, 30)}, 43};
  answer.tried = {*answer.refused};
  EXPECT_EQ(rate_text({kHz, "xr1", "", ""}, answer),
            "90 Hz leaves 11.11 ms for a frame, and this machine holds that with no setting down to polar "
            "196x192, light samples 1, profile scale 0.1 of xr1 (an eighth of the width and a quarter of the "
            "height of --polar): there the 95th percentile of 100 frames is 43.00 ms, enough for 23.2 Hz.\n"
            "The stage that prevents it is first_hits, 30.00 ms of the mean 9.00 ms.\n");
  EXPECT_EQ(rate_exit_code(answer), 1);
  answer.refused->trials.back().hopeless = true;
  const std::string hopeless = rate_text({kHz, "xr1", "", "herr study --polar 788x384", "with half"}, answer);
  EXPECT_NE(hopeless.find("enough for 23.2 Hz; each of them took more than 3 times as long as it may, so "
                          "that one short run was enough.\n"),
            std::string::npos)
      << hopeless;
  answer.refused->trials.push_back(answer.refused->trials.back());
  EXPECT_NE(rate_text({kHz, "xr1", "", ""}, answer)
                .find("; each of the last run took more than 3 times as long as it may, so that it was not "
                      "repeated.\n"),
            std::string::npos);
  EXPECT_TRUE(hopeless.ends_with("\nTo try next, with half:\nherr study --polar 788x384\n")) << hopeless;
  answer.tried.front().trials.front().machine.late = 4;
  answer.tried.front().trials.front().machine.late_by_machine = 3;
  EXPECT_EQ(rate_exit_code(answer), 4) << "a busy machine cannot tell";
}

// 2 runs took 12 s; 6 more take 36: 48 s, with half as much again 72 s, in whole minutes 2.
TEST(RateText, OfASearchThatEndedEarlySaysWhatIsOpenAndHowManyMinutesItTakes) {
  RateAnswer answer = plain_answer();
  answer.held->trials.resize(1);
  answer.tried = {*answer.held, *answer.refused};
  answer.ended_early = true, answer.open = 3, answer.runs_to_go = 6;
  EXPECT_EQ(rate_text({kHz, "xr1", "herr replay walk", ""}, answer),
            "90 Hz leaves 11.11 ms for a frame, and the search ended before its answer: of what was measured "
            "the largest setting that holds is polar 788x384, light samples 1, profile scale 0.5 of xr1, the "
            "95th percentile of 100 frames is 10.50 ms.\n"
            "Below polar 808x390, light samples 1, profile scale 0.51 of xr1, which does not hold (11.50 ms, "
            "most of it first_hits, 3.25 ms of the mean 9.00 ms), 3 settings are open.\n"
            "To a viewer: 25 % of the pixels of the viewports (profile scale squared).\n\n"
            "herr replay walk\n");
  EXPECT_EQ(
      too_few_minutes_text(0.1, 12, {{{{}, answer}}, {}}),
      "--minutes 0.1 ended the search after 2 runs, and it takes about 6 more; give --minutes 2 or more");
  EXPECT_EQ(rate_exit_code(answer), 5);
  EXPECT_EQ(rate_json({kHz, "xr1", "x", ""}, answer)["open_settings"], 3);
  answer.held.reset(), answer.refused.reset();
  const std::string neither = rate_text({kHz, "xr1", "", ""}, answer);
  EXPECT_NE(neither.find("no setting that was measured holds that.\nOf all others 3 settings are open."),
            std::string::npos)
      << neither;
  EXPECT_TRUE(rate_warnings(answer).empty());
  EXPECT_TRUE(rate_json({kHz, "xr1", "", ""}, answer)["prevented_by"].is_null());
  EXPECT_EQ(rate_exit_code(answer), 4);
}

// Where the trial of the median lies: 10.5, whose second stretch is the heaviest.
TEST(RateText, OfSeveralStretchesNamesTheHeaviestAndWhereItMeasured) {
  RateAnswer answer = plain_answer();
  RateTrial& median = answer.held->trials[1];
  median.stretches = {{0.8, 1.2, 25, 9}, {2.5, 2.91, 25, 10.5}, {4, 4.4, 25, 8}};
  median.all_p95_ms = 9.75;
  median.frames = 101;
  answer.tried = {*answer.held, *answer.refused};
  const std::string text = rate_text({kHz, "xr1", "herr replay walk", ""}, answer);
  EXPECT_NE(text.find("the 95th percentile of the heaviest of 3 stretches, 2.5\u20132.9 s, is 10.50 ms (301 "
                      "frames in 3 runs, their median; of all stretches together 9.75 ms).\n"),
            std::string::npos)
      << text;
  EXPECT_NE(
      text.find("\nMeasured at 0.8\u20131.2 s, 2.5\u20132.9 s and 4.0\u20134.4 s of the session; what lies "
                "between was not.\n"),
      std::string::npos)
      << text;
  const auto json = rate_json({kHz, "xr1", "x", ""}, answer);
  EXPECT_EQ(json["held"]["runs"][1]["stretches"][1]["p95_ms"], 10.5);
  EXPECT_EQ(json["held"]["runs"][1]["all_p95_ms"], 9.75);
}

// 0.5 squared is 25 %; 1000 / 30 = 33.33. The trial of the median, 10.5, has the acuity.
TEST(RateText, SaysWhatTheSettingIsToAViewerAndTheRateAtAllPixels) {
  RateAnswer answer = plain_answer();
  answer.held->trials[1].k_radial = 91.25, answer.held->trials[1].k_angular = 65.5;
  answer.tried.push_back({{788, 768, 1, 1}, {test::trial_of(30, 3)}, 30});
  answer.tried.push_back({{788, 768, 8, 1}, {test::trial_of(60, 3)}, 60});
  const std::string text = rate_text({kHz, "xr1", "herr replay walk", ""}, answer);
  EXPECT_NE(
      text.find("To a viewer: 25 % of the pixels of the viewports (profile scale squared); acuity at the "
                "gaze: k radial 91.2, k angular 65.5 (samples per degree times theta + 1; 200 / (theta "
                "+ 1) asks for 200).\n"
                "With all pixels (profile scale 1) the smallest that was measured, polar 1576x768, "
                "light samples 1, is enough for 33.3 Hz (30.00 ms, 3 frames).\n"),
      std::string::npos)
      << text;
  const auto json = rate_json({kHz, "xr1", "x", ""}, answer);
  EXPECT_EQ(json["held"]["viewport_pixels_share"], 0.25);
  EXPECT_EQ(json["held"]["k_angular"], 65.5);
  EXPECT_TRUE(json["tried"][2]["k_radial"].is_null());
}

TEST(RateText, NamesTheFlagThatLeavesTheStageOut) {
  RateAnswer answer = plain_answer();
  answer.held.reset();
  answer.refused->trials.front().stages[Stage::probe_rays] = 5;
  answer.tried = {*answer.refused};
  const std::string text =
      rate_text({kHz, "xr1", "", "herr study walk --hz 90 --occlusion-rays 0 --no-probes"}, answer);
  EXPECT_NE(text.find("The stage that prevents it is probe_rays (--no-probes leaves it out), 5.00 ms of the "
                      "mean 9.00 ms.\n"),
            std::string::npos)
      << text;
  EXPECT_TRUE(
      text.ends_with("\nTo try next, without what flags leave out:\nherr study walk --hz 90 "
                     "--occlusion-rays 0 --no-probes\n"))
      << text;
  EXPECT_EQ(rate_json({kHz, "xr1", "", ""}, answer)["prevented_by"]["remedy"], "--no-probes leaves it out");
}

TEST(RateText, WarnsOfABusyMachineAndOfNoise) {
  RateAnswer answer = plain_answer();
  answer.tried.front().trials.front().machine.late = 10;
  answer.tried.front().trials.front().machine.late_by_machine = 9;
  answer.held->trials.front().p95_ms = 8;  // 8 ... 10.6: 25 % of 10.5
  const std::vector<std::string> warnings = rate_warnings(answer);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("9 of 10 late frames for the machine alone"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("of the 3 runs differ by 25 %"), std::string::npos) << warnings[1];
}

TEST(RateJson, TellsWhatWasTriedAndWhatPreventsMore) {
  const nlohmann::ordered_json json = rate_json({kHz, "xr1", "herr replay walk", ""}, plain_answer());
  EXPECT_EQ(json["hz"], 90);
  EXPECT_EQ(json["holds"], true);
  EXPECT_EQ(json["held"]["polar"], "788x384");
  EXPECT_EQ(json["held"]["polar_width_per_eye"], 394);
  EXPECT_EQ(json["held"]["p95_ms"], 10.5);
  EXPECT_EQ(json["held"]["frames"], 300);
  EXPECT_EQ(json["held"]["runs"].size(), 3u);
  EXPECT_EQ(json["prevented_by"]["stage"], "first_hits");
  EXPECT_EQ(json["prevented_by"]["setting"]["holds"], false);
  EXPECT_EQ(json["machine"]["busy"], false);
  EXPECT_EQ(json["tried"].size(), 2u);
  RateAnswer all = plain_answer();
  all.refused.reset();
  EXPECT_TRUE(rate_json({kHz, "xr1", "x", ""}, all)["prevented_by"].is_null());
}

}  // namespace
}  // namespace herr
