// Sweeps asked for by name, where the time is short.
#include "server/study/plan/short_plan.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace herr {
namespace {

StudySetting setting(const std::string& knob, const std::string& base, double n,
                     OwnReference own = OwnReference::pixels) {
  StudySetting made;
  made.knob = knob, made.base = base, made.n = n, made.own = own;
  made.value = std::to_string(static_cast<int>(n));
  made.name = knob + " " + std::to_string(static_cast<int>(n)) + ", " + base;
  return made;
}

std::vector<std::string> names_of(const std::vector<StudySetting>& settings) {
  std::vector<std::string> names;
  for (const StudySetting& one : settings) names.push_back(one.name);
  return names;
}

std::vector<StudySetting> three_sweeps() {
  const std::string hard = "N = 1", soft = "N = 64";
  std::vector<StudySetting> all{setting("default", hard, 0), setting("default", soft, 0)};
  for (const double n : {1, 16, 64}) all.push_back(setting("light", "", n, OwnReference::seeds));
  for (const double n : {2, 4, 8}) all.push_back(setting("polar", hard, n));
  for (const double n : {2, 8}) all.push_back(setting("polar", soft, n));
  for (const double n : {0, 2, 4}) all.push_back(setting("edge", hard, n));
  return all;
}

TEST(ShortPlan, TheEndsOfEachSweepComeFirst) {
  EXPECT_EQ(
      names_of(ends_first(three_sweeps())),
      (std::vector<std::string>{"default 0, N = 1", "polar 2, N = 1", "edge 0, N = 1", "polar 8, N = 1",
                                "edge 4, N = 1", "light 1, ", "light 64, ", "light 16, ", "polar 4, N = 1",
                                "edge 2, N = 1", "default 0, N = 64", "polar 2, N = 64", "polar 8, N = 64"}));
}

StudySetting word(const std::string& knob, const std::string& value) {
  StudySetting made = setting(knob, "N = 1", 0);
  made.value = value, made.name = knob + " " + value;
  return made;
}

// Of words the first and the last; a word among numbers lies between them.
TEST(ShortPlan, WordsAreEndsOnlyAmongWords) {
  const std::string hard = "N = 1";
  EXPECT_EQ(names_of(ends_first({word("filter", "nearest"), word("filter", "box"), word("filter", "bicubic"),
                                 word("polar", "acuity"), setting("polar", hard, 2),
                                 setting("polar", hard, 4), setting("polar", hard, 8)})),
            (std::vector<std::string>{"filter nearest", "polar 2, N = 1", "filter bicubic", "polar 8, N = 1",
                                      "filter box", "polar acuity", "polar 4, N = 1"}));
}

// What lies between the ends: one of each sweep in turn, so that none waits for all of another.
TEST(ShortPlan, SweepsTakeTurns) {
  std::vector<StudySetting> all;
  for (const char* knob : {"a", "b"}) {
    for (const double n : {1, 2, 3, 4}) all.push_back(setting(knob, "N = 1", n));
  }
  EXPECT_EQ(names_of(ends_first(all)),
            (std::vector<std::string>{"a 1, N = 1", "b 1, N = 1", "a 4, N = 1", "b 4, N = 1", "a 2, N = 1",
                                      "b 2, N = 1", "a 3, N = 1", "b 3, N = 1"}));
}

// The default is there already: where it is the least of a sweep, the next one is no end.
TEST(ShortPlan, TheDefaultIsAnEndOfItsSweep) {
  const std::string hard = "N = 1";
  EXPECT_EQ(
      names_of(ends_first({setting("edge", hard, 2), setting("edge", hard, 4), setting("edge", hard, 8)},
                          {setting("edge", hard, 0), word("edge", "off")})),
      (std::vector<std::string>{"edge 8, N = 1", "edge 2, N = 1", "edge 4, N = 1"}));
}

TEST(ShortPlan, OfLightSamplesTheCheapOnesComeFirst) {
  std::vector<StudySetting> all;
  for (const double n : {1, 4, 16, 64, 256})
    all.push_back(setting("light_samples", "", n, OwnReference::seeds));
  EXPECT_EQ(names_of(ends_first(all)), names_of(all));
}

// 13 settings of a second, and a reference of 60 for those of `light`. Of 10 s 9.5 are for them: one frame,
// and in turn all but `light` until 9 are there.
TEST(ShortPlan, WhatFitsStaysFramesGoFirst) {
  const std::vector<StudySetting> ordered = ends_first(three_sweeps());
  std::vector<SettingCost> costs;
  for (const StudySetting& one : ordered)
    costs.push_back(one.knob == "light" ? SettingCost{1, "16 seeds", 60} : SettingCost{1, "", 0});
  const StudyBudget budget = fit_in_order(ordered, costs, 3, 10);
  EXPECT_EQ(budget.frames, 1u);
  EXPECT_EQ(names_of(budget.settings),
            (std::vector<std::string>{"default 0, N = 1", "polar 2, N = 1", "edge 0, N = 1", "polar 8, N = 1",
                                      "edge 4, N = 1", "polar 4, N = 1", "edge 2, N = 1", "default 0, N = 64",
                                      "polar 2, N = 64"}));
  EXPECT_EQ(budget.dropped, (std::vector<std::string>{"combinations", "light: 3 settings", "polar: 1 setting",
                                                      "2 of 3 frames"}));
  EXPECT_TRUE(budget.fits);
  // 73 s, 219 of three frames, of 228.
  EXPECT_TRUE(fit_in_order(ordered, costs, 3, 240).dropped.empty());
  EXPECT_EQ(fit_in_order(ordered, costs, 3, 240).settings.size(), ordered.size());
  // The default with hard light alone, and not even that fits.
  const StudyBudget none = fit_in_order(ordered, costs, 3, 1);
  EXPECT_EQ(none.settings.size(), 1u);
  EXPECT_FALSE(none.fits);
}

// What is measured costs nothing and stays, wherever it stands: then 2 more of 4 s fit into 9.5.
TEST(ShortPlan, WhatIsMeasuredStays) {
  const std::vector<StudySetting> ordered = ends_first(three_sweeps());
  std::vector<SettingCost> costs(ordered.size(), SettingCost{4, "", 0});
  costs[0] = costs.back() = {};
  EXPECT_EQ(
      names_of(fit_in_order(ordered, costs, 1, 10).settings),
      (std::vector<std::string>{"default 0, N = 1", "polar 2, N = 1", "edge 0, N = 1", "polar 8, N = 64"}));
}

// 1 + 2 and their reference, which is made once, then 3.
TEST(ShortPlan, TheFirstTakeTheirReferencesOnce) {
  const std::vector<SettingCost> costs{{1, "seeds", 60}, {2, "seeds", 60}, {3, "", 0}};
  EXPECT_EQ(seconds_of_first(costs, 0), 0);
  EXPECT_EQ(seconds_of_first(costs, 2), 63);
  EXPECT_EQ(seconds_of_first(costs, 9), 66);
}

TEST(ShortPlan, SaysOfEachSweepHowManyAreLeftOut) {
  const auto edge_stays = [](const StudySetting& one) { return one.knob == "edge"; };
  EXPECT_EQ(left_out_settings(three_sweeps(), edge_stays),
            (std::vector<std::string>{"default 0, N = 1", "default 0, N = 64", "light: 3 settings",
                                      "polar: 5 settings"}));
  EXPECT_TRUE(left_out_settings({}, edge_stays).empty());
}

}  // namespace
}  // namespace herr
