// Changes of settings as names and texts: what they make, what they are called.
#include "server/settings/setting_changes.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "renderer/settings_list.h"

namespace herr {
namespace {

std::vector<std::string> texts_of(RenderSettings settings) {
  std::vector<std::string> texts;
  for (const Setting& setting : settings_of(settings)) texts.push_back(setting.name + " " + text_of(setting));
  return texts;
}

TEST(SettingChanges, WhatLiesBetweenTwoSettingsLeadsFromOneToTheOther) {
  const RenderSettings defaults;
  RenderSettings all = defaults;
  for (std::size_t i = 0; i < settings_of(all).size(); ++i) {
    RenderSettings one = defaults;
    for (RenderSettings* changed : {&one, &all}) {
      const std::vector<Setting> rows = settings_of(*changed);
      set_text(rows[i], other_text(rows[i]));
    }
    RenderSettings any = defaults;
    const std::string name = settings_of(any)[i].name;
    const SettingChanges changes = changes_between(defaults, one);
    ASSERT_EQ(changes.size(), 1u) << name;
    EXPECT_EQ(changes.front().first, name);
    EXPECT_EQ(texts_of(with_changes(defaults, changes)), texts_of(one)) << name;
  }
  const SettingChanges changes = changes_between(defaults, all);
  EXPECT_EQ(changes.size(), texts_of(defaults).size());
  EXPECT_EQ(texts_of(with_changes(defaults, changes)), texts_of(all));
  EXPECT_TRUE(changes_between(all, all).empty());
}

TEST(SettingChanges, ChangesAreToldAsFlags) {
  EXPECT_EQ(flags_text({}), "");
  EXPECT_EQ(flags_text({{"polar", "788x384"}, {"light_samples", "64"}}),
            "--polar 788x384 --light-samples 64");
  EXPECT_EQ(flags_text({{"reflections", "off"}, {"probes", "on"}}), "--no-reflections --probes");
  EXPECT_EQ(flags_text({{"occlusion_rays", "0"}, {"probes", "off"}}), "--occlusion-rays 0 --no-probes");
  // No flag gives these.
  EXPECT_EQ(flags_text({{"light_sampler", "random"}}), "light_sampler=random");
  EXPECT_EQ(flags_text({{"reflections", "on"}}), "reflections=on");
}

TEST(SettingChanges, TheLaterOfTwoValuesCountsInTheFirstPlace) {
  const SettingChanges both =
      merged({{"filter", "nearest"}, {"seed", "2"}}, {{"seed", "3"}, {"scale", "0.5"}});
  EXPECT_EQ(both, (SettingChanges{{"filter", "nearest"}, {"seed", "3"}, {"scale", "0.5"}}));
}

TEST(SettingChanges, UnknownNamesAndValuesAreRefused) {
  EXPECT_THROW(with_changes({}, {{"filters", "nearest"}}), std::invalid_argument);
  EXPECT_THROW(with_changes({}, {{"filter", "sharp"}}), std::invalid_argument);
  EXPECT_THROW(flags_text({{"filters", "nearest"}}), std::invalid_argument);
}

}  // namespace
}  // namespace herr
