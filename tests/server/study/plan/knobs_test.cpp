// What a study sweeps, over scenes that have something for every knob and for none.
#include "server/study/plan/knobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "renderer/settings_list.h"
#include "renderer/settings_presets.h"
#include "server/study/reference/reference_spec.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// A floor under a lamp and grey light from all around.
Scene plain_scene() {
  Scene scene;
  test::add(scene, test::floor_quad(5), test::matte(glm::vec3{0.8f}));
  scene.lights = {test::light_at({0, 3, 0}, glm::vec3{10.0f}, {1, 0, 1})};
  scene.ambient = glm::vec3{0.2f};
  return scene;
}

// Something for every knob.
Scene full_scene() {
  Scene scene = plain_scene();
  Material mirror = test::matte(glm::vec3{0.5f});
  mirror.mirror = 1;
  Material glass = test::matte(glm::vec3{1.0f});
  glass.transmission = 1;
  Material textured = test::matte(glm::vec3{1.0f});
  textured.base_colour_texture = 0;
  scene.textures.emplace_back();
  for (const Material& material : {mirror, glass, textured}) {
    test::add(scene, test::box(glm::vec3{-1}, glm::vec3{1}), material);
  }
  const std::uint32_t detailed = scene.instances.back().mesh;
  scene.meshes.push_back(test::box(glm::vec3{-1}, glm::vec3{1}));
  scene.meshes[detailed].coarser = {{static_cast<std::uint32_t>(scene.meshes.size() - 1), 0.01f}};
  return scene;
}

StudySweeps sweeps_in(const Scene& scene, const RenderSettings& defaults = {}) {
  return sweeps_of(defaults, [&](const RenderSettings& s) { return plan_frame(scene, s, false); });
}

// Defaults that users may study around, the ends of ranges among them.
std::vector<RenderSettings> many_defaults() {
  std::vector<RenderSettings> all(1);
  for (const SettingChanges& changes :
       std::vector<SettingChanges>{{{"light_samples", "64"}},
                                   {{"light_samples", "5"}, {"first_light_samples", "4"}},
                                   {{"polar", "2x2"}},
                                   {{"polar", "16384x8192"}},
                                   {{"probes", "off"}, {"occlusion_rays", "0"}},
                                   {{"reflections", "off"}, {"refraction", "off"}},
                                   {{"detail_error", "0"}, {"ray_width", "0"}}}) {
    all.push_back(with_changes({}, changes));
  }
  return all;
}

bool changes(const StudySetting& setting, const std::string& name) {
  return std::any_of(setting.changes.begin(), setting.changes.end(),
                     [&](const auto& change) { return change.first == name; });
}

TEST(Knobs, EverySettingThatTradesErrorForTimeIsSweptOrLeftOutWithAReason) {
  for (const Scene& scene : {plain_scene(), full_scene()}) {
    const StudySweeps sweeps = sweeps_in(scene);
    RenderSettings any;
    for (const Setting& row : settings_of(any)) {
      if (row.effect != SettingEffect::error_for_time) continue;
      const bool swept = std::any_of(sweeps.settings.begin(), sweeps.settings.end(),
                                     [&](const StudySetting& s) { return changes(s, row.name); });
      const auto left_out =
          std::count_if(sweeps.left_out.begin(), sweeps.left_out.end(), [&](const std::string& text) {
            return text.starts_with(label_of(row) + ": ") && text.size() > label_of(row).size() + 2;
          });
      EXPECT_EQ(swept ? 0 : 1, left_out) << row.name;
    }
  }
}

TEST(Knobs, WhatTheSceneHasNothingForIsLeftOut) {
  const std::vector<std::string> left_out = sweeps_in(plain_scene()).left_out;
  for (const char* text :
       {"reflections: no material reflects", "refraction: no material is transparent",
        "ray width: no instance has a texture", "detail error: no mesh has coarser forms"}) {
    EXPECT_EQ(std::count(left_out.begin(), left_out.end(), text), 1) << text;
  }
  EXPECT_EQ(left_out.size(), 4u);
  EXPECT_TRUE(sweeps_in(full_scene()).left_out.empty());
}

