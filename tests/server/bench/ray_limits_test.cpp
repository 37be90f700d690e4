#include "server/bench/ray_limits.h"
#include "renderer/settings_presets.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

constexpr std::size_t kLights = 2;

// 4 light samples, 2 short rays.
RenderSettings settings() {
  RenderSettings settings = direct_light_settings();
  settings.light_samples = 4;
  settings.occlusion_rays = 2;
  return settings;
}

// Every kind as often as a plan with everything allows: 8 shadow rays a hit, half of the hits reflect, 32
// rays follow light through glass everywhere, and every shadow and short ray of a catcher is asked again
// without the virtual objects.
BenchResult fullest() {
  BenchResult result;
  result.kinds = {{"primary", 1000, 1.0, 0, 0},
                  {"shadow", 8000, 8.0, 0, 0},
                  {"catcher_shadow", 268000, 268.0, 0, 0},
                  {"mirror", 500, 0.5, 0, 0},
                  {"mirror_shadow", 4000, 4.0, 0, 0},
                  {"refraction", 32000, 32.0, 0, 0},
                  {"refraction_shadow", 256000, 256.0, 0, 0},
                  {"occlusion", 2000, 2.0, 0, 0},
                  {"catcher_occlusion", 2000, 2.0, 0, 0},
                  {"probe", 2000, 2.0, 0, 0},
                  {"probe_shadow", 4000, 4.0, 0, 0},
                  {"catcher_probe", 2000, 2.0, 0, 0},
                  {"catcher_probe_shadow", 4000, 4.0, 0, 0}};
  result.most_probe_rays = 2000;
  return result;
}

FramePlan everything() {
  FramePlan plan;
  plan.mirror_rays = plan.refraction = plan.occlusion = plan.catchers = plan.catchers_occlude = true;
  plan.probes = plan.catcher_probes = true;
  return plan;
}

TEST(RayLimits, AreNotExceededByAFrameThatTracesAllThatItsPlanAllows) {
  EXPECT_EQ(rays_beyond_plan(fullest(), everything(), kLights, settings()), "");
  EXPECT_EQ(rays_beyond_plan(BenchResult(), FramePlan(), 0, RenderSettings()), "");
}

TEST(RayLimits, RaysGoOnBehindBlendedSurfacesAsOftenAsThereAreLayers) {
  BenchResult result = fullest();
  result.kinds.push_back({"behind", 7000, 7.0, 0, 0});
  FramePlan plan = everything();
  EXPECT_NE(rays_beyond_plan(result, plan, kLights, settings()).find(" behind rays"), std::string::npos);
  plan.alpha_blend = true;
  EXPECT_EQ(rays_beyond_plan(result, plan, kLights, settings()), "");
  result.kinds.back().rays_per_sample = kMostLayers - 0.999;
  EXPECT_NE(rays_beyond_plan(result, plan, kLights, settings()).find(" behind rays"), std::string::npos);
}

TEST(RayLimits, OneRayMoreOfAnyKindIsNamed) {
  for (std::size_t kind = 0; kind < fullest().kinds.size(); ++kind) {
    BenchResult result = fullest();
    const std::string name = result.kinds[kind].name;
    // More mirror rays allow more shadow rays behind them: there the limit itself is 1.
    result.kinds[kind].rays_per_sample =
        name == "mirror" ? 1.001 : result.kinds[kind].rays_per_sample + 0.001;
    const std::string line = rays_beyond_plan(result, everything(), kLights, settings());
    EXPECT_NE(line.find(" " + name + " rays per polar sample"), std::string::npos) << name << ": " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

TEST(RayLimits, KindsThatThePlanLeavesOutMayNotOccurAtAll) {
  FramePlan no_mirror = everything();
  no_mirror.mirror_rays = false;
  EXPECT_NE(rays_beyond_plan(fullest(), no_mirror, kLights, settings()).find(" mirror rays"),
            std::string::npos);
  FramePlan flat_catcher = everything();
  flat_catcher.catchers_occlude = false;
  EXPECT_NE(rays_beyond_plan(fullest(), flat_catcher, kLights, settings()).find(" catcher_shadow rays"),
            std::string::npos);
  EXPECT_NE(rays_beyond_plan(fullest(), everything(), 0, settings()).find(" shadow rays"), std::string::npos);
}

}  // namespace
}  // namespace herr
