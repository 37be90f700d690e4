// Which pairs are worth measuring, for points by hand: times multiply, squared errors add.
#include "server/study/plan/combinations.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

MeasuredSetting point(const std::string& knob, SettingChanges changes, double log_time, double error) {
  MeasuredSetting measured;
  measured.setting.knob = knob;
  measured.setting.changes = std::move(changes);
  measured.log_time = log_time, measured.error = error;
  return measured;
}

std::vector<std::string> names_of(const std::vector<StudySetting>& settings) {
  std::vector<std::string> names;
  for (const StudySetting& setting : settings) names.push_back(setting.name);
  return names;
}

using Names = std::vector<std::string>;

const MeasuredSetting kDefault = point("default", {}, 0, 1);

TEST(Combinations, TakeThoseFirstThatGainMostAgainstWhatIsChosenAlready) {
  const std::vector<MeasuredSetting> measured{kDefault, point("polar", {{"polar", "788x384"}}, -0.5, 1.1),
                                              point("filter", {{"filter", "bicubic"}}, 0, 0.9),
                                              point("ray_width", {{"ray_width", "4"}}, 0.05, 0.95)};
  // polar and filter:    time -0.5, error sqrt(1.21 + 0.81 - 1) = 1.010; the fastest is polar, 1.1: ln =
  // 0.085 filter and width:    time 0.05, error sqrt(0.81 + 0.9025 - 1) = 0.844 against 0.9: ln = 0.064 polar
  // and width:     time -0.45, error sqrt(1.21 + 0.9025 - 1) = 1.055 against 1.1: ln = 0.042; against the
  // first pair, which is faster and better, nothing.
  const Names both{"--filter bicubic --polar 788x384", "--filter bicubic --ray-width 4"};
  const std::vector<StudySetting> chosen = combinations({}, measured, 40);
  EXPECT_EQ(names_of(chosen), both);
  EXPECT_EQ(names_of(combinations({}, measured, 1)), Names{both.front()});
  EXPECT_TRUE(combinations({}, measured, 0).empty());
  EXPECT_EQ(chosen[0].knob, "combination");
  EXPECT_EQ(chosen[0].own, OwnReference::pixels);  // hard light
  EXPECT_EQ(chosen[0].changes, (SettingChanges{{"filter", "bicubic"}, {"polar", "788x384"}}));
}

TEST(Combinations, AreForetoldFromWhatBothChangeAlike) {
  std::vector<MeasuredSetting> measured{
      kDefault, point("default", {{"light_samples", "64"}}, 1, 0.5),
      point("polar", {{"polar", "788x384"}}, -0.5, 1.2),
      point("polar", {{"polar", "788x384"}, {"light_samples", "64"}}, 0.6, 0.9),
      point("filter", {{"filter", "bicubic"}, {"light_samples", "64"}}, 1.1, 0.3)};
  // Around soft light: time 0.6 + 1.1 - 1 = 0.7, error sqrt(0.81 + 0.09 - 0.25) = 0.806, below the 0.9 of
  // what is as fast. (Hard polar and soft filter make the same setting; from them it would have time 0.6 and
  // error sqrt(1.44 + 0.09 - 1) = 0.728.)
  const std::vector<StudySetting> chosen = combinations({}, measured, 40);
  ASSERT_EQ(names_of(chosen), Names{"--filter bicubic --polar 788x384 --light-samples 64"});
  EXPECT_EQ(chosen[0].own, OwnReference::none);
  // A point at time 0.65 and error 0.75 is better than 0.806 at 0.7, though not than 0.728 at 0.6.
  measured.push_back(point("uniform", {{"foveation", "off"}}, 0.65, 0.75));
  EXPECT_TRUE(combinations({}, measured, 40).empty());
  // Without what both change alike there is nothing to foretell from.
  std::erase_if(measured, [](const MeasuredSetting& m) { return m.setting.knob == "default"; });
  EXPECT_TRUE(combinations({}, measured, 40).empty());
}

TEST(Combinations, LeaveOutWhatCannotBeOrIsKnown) {
  // Two sizes; another model; rays per pixel, which have no filter.
  MeasuredSetting probes = point("probe_rays", {{"probes", "on"}}, -3, 0.1);
  probes.setting.model = {{"probes", "on"}};
  const std::vector<MeasuredSetting> apart{kDefault,
                                           point("polar", {{"polar", "788x384"}}, -0.5, 0.1),
                                           point("polar", {{"polar", "394x384"}}, -1, 0.1),
                                           probes,
                                           point("uniform", {{"foveation", "off"}}, -3, 0.1),
                                           point("paper", {{"filter", "nearest"}}, -3, 0.1)};
  EXPECT_TRUE(combinations({}, apart, 40).empty());
  // Both together were measured, in another order.
  const std::vector<MeasuredSetting> known{
      kDefault, point("polar", {{"polar", "788x384"}}, -0.5, 0.1),
      point("filter", {{"filter", "bicubic"}}, -0.5, 0.1),
      point("default", {{"filter", "bicubic"}, {"polar", "788x384"}}, 2, 2)};
  EXPECT_TRUE(combinations({}, known, 40).empty());
  EXPECT_TRUE(combinations({}, {}, 40).empty());
}

}  // namespace
}  // namespace herr
