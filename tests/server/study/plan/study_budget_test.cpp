// What is dropped first when the time is short.
#include "server/study/plan/study_budget.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace herr {
namespace {

StudySetting setting(const std::string& knob, const std::string& base) {
  StudySetting made;
  made.knob = knob, made.base = base;
  made.name = knob + ", " + base;
  return made;
}

// Ten settings, six of them never dropped; each takes a second.
std::vector<StudySetting> ten_settings() {
  std::vector<StudySetting> all;
  for (const char* knob : {"default", "light_samples", "polar", "filter", "ray_width"}) {
    all.push_back(setting(knob, "N = 1"));
    all.push_back(setting(knob, "N = 64"));
  }
  return all;
}

StudyBudget budget_of(double seconds, std::vector<StudySetting> settings = ten_settings()) {
  return fit_to_time(settings, std::vector<double>(settings.size(), 1.0), 3, seconds);
}

bool is_kept(const StudySetting& one) {
  return one.knob == "default" || one.knob == "light_samples" || one.knob == "polar";
}

using Texts = std::vector<std::string>;

// 10 settings on 3 frames take 30 s, of which 95 % of the time are for; combinations want 10 % at least.
TEST(StudyBudget, DropsCombinationsThenKnobsThenFrames) {
  struct Case {
    double seconds;
    std::size_t settings, frames;
    Texts dropped;
  };
  const Texts soft{"combinations", "ray_width, N = 64: 1 setting", "filter, N = 64: 1 setting"};
  const auto and_then = [](Texts texts, const Texts& more) {
    texts.insert(texts.end(), more.begin(), more.end());
    return texts;
  };
  const Texts all = and_then(soft, {"ray_width: 1 setting", "filter: 1 setting"});
  for (const Case& one : {
           Case{1000, 10, 3, {}},
           Case{36, 10, 3, {}},                                       // 30 <= 0.85 * 36
           Case{33, 10, 3, {"combinations"}},                         // 30 > 0.85 * 33
           Case{30, 9, 3, {soft[0], soft[1]}},                        // 27 <= 28.5 < 30
           Case{26, 8, 3, soft},                                      // 24 <= 24.7 < 27
           Case{23, 7, 3, and_then(soft, {"ray_width: 1 setting"})},  // 21 <= 21.85 < 24
           Case{19, 6, 3, all},                                       // 18 <= 18.05 < 21
           Case{13, 6, 2, and_then(all, {"1 of 3 frames"})},          // 12 <= 12.35 < 18
           Case{0.1, 6, 1, and_then(all, {"2 of 3 frames"})},
       }) {
    const StudyBudget budget = budget_of(one.seconds);
    EXPECT_EQ(budget.settings.size(), one.settings) << one.seconds;
    EXPECT_EQ(budget.frames, one.frames) << one.seconds;
    EXPECT_EQ(budget.dropped, one.dropped) << one.seconds;
    EXPECT_EQ(std::count_if(budget.settings.begin(), budget.settings.end(), is_kept), 6) << one.seconds;
    EXPECT_EQ(budget.fits, one.seconds > 1) << one.seconds;  // the six that stay take 6 s
  }
}

TEST(StudyBudget, DropsKnobsWhereverTheyStandInTheList) {
  std::vector<StudySetting> settings = ten_settings();
  std::reverse(settings.begin(), settings.end());
  const StudyBudget budget = budget_of(0.1, settings);
  EXPECT_EQ(budget.settings.size(), 6u);
  EXPECT_TRUE(std::all_of(budget.settings.begin(), budget.settings.end(), is_kept));
  // Nothing that must be kept.
  EXPECT_TRUE(budget_of(0.1, {setting("filter", "N = 1"), setting("filter", "N = 64")}).settings.empty());
}

// Rays per pixel and the paper's settings are compared for every light: they go whole, or stay.
TEST(StudyBudget, KeepsSoftLightOfRaysPerPixelAndOfThePaper) {
  const std::vector<StudySetting> settings{setting("default", "N = 1"),  setting("uniform", "N = 1"),
                                           setting("uniform", "N = 64"), setting("paper", "N = 64"),
                                           setting("filter", "N = 1"),   setting("filter", "N = 64")};
  // 18 s; without soft filters 15, without filters 12: 0.95 * 13 = 12.35.
  const StudyBudget budget = budget_of(13, settings);
  EXPECT_EQ(budget.dropped, (Texts{"combinations", "filter, N = 64: 1 setting", "filter: 1 setting"}));
  EXPECT_EQ(budget.settings.size(), 4u);
}

}  // namespace
}  // namespace herr
