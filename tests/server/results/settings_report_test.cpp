// What a run leaves about its settings: two runs that differ in one of those that shape pictures differ in
// the text of file headers, in the fingerprint and in the summary.
#include "server/results/settings_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "renderer/settings_presets.h"
#include "server/results/fingerprint.h"
#include "server/results/summary_json.h"
#include "server/settings/run_settings.h"

namespace herr {
namespace {

struct Told {
  std::string header, headline, summary;
  Fingerprint fingerprint;
};

// As open_session() fills the report of a session that names the profile xr1.
SessionReport report_of(const ReplayOptions& options) {
  SessionReport report;
  report.settings = options.render;
  report.profile.name = options.profile.empty() ? "xr1" : options.profile;
  report.scene_file = "room.scene.json";
  report.range.count = 9;
  report.findings.camera_rows[0] = 1;
  return report;
}

Told told_by(const ReplayOptions& options) {
  const SessionReport report = report_of(options);
  return {settings_text(resolved_options(options, report), true), headline_text(options, report),
          subject_json(report, options)["settings"].dump(), fingerprint_of(report, options, Scene())};
}

// Probes, both policies and adaptive samples, so that no setting of theirs is without effect.
ReplayOptions base_options(Foveation foveation) {
  ReplayOptions options;
  options.render.foveation = foveation;
  options.render.probes.on = true;
  options.render.light_samples = 64;
  options.render.adaptive_min_samples = 8;
  options.policy = {true, true};
  return options;
}

// What means something only without foveation is changed beside none.
ReplayOptions base_for(std::size_t row) {
  ReplayOptions options = base_options(Foveation::log_polar);
  return base_options(is_idle(settings_of(options)[row]) ? Foveation::off : Foveation::log_polar);
}

TEST(SettingsReport, EachSettingThatShapesPicturesIsToldEverywhere) {
  ReplayOptions base;
  const std::size_t count = settings_of(base).size();
  for (std::size_t i = 0; i < count; ++i) {
    ReplayOptions options = base_for(i);
    const Told before = told_by(options);
    const std::vector<Setting> settings = settings_of(options);
    const Setting& setting = settings[i];
    set_text(setting, other_text(setting));
    const Told now = told_by(options);
    SCOPED_TRACE(setting.name);
    EXPECT_NE(now.summary, before.summary);
    const std::string what = difference(before.fingerprint, now.fingerprint);
    if (shapes_pictures(setting)) {
      EXPECT_NE(now.header, before.header) << now.header;
      // The instruction set stands before it.
      EXPECT_EQ(now.headline != before.headline, setting.name != "isa") << now.headline;
      const std::string& flag = setting.group == SettingGroup::probes ? "" : setting.flag;
      EXPECT_EQ(what.find((flag.empty() ? "" : flag + " was ")), 0u) << what;
      EXPECT_NE(what, "");
    } else {
      EXPECT_EQ(now.header, before.header);
      EXPECT_EQ(what.empty(), setting.group != SettingGroup::files) << what;
    }
  }
}

TEST(SettingsReport, TheHeaderTellsWhatDiffersFromTheDefaults) {
  ReplayOptions options;
  options.profile = "xr1";
  options.render.isa = Isa::avx2;
  EXPECT_EQ(
      settings_text(options, true),
      "polar 1576x768, light samples 1, occlusion rays 1, reflections, probes, camera, isa avx2, profile "
      "xr1");
  options.render.probes.on = false;
  options.render.light_samples = 16;
  options.render.adaptive_min_samples = 4;
  options.render.occlusion_rays = 8;
  options.render.occlusion_radius_m = 0.5;
  options.render.refraction = false;
  options.render.camera = false;
  options.policy.deadline = true;
  options.target_ms = 20;
  EXPECT_EQ(
      settings_text(options, true),
      "polar 1576x768, light samples 16, occlusion rays 8, reflections, no probes, no camera, first light "
      "samples 4, occlusion radius 0.5 m, no refraction, isa avx2, profile xr1, policy deadline, target "
      "20 ms");
  EXPECT_EQ(
      features_text(options.render, true),
      "occlusion rays 8, reflections, no probes, no camera, first light samples 4, occlusion radius 0.5 "
      "m, no refraction");
}

// What changes nothing beside the others is not told as if it did.
TEST(SettingsReport, WhatIsIdleBesideTheOthersIsNotTold) {
  ReplayOptions options;
  options.profile = "xr1";
  options.render.isa = Isa::avx2;
  options.render.foveation = Foveation::off;
  options.render.polar_acuity = true;
  options.render.light_samples = 4;
  options.render.adaptive_min_samples = 8;
  options.render.probes.on = false;
  options.render.probes.rays = 128;
  EXPECT_EQ(settings_text(options, true),
            "light samples 4, occlusion rays 1, reflections, no probes, camera, foveation off, isa avx2, "
            "profile xr1");
}

TEST(SettingsReport, WhatMeansNothingIsNotTold) {
  ReplayOptions options;
  options.profile = "xr1";
  options.render.isa = Isa::avx2;
  options.render.feed_distance_m = 3;  // of a feed that this session has not
  EXPECT_EQ(settings_text(options, false),
            "polar 1576x768, light samples 1, occlusion rays 1, reflections, probes, isa avx2, profile xr1");
  EXPECT_EQ(features_text(options.render, false), "occlusion rays 1, reflections, probes");
  SessionReport report = report_of(options);
  report.findings.camera_rows[0] = 0;
  EXPECT_EQ(headline_text(options, report).find("camera"), std::string::npos);
  options.render.foveation = Foveation::off;
  EXPECT_EQ(
      settings_text(options.render, true),
      "light samples 1, occlusion rays 1, reflections, probes, camera, foveation off, feed distance 3 m");
}

// Keys and values that scripts and earlier programs know.
TEST(SettingsReport, KeysAndValuesAreThoseOfEarlierPrograms) {
  ReplayOptions options;
  options.render = direct_light_settings();  // the default of programs that knew no presets
  options.render.threads = 2;
  options.render.isa = Isa::sse4;
  options.render.camera = false;
  const auto json = settings_json(resolved_options(options, report_of(options)));
  const auto expected = nlohmann::ordered_json::parse(R"({
    "foveation": "log-polar", "polar_width_per_eye": 788, "polar_height": 768, "light_samples": 1,
    "first_light_samples": 0, "occlusion_rays": 0, "occlusion_radius_m": 0.3, "reflections": true,
    "probes": false, "probe_rays": 64, "probe_budget": 0, "probe_hysteresis_tau_s": 0.365,
    "probe_reaction": true, "refraction": true, "camera": false, "gaze_marker": false, "debug_tiles": false,
    "feed_distance_m": 2.0, "sampling": "latest", "policy": "fixed", "polar_floor_per_eye": null,
    "clock": "virtual", "format": "png", "threads": 2, "isa": "sse4"})");
  for (const auto& [key, value] : expected.items()) {
    ASSERT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json[key].dump(), value.dump()) << key;
  }