TEST(Knobs, NamesAreUniqueAndKnobsKnownAroundAnyDefault) {
  const Scene scene = full_scene();
  for (const RenderSettings& defaults : many_defaults()) {
    const StudySweeps sweeps = sweeps_in(scene, defaults);
    std::set<std::string> names, knobs;
    for (const Knob& knob : sweeps.knobs) EXPECT_TRUE(knobs.insert(knob.name).second) << knob.name;
    for (const StudySetting& setting : sweeps.settings) {
      EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
      EXPECT_EQ(knobs.count(setting.knob), 1u) << setting.name;
      EXPECT_NO_THROW(check_settings(with_changes(defaults, setting.changes))) << setting.name;
    }
  }
}

TEST(Knobs, EachIsSweptAroundHardAndSoftLight) {
  const RenderSettings defaults;
  const StudySweeps sweeps = sweeps_in(full_scene());
  std::map<std::string, std::set<std::string>> bases;
  for (const StudySetting& setting : sweeps.settings) {
    bases[setting.knob].insert(setting.base);
    if (setting.base.empty()) continue;
    EXPECT_EQ(base_name(with_changes(defaults, setting.changes).light_samples), setting.base) << setting.name;
  }
  for (const Knob& knob : sweeps.knobs) {
    const std::set<std::string>& found = bases[knob.name];
    if (knob.name == "light_samples" || knob.name == "adaptive_samples") {
      EXPECT_EQ(found, std::set<std::string>{""}) << knob.name;  // of the light itself
    } else if (knob.name == "first_light_samples") {
      EXPECT_EQ(found, std::set<std::string>{"N = 64"});  // one sample has no first ones
    } else {
      EXPECT_EQ(found.count("N = 1") + found.count("N = 64"), 2u) << knob.name;
    }
  }
}

// References are told apart by their names.
TEST(Knobs, ReferencesOfOneNameAreOfTheSameSettings) {
  const Scene scene = full_scene();
  for (const RenderSettings& defaults : many_defaults()) {
    std::map<std::string, std::tuple<SettingChanges, int, bool>> by_name;
    const auto expect_one_meaning = [&](const ReferenceSpec& spec) {
      ASSERT_FALSE(spec.name.empty());
      EXPECT_NO_THROW(check_settings(spec.settings)) << spec.name;
      EXPECT_NO_THROW(check_settings(spec.finest)) << spec.name;
      const std::tuple meaning{changes_between(defaults, spec.settings), spec.passes, spec.same_probes};
      const auto [place, is_new] = by_name.try_emplace(spec.name, meaning);
      if (!is_new) {
        EXPECT_EQ(place->second, meaning) << spec.name;
      }
    };
    for (const StudySetting& setting : sweeps_in(scene, defaults).settings) {
      expect_one_meaning(endless_effort(defaults, setting.model));
      if (setting.own == OwnReference::none) continue;
      const ReferenceSpec own = own_reference(defaults, setting);
      EXPECT_EQ(own.by_pixels, setting.own == OwnReference::pixels) << setting.name;
      EXPECT_EQ(setting.own_limit.empty(), own.by_pixels) << setting.name;
      expect_one_meaning(own);
    }
  }
}

TEST(Knobs, ProbesAreOfTheDefaultsModelWhereTheDefaultHasProbes) {
  RenderSettings defaults = direct_light_settings();
  const auto model_of = [&](const char* knob) {
    for (const StudySetting& setting : sweeps_in(full_scene(), defaults).settings) {
      if (setting.knob == knob) return setting.model;
    }
    ADD_FAILURE() << knob;
    return SettingChanges{};
  };
  EXPECT_EQ(model_of("probe_rays"), (SettingChanges{{"probes", "on"}}));
  EXPECT_EQ(model_of("occlusion_rays"), (SettingChanges{{"occlusion_rays", "16"}}));
  EXPECT_TRUE(model_of("first_light_samples").empty());  // the same light, sampled in another way
  defaults.probes.on = true, defaults.occlusion_rays = 4;
  EXPECT_TRUE(model_of("probe_rays").empty());
  EXPECT_TRUE(model_of("occlusion_rays").empty());
}

