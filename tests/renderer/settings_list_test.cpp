// The list of a render's settings, row by row: each default fits its range, each value reads back, each
// refusal says what was wanted.
#include "renderer/settings_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace herr {
namespace {

// The one line of a refusal; empty when there was none.
std::string complaint(const std::function<void()>& act) {
  try {
    act();
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

std::string complaint(const std::function<void(RenderSettings&)>& spoil) {
  RenderSettings settings;
  spoil(settings);
  return complaint([&] { check_settings(settings); });
}

TEST(SettingsList, EachRowHasANameASentenceAndADefaultInRange) {
  RenderSettings settings;
  std::set<std::string> names, flags;
  for (const Setting& setting : settings_of(settings)) {
    SCOPED_TRACE(setting.name);
    EXPECT_TRUE(names.insert(setting.name).second);
    EXPECT_TRUE(setting.flag.empty() || flags.insert(setting.flag).second);
    EXPECT_TRUE(setting.flag.empty() || setting.flag.starts_with("--"));
    EXPECT_TRUE(setting.unit.empty() || setting.name.ends_with("_" + setting.unit));
    EXPECT_FALSE(setting.sentence.empty());
    EXPECT_EQ(complaint([&] { check_range(setting); }), "");
    EXPECT_NE(text_of(setting).empty(), setting.otherwise.empty()) << "either a default, or what else holds";
  }
}

std::vector<std::string> idle(const std::function<void(RenderSettings&)>& change) {
  RenderSettings settings, defaults;
  change(settings);
  return idle_settings(settings_of(settings), settings_of(defaults));
}

TEST(SettingsList, ASettingThatChangesNothingBesideTheOthersSaysSo) {
  EXPECT_TRUE(idle([](RenderSettings&) {}).empty());
  EXPECT_EQ(
      idle([](RenderSettings& s) { s.foveation = Foveation::off, s.polar_acuity = true; }),
      std::vector<std::string>{"--polar acuity: no effect with --foveation off, which has no polar buffer"});
  EXPECT_EQ(idle([](RenderSettings& s) { s.scale = 0.5; }),
            std::vector<std::string>{"--scale 0.5: no effect with foveation; give --foveation off"});
  EXPECT_TRUE(idle([](RenderSettings& s) { s.foveation = Foveation::off, s.scale = 0.5; }).empty());
  EXPECT_EQ(idle([](RenderSettings& s) { s.probes.on = false, s.probes.rays = 128; }),
            std::vector<std::string>{"--probe-rays 128: no effect with no probes; give --probes"});
  EXPECT_EQ(idle([](RenderSettings& s) { s.occlusion_rays = 0, s.occlusion_smoothing = false; }).size(), 1u);
  EXPECT_EQ(idle([](RenderSettings& s) { s.camera = false, s.feed_distance_m = 3; }).size(), 1u);
}

// Adaptive samples trace a few of at most 256 first: of as many as are first, or of more, all are traced.
TEST(SettingsList, AdaptiveSamplesAreIdleBesideTooFewAndTooManyLightSamples) {
  for (const auto& [samples, first, is_idle] : {std::tuple{1, 8, true},
                                                {8, 8, true},
                                                {9, 8, false},
                                                {256, 8, false},
                                                {257, 8, true},
                                                {64, 0, false}}) {
    const auto change = [samples = samples, first = first](RenderSettings& s) {
      s.light_samples = samples;
      s.adaptive_min_samples = first;
    };
    EXPECT_EQ(idle(change).size(), is_idle ? 1u : 0u) << samples << " samples, " << first << " first";
  }
}

TEST(SettingsList, EachSentenceSaysItsWords) {
  RenderSettings settings;
  for (const Setting& setting : settings_of(settings)) {
    const auto* choice = std::get_if<WordSetting>(&setting.value);
    if (choice == nullptr || is_switch(setting)) continue;
    for (const std::string& word : choice->words) {
      EXPECT_NE(setting.sentence.find(word), std::string::npos) << setting.name << ": " << word;
    }
  }
}

TEST(SettingsList, EachValueReadsBackFromTextAndFromJson) {
  const std::size_t count = [] {
    RenderSettings settings;
    return settings_of(settings).size();
  }();
  for (std::size_t i = 0; i < count; ++i) {
    RenderSettings first, second;
    const std::vector<Setting> written = settings_of(first), read = settings_of(second);
    SCOPED_TRACE(written[i].name);
    const std::string other = other_text(written[i]);
    EXPECT_NE(other, text_of(written[i]));
    set_text(written[i], other);
    EXPECT_EQ(text_of(written[i]), other);
    EXPECT_EQ(complaint([&] { check_settings(first); }), "");
    set_value(read[i], value_of(written[i]));
    for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(text_of(read[k]), text_of(written[k])) << read[k].name;
  }
}

TEST(SettingsList, EachNumberIsRefusedBeyondItsRangeAndStaysWhatItWas) {
  RenderSettings settings;
  for (const Setting& setting : settings_of(settings)) {
    const auto* number = std::get_if<NumberSetting>(&setting.value);
    if (number == nullptr) continue;
    SCOPED_TRACE(setting.name);
    const std::string before = text_of(setting);
    for (const double beyond : {number->lowest - 1, number->highest + 1, std::nan("")}) {
      EXPECT_NE(complaint([&] { set_value(setting, beyond); }).find("within " + range_text(setting)),
                std::string::npos);
    }
    const std::string above = std::to_string(static_cast<std::int64_t>(number->highest) + 1);
    EXPECT_NE(complaint([&] { set_text(setting, above); }).find("'" + above + "' is out of range: "),
              std::string::npos);
    for (const char* wrong : {"", "-", "--1", "-1000000001", "nan", "010", "1e3", "x"}) {
      EXPECT_NE(complaint([&] { set_text(setting, wrong); }), "") << wrong;
    }
    EXPECT_NE(complaint([&] { set_value(setting, std::string("1")); }), "") << "a text is no number";
    EXPECT_EQ(text_of(setting), before);
  }
}

TEST(SettingsList, ARangeThatAProgramLeavesIsNamed) {
  EXPECT_EQ(complaint([](RenderSettings& s) { s.light_samples = 0; }),
            "light samples must lie in [1, 4096], not 0");
  EXPECT_EQ(complaint([](RenderSettings& s) { s.occlusion_radius_m = 2e9; }),
            "occlusion radius must lie in [0.000000001, 1000000000] m, not 2000000000");
  EXPECT_EQ(complaint([](RenderSettings& s) { s.polar_width = 0; }),
            "polar width must lie in [1, 8192], not 0");
  EXPECT_EQ(complaint([](RenderSettings& s) { s.polar_height = 49; }), "polar height must be even");
  EXPECT_EQ(complaint([](RenderSettings& s) { s.threads = 0; }), "");
  EXPECT_EQ(complaint([](RenderSettings& s) { s.threads = 513; }), "threads must lie in [1, 512], not 513");
  EXPECT_NE(complaint([](RenderSettings& s) { s.probes.view_bias = std::nan(""); }), "");
  EXPECT_EQ(complaint([](RenderSettings&) {}), "");
}

TEST(SettingsList, SizesAreOfBothEyesAndEven) {
  RenderSettings settings;
  const std::vector<Setting> rows = settings_of(settings);
  const Setting& polar = setting_named(rows, "polar");
  EXPECT_EQ(text_of(polar), "1576x768");
  set_text(polar, "2048x1024");
  EXPECT_EQ(settings.polar_width, 1024);
  EXPECT_EQ(settings.polar_height, 1024);
  for (const char* wrong : {"1576", "x768", "0x768", "1575x768", "1576x767", "16386x768", "1576x8194"}) {
    EXPECT_NE(complaint([&] { set_text(polar, wrong); }), "") << wrong;
  }
  EXPECT_EQ(settings.polar_width, 1024);
}

// Whoever reads the sizes has the most of any frame; another size ends it.
TEST(SettingsList, TheSizeMayFollowTheAcuity) {
  RenderSettings settings;
  const std::vector<Setting> rows = settings_of(settings);
  const Setting& polar = setting_named(rows, "polar");
  set_value(polar, std::string("acuity"));
  EXPECT_TRUE(settings.polar_acuity);
  EXPECT_EQ(settings.polar_width, kMostAcuityWidth);
  EXPECT_EQ(settings.polar_height, kAcuityHeight);
  EXPECT_EQ(text_of(polar), "acuity");
  EXPECT_EQ(complaint([&] { check_settings(settings); }), "");
  EXPECT_EQ(range_text(polar), "2x2 ... 16384x8192, acuity");
  EXPECT_NE(complaint([&] { set_text(polar, "Acuity"); }).find("or acuity"), std::string::npos);
  set_text(polar, "1576x768");
  EXPECT_FALSE(settings.polar_acuity);
  EXPECT_EQ(text_of(polar), "1576x768");
}

TEST(SettingsList, ANameThatIsNoSettingNamesTheNearest) {
  RenderSettings settings;
  EXPECT_EQ(complaint([&] { setting_named(settings_of(settings), "light_sample"); }),
            "'light_sample' is no setting; did you mean light_samples?");
}

TEST(SettingsList, AStudyFindsWhatTradesErrorForTime) {
  RenderSettings settings;
  std::set<std::string> names;
  for (const Setting& setting : settings_of(settings)) {
    if (setting.effect == SettingEffect::error_for_time) names.insert(setting.name);
  }
  EXPECT_TRUE(names.contains("polar") && names.contains("light_samples") && names.contains("probe_rays"));
  EXPECT_FALSE(names.contains("camera") || names.contains("threads"));
}

}  // namespace
}  // namespace herr
