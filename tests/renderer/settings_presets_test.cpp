// Settings that go together by a name.
#include "renderer/settings_presets.h"

#include <gtest/gtest.h>

#include <set>

#include "renderer/settings_list.h"

namespace herr {
namespace {

std::vector<std::string> texts_of(RenderSettings settings) {
  std::vector<std::string> texts;
  for (const Setting& setting : settings_of(settings)) texts.push_back(setting.name + " " + text_of(setting));
  return texts;
}

// Every setting at a value that it does not have by default.
RenderSettings all_changed() {
  RenderSettings settings;
  for (const Setting& setting : settings_of(settings)) set_text(setting, other_text(setting));
  return settings;
}

TEST(SettingsPresets, ThePapersFrameIsTheDefaultWithProbesAndOcclusion) {
  const SettingsPreset& paper = frame_presets().front();
  EXPECT_EQ(paper.name, "paper");
  RenderSettings settings;
  apply_preset(paper, settings);
  EXPECT_EQ(texts_of(settings), texts_of(RenderSettings()));
  EXPECT_TRUE(settings.probes.on);
  EXPECT_GE(settings.occlusion_rays, 1);
  EXPECT_TRUE(settings.reflections && settings.refraction);
  EXPECT_EQ(settings.foveation, Foveation::log_polar);
  EXPECT_EQ(2 * settings.polar_width, 1576);
  EXPECT_EQ(settings.polar_height, 768);
}

TEST(SettingsPresets, APresetSetsWhatItNamesWhateverHeldBeforeAndNothingElse) {
  for (const auto* presets : {&frame_presets(), &shadow_presets()}) {
    for (const SettingsPreset& preset : *presets) {
      SCOPED_TRACE(preset.name);
      RenderSettings before = all_changed(), after = before;
      apply_preset(preset, after);
      std::set<std::string> named;
      const std::vector<Setting> was = settings_of(before), is = settings_of(after);
      for (const auto& [name, value] : preset.sets) {
        EXPECT_TRUE(named.insert(name).second) << name;
        EXPECT_EQ(text_of(setting_named(is, name)), value) << name;
      }
      for (std::size_t i = 0; i < is.size(); ++i) {
        if (!named.contains(is[i].name)) {
          EXPECT_EQ(text_of(is[i]), text_of(was[i])) << is[i].name;
        }
      }
      EXPECT_FALSE(preset.sentence.empty());
    }
  }
}

// What "paper" says of the light, "direct" takes back: no preset leaves it as it was.
TEST(SettingsPresets, DirectLightHasNeitherProbesNorOcclusionAndDiffersInNothingElse) {
  const RenderSettings direct = direct_light_settings();
  EXPECT_FALSE(direct.probes.on);
  EXPECT_EQ(direct.occlusion_rays, 0);
  RenderSettings with_both = direct;
  with_both.probes.on = true;
  with_both.occlusion_rays = RenderSettings().occlusion_rays;
  EXPECT_EQ(texts_of(with_both), texts_of(RenderSettings()));
}

TEST(SettingsPresets, ASwitchThatAPresetTurnsHasAFlagForEitherValue) {
  RenderSettings settings;
  const std::vector<Setting> rows = settings_of(settings);
  for (const SettingsPreset& preset : frame_presets()) {
    for (const auto& [name, value] : preset.sets) {
      const Setting& row = setting_named(rows, name);
      if (!is_switch(row) || value == text_of(row)) continue;
      EXPECT_TRUE(row.flag.starts_with("--") && row.back_flag.starts_with("--")) << name;
    }
  }
}

}  // namespace
}  // namespace herr
