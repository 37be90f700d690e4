// The steps of `herr study --hz` on a simulated machine: less is asked until something holds.
#include "server/study/rate/rate_chain.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "server/study/rate/rate_json.h"
#include "tests/server/study/rate/simulated_rate.h"

namespace herr {
namespace {

constexpr double kHz = 100, kPeriod_ms = 10;

// Milliseconds of a frame by what it has; samples are of both polar buffers.
struct Machine {
  double probes_ms = 0, occlusion_ms = 0, feed_ms = 0, ms_per_smallest = 1;  // of 98 x 192 samples an eye
  int asked = 0, steps = 0;
  std::vector<std::string> told{};

  RateTrial trial(const RenderSettings& render, const RateSetting& setting) const {
    RateTrial trial;
    trial.frames = 100;
    StageTimes& stages = trial.stages;
    stages[Stage::probe_rays] = render.probes.on ? probes_ms : 0;
    stages[Stage::occlusion] = render.occlusion_rays > 0 ? occlusion_ms : 0;
    stages[Stage::viewports] = render.camera ? feed_ms : 0;
    stages[Stage::first_hits] =
        ms_per_smallest * setting.polar_width * setting.polar_height / (98.0 * 192) * setting.light_samples;
    for (const double ms : stages.ms) trial.frame_ms += ms;
    trial.p95_ms = trial.all_p95_ms = trial.frame_ms;
    return trial;
  }
  std::optional<AskedRate> ask(const RenderSettings& render) {
    ++asked;
    const std::vector<RateSetting> ladder = rate_ladder({render.polar_width, render.polar_height, 1, 1});
    const auto answer = run_rate_search(
        ladder, kPeriod_ms, [&](const RateSetting& setting, bool) { return trial(render, setting); },
        [](const RateSetting&, const RateTrial&) {});
    FramePlan plan;
    plan.camera = feed_ms > 0 && render.camera;
    return AskedRate{*answer, plan};
  }
  std::optional<RateChain> run(const RateTimeIsUp& time_is_up = {}) {
    return run_rate_chain(
        {}, [this](const RenderSettings& render) { return ask(render); },
        [this](const MeasuredRate&, const NextTry& next) { told.push_back(flags_text(next.changes)); },
        time_is_up);
  }
};

// Of the smallest frame, 20 + 0.9 + 11 ms, occlusion is 2.8 %: probes alone go. Then it is 0.9 of 11.9 ms,
// 7.6 %, and goes. 11 ms are too many: of half of --polar, 788x384, the smallest has 49 x 96 samples, 2.75
// ms, and 10 ms hold 10 / 11 * 98 * 192 = 17,105 of them.
TEST(RateChain, LeavesOutOneThingAfterTheOtherUntilASettingHolds) {
  Machine machine{20, 0.9, 0, 11};
  const auto chain = machine.run();
  ASSERT_TRUE(chain);
  EXPECT_EQ(machine.told, (std::vector<std::string>{"--no-probes", "--occlusion-rays 0", "--polar 788x384"}));
  ASSERT_EQ(chain->steps.size(), 4u);
  EXPECT_EQ(machine.asked, 4);
  EXPECT_TRUE(chain->asked().refused);
  EXPECT_FALSE(chain->asked().held);
  EXPECT_NEAR(chain->asked().refused->p95_ms, 31.9, 1e-9);
  EXPECT_NEAR(chain->steps[1].answer.refused->p95_ms, 11.9, 1e-9);
  EXPECT_NEAR(chain->steps[2].answer.refused->p95_ms, 11, 1e-9);
  EXPECT_EQ(flags_text(chain->last().changes), "--no-probes --occlusion-rays 0 --polar 788x384");
  ASSERT_TRUE(chain->last().answer.held);
  const RateSetting& held = chain->last().answer.held->setting;
  EXPECT_LE(held.polar_width * held.polar_height, 17105);
  EXPECT_GE(held.polar_width * held.polar_height, 17105 / 1.08);
  EXPECT_TRUE(chain->holds_with_changes());
  EXPECT_FALSE(chain->to_try);
  EXPECT_EQ(rate_exit_code(*chain), 1) << "what was asked does not hold";
}

TEST(RateChain, WhatHoldsAsAskedIsNotChanged) {
  Machine machine{1, 0.5, 0, 0.1};
  const auto chain = machine.run();
  ASSERT_TRUE(chain);
  EXPECT_EQ(chain->steps.size(), 1u);
  EXPECT_TRUE(chain->last().changes.empty());
  EXPECT_TRUE(machine.told.empty());
  EXPECT_FALSE(chain->holds_with_changes());
  EXPECT_EQ(rate_exit_code(*chain), 0);
  EXPECT_EQ(rate_json({kHz, "xr1", "line", ""}, *chain)["changes"], nullptr);
}

// 20 ms of pixels are too many whatever else goes. Over the feed it goes, and 1 ms is left. Where they stay,
// 1000 / 21 = 47.6 Hz is what the smallest is enough for: another question, which is not asked.
TEST(RateChain, EndsWhereNothingIsLeftToLeaveOut) {
  Machine feed{0, 0, 20, 1};
  const auto without_feed = feed.run();
  EXPECT_EQ(feed.told, std::vector<std::string>{"--no-camera"});
  EXPECT_TRUE(without_feed->holds_with_changes());

  Machine pixels{0, 0, 20, 1};
  const auto chain = run_rate_chain(
      {},
      [&](const RenderSettings& render) {
        return AskedRate{pixels.ask(render)->answer, {}};
      },
      [](const MeasuredRate&, const NextTry&) { FAIL() << "there is no step"; });
  ASSERT_EQ(chain->steps.size(), 1u);
  EXPECT_TRUE(chain->to_try);
  EXPECT_EQ(chain->next.hz, 47);
  EXPECT_FALSE(chain->ended_early);
  EXPECT_EQ(rate_exit_code(*chain), 1);
}

// As in the first test, and the time is over once the first step is done.
TEST(RateChain, BeginsNoStepAfterItsTime) {
  Machine machine{20, 0.9, 0, 11};
  const auto chain = machine.run([&] { return machine.asked == 2; });
  ASSERT_EQ(chain->steps.size(), 2u);
  EXPECT_TRUE(chain->ended_early);
  EXPECT_TRUE(chain->to_try);
  EXPECT_EQ(flags_text(chain->next.changes), "--occlusion-rays 0");
  EXPECT_EQ(flags_text(chain->last().changes), "--no-probes");
  EXPECT_EQ(rate_exit_code(*chain), 1);
  const std::string words = too_few_minutes_text(0.5, 30, *chain);
  EXPECT_EQ(words.find("--minutes 0.5 ended the search after "), 0u) << words;
  EXPECT_EQ(too_few_minutes_text(0.5, 30, *Machine{20, 0.9, 0, 11}.run()), "");
}

TEST(RateChain, StopsWhenItIsAskedTo) {
  Machine machine{20, 0.9, 0, 11};
  const auto chain = run_rate_chain(
      {},
      [&](const RenderSettings& render) {
        return machine.asked == 2 ? std::optional<AskedRate>() : machine.ask(render);
      },
      [](const MeasuredRate&, const NextTry&) {});
  EXPECT_FALSE(chain);
}

TEST(RateChain, ABusyMachineCannotTellWhatHoldsAsAsked) {
  auto chain = Machine{20, 0.9, 0, 11}.run();
  MachineUse& use = chain->steps.front().answer.tried.front().trials.front().machine;
  use.late = 4, use.late_by_machine = 3;
  EXPECT_EQ(rate_exit_code(*chain), 4);
  EXPECT_EQ(rate_warnings(*chain).size(), 1u) << "of all steps";
}

TEST(RateText, OfStepsSaysThatWhatWasAskedDoesNotHoldAndWithWhichChangesItDoes) {
  const auto chain = Machine{20, 0.9, 0, 11}.run();
  const std::string text = rate_text({kHz, "xr1", "herr replay walk", ""}, *chain);
  const auto tells = [&](const std::string& words) { return text.find(words) != std::string::npos; };
  EXPECT_EQ(text.find("100 Hz leaves 10.00 ms for a frame, and this machine holds that with no setting down "
                      "to polar 196x192"),
            0u)
      << text;
  EXPECT_TRUE(
      tells("The stage that prevents it is probe_rays (--no-probes leaves it out), 20.00 ms of the "
            "mean 31.90 ms.\n"))
      << text;
  EXPECT_TRUE(
      tells("\n\nWhat was asked does not hold; changed by --no-probes --occlusion-rays 0 --polar "
            "788x384 it does:\n100 Hz leaves 10.00 ms for a frame, and the largest setting with "
            "which this machine holds that is polar "))
      << text;
  EXPECT_TRUE(text.ends_with("\n\nherr replay walk\n")) << text;

  const auto json = rate_json({kHz, "xr1", "herr replay walk", ""}, *chain);
  EXPECT_EQ(json["holds"], false);
  EXPECT_EQ(json["holds_with_changes"], true);
  EXPECT_EQ(json["changes"], "--no-probes --occlusion-rays 0 --polar 788x384");
  EXPECT_EQ(json["steps"].size(), 4u);
  EXPECT_EQ(json["steps"][0]["changes"], nullptr);
  EXPECT_EQ(json["steps"][0]["prevented_by"]["stage"], "probe_rays");
  EXPECT_EQ(json["steps"][3]["holds"], true);
  EXPECT_EQ(json["held"]["polar"], json["steps"][3]["held"]["polar"]);
}

}  // namespace
}  // namespace herr