  const Fingerprint::Entries known{{"--scene", "room.scene.json"},
                                   {"--profile", "xr1"},
                                   {"--format", "png"},
                                   {"--contact-sheet", "middle"},
                                   {"--polar", "1576x768"},
                                   {"--light-samples", "1"},
                                   {"--first-light-samples", "0"},
                                   {"--occlusion-rays", "0"},
                                   {"--occlusion-radius", "0.3"},
                                   {"--probes", "not given"},
                                   {"--no-reflections", "not given"},
                                   {"--no-refraction", "not given"},
                                   {"--no-camera", "given"},
                                   {"--foveation", "log-polar"},
                                   {"--gaze-marker", "not given"},
                                   {"--debug-tiles", "not given"},
                                   {"--feed-distance", "2"},
                                   {"--sampling", "latest"},
                                   {"--policy", "fixed"},
                                   {"--polar-floor", "196"},
                                   {"--clock", "virtual"},
                                   {"--isa", "sse4"},
                                   {"--start, --duration, --frames", "frames 0 ... 8"}};
  const Fingerprint::Entries now = told_by(options).fingerprint.settings;
  for (const auto& entry : known) {
    EXPECT_NE(std::find(now.begin(), now.end(), entry), now.end()) << entry.first;
  }
  options.render.probes.on = true;
  const Fingerprint::Entries with_probes = told_by(options).fingerprint.settings;
  const std::pair<std::string, std::string> probes{"--probes", "64 rays, budget 0"};
  EXPECT_NE(std::find(with_probes.begin(), with_probes.end(), probes), with_probes.end());
}

