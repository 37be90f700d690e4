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
      (std::vector<std::string>{"default 0, N = 1", "default 0, N = 64", "polar 2, N = 1", "polar 8, N = 1",
                                "edge 0, N = 1", "edge 4, N = 1", "light 1, ", "light 64, ", "light 16, ",
                                "polar 4, N = 1", "edge 2, N = 1", "polar 2, N = 64", "polar 8, N = 64"}));
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
            (std::vector<std::string>{"default 0, N = 1", "default 0, N = 64", "polar 2, N = 1",
                                      "polar 8, N = 1", "edge 0, N = 1", "edge 4, N = 1", "polar 4, N = 1",
                                      "edge 2, N = 1", "polar 2, N = 64"}));
  EXPECT_EQ(budget.dropped, (std::vector<std::string>{"combinations", "light: 3 settings", "polar: 1 setting",
                                                      "2 of 3 frames"}));
  // 73 s, 219 of three frames, of 228.
  EXPECT_TRUE(fit_in_order(ordered, costs, 3, 240).dropped.empty());
  EXPECT_EQ(fit_in_order(ordered, costs, 3, 240).settings.size(), ordered.size());
}

}  // namespace
}  // namespace herr