// What a knob does to a picture shows against a reference that has the very probes of that picture; what it
// does to the probes, against probes of other seeds.
TEST(Knobs, AReferenceOfOneKnobHasTheProbesOfTheSettingUnlessTheKnobIsTheirs) {
  const RenderSettings paper;
  std::set<std::string> own_probes;
  for (const StudySetting& setting : sweeps_in(full_scene(), paper).settings) {
    EXPECT_FALSE(endless_effort(paper, setting.model).same_probes) << "their noise is part of its own error";
    if (setting.own == OwnReference::none) continue;
    const ReferenceSpec own = own_reference(paper, setting);
    EXPECT_TRUE(own.settings.probes.on) << setting.name;
    if (!own.same_probes) own_probes.insert(setting.knob);
  }
  EXPECT_EQ(own_probes, (std::set<std::string>{"probe_rays", "probe_density", "probe_budget"}));
  const RenderSettings direct = direct_light_settings();
  for (const StudySetting& setting : sweeps_in(full_scene(), direct).settings) {
    if (setting.own == OwnReference::none || !setting.model.empty()) continue;
    EXPECT_FALSE(own_reference(direct, setting).settings.probes.on) << setting.name;
  }
}

TEST(Knobs, SizesAtAnEndOfTheRangeAreSweptOnce) {
  RenderSettings defaults;
  defaults.polar_width = 8192, defaults.polar_height = 8192;
  std::vector<std::string> hard;
  for (const StudySetting& setting : sweeps_in(plain_scene(), defaults).settings) {
    if (setting.knob == "polar" && setting.base == "N = 1") hard.push_back(setting.value);
  }
  // 0.25, 0.354 (8192 * 0.354 = 2899.97; 4096 * 0.354 = 1449.98 pairs of rows), 0.5, 0.707 (5791.7; 2895.9),
  // 1, which is the default; 1.414 and 2 would be larger than the largest. Before them the size that follows
  // the display.
  EXPECT_EQ(hard, (std::vector<std::string>{"acuity", "4096x2048", "5800x2900", "8192x4096", "11584x5792"}));
}

// What the default's own frames show is a point of its sweep, and no further frame. Against another reference
// it is another point: that of light samples is of many seeds.
TEST(Knobs, TheDefaultIsMeasuredOnce) {
  const Scene scene = full_scene();
  for (const RenderSettings& defaults : many_defaults()) {
    const StudySweeps sweeps = sweeps_in(scene, defaults);
    for (const StudySetting& setting : sweeps.of_default) {
      const RenderSettings base =
          with_changes(defaults, {{"light_samples", setting.base == "N = 1" ? "1" : "64"}});
      EXPECT_TRUE(changes_between(base, with_changes(defaults, setting.changes)).empty()) << setting.name;
      EXPECT_NE(setting.own, OwnReference::seeds) << setting.name;
    }
    for (const StudySetting& setting : sweeps.settings) {
      if (setting.knob == "default" || setting.own == OwnReference::seeds) continue;
      for (const char* samples : {"1", "64"}) {
        const RenderSettings base = with_changes(defaults, {{"light_samples", samples}});
        EXPECT_FALSE(changes_between(base, with_changes(defaults, setting.changes)).empty()) << setting.name;
      }
    }
  }
  std::set<std::string> of_default;
  for (const StudySetting& setting : sweeps_in(scene).of_default) of_default.insert(setting.name);
  for (const char* name : {"polar 1576x768, N = 1", "edge samples 0, N = 1", "edge samples 0, N = 64"})
    EXPECT_TRUE(of_default.contains(name)) << name;
}

// A default that follows the acuity is no point of its own sweep; sizes around it have a fixed one.
TEST(Knobs, PolarAcuityIsAPointUnlessItIsTheDefault) {
  const auto points = [](const RenderSettings& defaults) {
    std::map<std::string, RenderSettings> all;
    for (const StudySetting& setting : sweeps_in(plain_scene(), defaults).settings) {
      if (setting.knob == "polar" && setting.base == "N = 64")
        all[setting.value] = with_changes(defaults, setting.changes);
    }
    return all;
  };
  EXPECT_TRUE(points({}).at("acuity").polar_acuity);
  const auto around = points(with_changes({}, {{"polar", "acuity"}}));
  EXPECT_EQ(around.count("acuity"), 0u);
  const RenderSettings half = around.at("1040x588");
  EXPECT_FALSE(half.polar_acuity);
  EXPECT_EQ(half.polar_width, kMostAcuityWidth / 2);
}

}  // namespace
}  // namespace herr