TEST(SettingsReport, ASettingThatAnEarlierProgramDidNotKnowHadItsDefaultAndNoLightButDirectLight) {
  ReplayOptions options;
  options.render = direct_light_settings();
  Fingerprint earlier = told_by(options).fingerprint;
  std::erase_if(earlier.settings, [](const auto& entry) {
    return entry.first == "--occlusion-rays" || entry.first == "--no-occlusion-smoothing" ||
           entry.first == "--probes" || entry.first == "--ray-width";
  });
  EXPECT_EQ(difference(earlier, told_by(options).fingerprint), "");
  options.render.occlusion_rays = 4;
  EXPECT_EQ(difference(earlier, told_by(options).fingerprint), "--occlusion-rays was not known then, is 4");
  EXPECT_EQ(difference(earlier, told_by(ReplayOptions()).fingerprint),
            "--occlusion-rays was not known then, is 1");
}

TEST(SettingsReport, AProgramThatDidNotKnowTheMeanOverNeighboursTookEachHitsOwnRays) {
  ReplayOptions options;
  Fingerprint earlier = told_by(options).fingerprint;
  std::erase_if(earlier.settings,
                [](const auto& entry) { return entry.first == "--no-occlusion-smoothing"; });
  EXPECT_EQ(difference(earlier, told_by(options).fingerprint),
            "--no-occlusion-smoothing was not known then, is not given");
  options.render.occlusion_smoothing = false;
  EXPECT_EQ(difference(earlier, told_by(options).fingerprint), "");
}

// As a help calls it: a text that is none has no characters.
TEST(SettingsReport, ASettingThatIsNoneDiffersInWords) {
  ReplayOptions with, without;
  with.render.see_through_colour = kPink;
  with.view = "overview.view.json";
  EXPECT_EQ(difference(told_by(with).fingerprint, told_by(without).fingerprint),
            "--see-through-colour was ff8cc6, is the camera feed");
  with.render.see_through_colour.reset();
  EXPECT_EQ(difference(told_by(with).fingerprint, told_by(without).fingerprint),
            "--view was overview.view.json, is none");
  EXPECT_EQ(difference(told_by(without).fingerprint, told_by(with).fingerprint),
            "--view was none, is overview.view.json");
}

// A run that begins with other light is other work: stored by a program whose default was direct light alone.
TEST(SettingsReport, ARunOfTheEarlierDefaultDiffersFromOneOfThisDefault) {
  ReplayOptions direct;
  direct.render = direct_light_settings();
  const Fingerprint earlier = told_by(direct).fingerprint, now = told_by(ReplayOptions()).fingerprint;
  EXPECT_EQ(difference(earlier, now), "--occlusion-rays was 0, is 1");
  direct.render.occlusion_rays = 1;
  EXPECT_EQ(difference(told_by(direct).fingerprint, now), "--probes was off, is 64 rays, budget 0");
}

// A preset stands for --occlusion-rays 0 and --no-probes: nobody gave --no-occlusion-smoothing.
TEST(SettingsReport, WhatAPresetTurnsOffIsToldAsTheFlagThatTurnsItOff) {
  ReplayOptions direct, paper;
  direct.render = direct_light_settings();
  const Fingerprint earlier = told_by(direct).fingerprint, now = told_by(paper).fingerprint;
  for (const FingerprintDifference& found : differences(earlier, now))
    EXPECT_NE(found.name, "--no-occlusion-smoothing") << found.text;
  EXPECT_EQ(flags_of({"--probes", "not given"}), "--no-probes");
  EXPECT_EQ(flags_of({"--probes", "64 rays, budget 0"}), "--probes");
  EXPECT_EQ(flags_of({"--no-camera", "given"}), "--no-camera");
  EXPECT_EQ(flags_of({"--no-occlusion-smoothing", "given"}), "--no-occlusion-smoothing");
  EXPECT_EQ(flags_of({"--polar", "1576x768"}), "--polar 1576x768");
  EXPECT_EQ(flags_of({"--threads", "2"}), "--threads 2");
}

}  // namespace
}  // namespace herr
