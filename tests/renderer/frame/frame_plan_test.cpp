// The plan leaves out what a scene does not need; its choice never changes the picture.
#include "renderer/frame_plan.h"

#include <gtest/gtest.h>

#include "renderer/frame/renderer_impl.h"
#include "renderer/settings_presets.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// Objects without textures or mirrors, one light of some size.
Scene plain_scene() {
  Scene scene;
  test::add(scene, test::floor_quad(5, -1), test::matte({0.5f, 0.4f, 0.3f}));
  test::add(scene, test::sphere({0.3f, 0, -3}, 0.8f), test::matte({0.2f, 0.7f, 0.9f}));
  scene.lights = {test::light_at({1, 3, -1}, {20, 15, 10}, {0.4f, 0.1f, 0.4f})};
  scene.ambient = {0.1f, 0.12f, 0.15f};
  scene.environment = glm::vec3{0.3f};
  return scene;
}

// The room's floor, under a sphere.
Scene catcher_scene() {
  Scene scene = plain_scene();
  scene.instances[0].catcher = true;
  scene.ambient = glm::vec3{0.1f};
  scene.lights[0].intensity_w_sr = glm::vec3{15.0f};
  return scene;
}

struct PlannedFrame {
  RenderedFrame frame;
  FramePlan plan;
};

PlannedFrame render_forcing(const Scene& scene, std::vector<std::string> force) {
  RenderSettings settings = test::small_settings();
  settings.light_samples = 4;
  settings.isa = Isa::best;
  settings.force = std::move(force);
  FrameSample sample = test::sample_from({0, 0, 0}, test::gaze_deg(5, -5));
  static const test::TestCamera camera = test::TestCamera::pinhole(16, 16, 60, [](int x, int y) {
    return std::array<std::uint16_t, 4>{test::to_half(0.05 * x), test::to_half(0.05 * y), 0x3800, 0x3c00};
  });
  camera.attach_to(sample);
  Renderer renderer(scene, test::small_profile(), settings, true);
  PlannedFrame out;
  out.plan = renderer.plan();
  test::render_with(renderer, scene, sample, out.frame);
  return out;
}

// Insists on what the plan leaves out: same picture, and of each kind as many rays, but for those that
// catchers send once more where they are blocked.
void expect_same_picture(const Scene& scene, const std::vector<std::string>& force,
                         const std::vector<bool FramePlan::*>& features) {
  const PlannedFrame lean = render_forcing(scene, {}), full = render_forcing(scene, force);
  for (const auto feature : features) {
    ASSERT_FALSE(lean.plan.*feature) << "the scene needs it: this test would compare a frame with itself";
    ASSERT_TRUE(full.plan.*feature);
  }
  test::expect_same_bits(lean.frame, full.frame);
  for (std::size_t kind = 0; kind < kRayKinds; ++kind) {
    if (static_cast<RayKind>(kind) == RayKind::catcher_shadow) continue;
    EXPECT_EQ(lean.frame.counters.rays.of_kind[kind], full.frame.counters.rays.of_kind[kind])
        << name_of(static_cast<RayKind>(kind));
  }
}

TEST(FramePlanTest, TextureCodeDoesNotChangeASceneWithoutTextures) {
  expect_same_picture(plain_scene(), {"textures"}, {&FramePlan::textures});
}

TEST(FramePlanTest, RaysThatKnowHowWideTheyAreDoNotChangeASceneWithoutVoxels) {
  expect_same_picture(plain_scene(), {"voxels"}, {&FramePlan::voxels});
}

TEST(FramePlanTest, CodeForSurfaceDetailsDoesNotChangeASceneWithoutThem) {
  expect_same_picture(plain_scene(), {"surface details"}, {&FramePlan::surface_details});
  Scene textured = plain_scene();
  textured.textures.push_back({"blue", 2, 1, true, {}, {}, {10, 20, 200, 255, 250, 20, 10, 255}});
  textured.materials[0].base_colour_texture = textured.materials[1].metallic_roughness_texture = 0;
  expect_same_picture(textured, {"surface details"}, {&FramePlan::surface_details});
}

TEST(FramePlanTest, CodeForFurtherLobesDoesNotChangeASceneWithoutThem) {
  expect_same_picture(plain_scene(), {"further lobes"}, {&FramePlan::further_lobes});
  expect_same_picture(catcher_scene(), {"further lobes"}, {&FramePlan::further_lobes});
}

TEST(FramePlanTest, CodeForHolesAndSidesDoesNotChangeASceneWithoutThem) {
  expect_same_picture(plain_scene(), {"alpha masks"}, {&FramePlan::alpha_mask});
  expect_same_picture(plain_scene(), {"back faces left out"}, {&FramePlan::back_face_culling});
}

TEST(FramePlanTest, CodeForLayersDoesNotChangeASceneWithoutBlendedSurfaces) {
  expect_same_picture(catcher_scene(), {"alpha layers"}, {&FramePlan::alpha_blend});
}

TEST(FramePlanTest, SpecularCodeDoesNotChangeASceneOfCatchersAlone) {
  Scene scene = catcher_scene();
  scene.instances[1].catcher = true;
  expect_same_picture(scene, {"specular lobe"}, {&FramePlan::specular});
}

TEST(FramePlanTest, CatcherCodeDoesNotChangeASceneWithoutCatchers) {
  expect_same_picture(plain_scene(), {"catchers", "catcher shadow rays"},
                      {&FramePlan::catchers, &FramePlan::catchers_occlude});
}

TEST(FramePlanTest, SecondRaysDoNotChangeASceneWhereNothingSendsThem) {
  expect_same_picture(catcher_scene(), {"mirror rays", "mirror rays of catchers", "refraction"},
                      {&FramePlan::mirror_rays, &FramePlan::catcher_mirrors, &FramePlan::refraction});
}

TEST(FramePlanTest, ShadowRaysAmongCatchersDoNotChangeAFlatOne) {
  const Scene scene = catcher_scene();
  expect_same_picture(scene, {"catcher shadow rays"}, {&FramePlan::catchers_occlude});
  const auto rays = [&](std::vector<std::string> force) {
    return render_forcing(scene, std::move(force)).frame.counters.rays[RayKind::catcher_shadow];
  };
  EXPECT_EQ(rays({}), 0);
  EXPECT_GT(rays({"catcher shadow rays"}), 0) << "the sphere's shadow must send them, or nothing was tested";
}

TEST(FramePlanTest, ARatioPerChannelIsTheSameUnderWhiteLight) {
  expect_same_picture(catcher_scene(), {kColouredRatio}, {&FramePlan::coloured_ratio});
}

TEST(FramePlanTest, EverythingThatIsLeftOutChangesNoBitTogether) {
  for (const Scene& scene : {plain_scene(), catcher_scene()}) {
    const PlannedFrame lean = render_forcing(scene, {});
    const std::vector<std::string> names = left_out(lean.plan);
    EXPECT_GE(names.size(), 8u);
    const PlannedFrame full = render_forcing(scene, names);
    for (const PlanEntry& entry : full.plan.entries) EXPECT_TRUE(entry.runs || !entry.unneeded) << entry.name;
    test::expect_same_bits(lean.frame, full.frame);
  }
}

TEST(FramePlanTest, RefusesToInsistOnWhatIsNoEntry) {
  RenderSettings settings = direct_light_settings();
  settings.force = {"texture"};
  EXPECT_THROW(plan_frame(plain_scene(), settings, true), std::invalid_argument);
}

TEST(FramePlanTest, InsistingDoesNotOverruleTheOtherSettings) {
  Scene scene = plain_scene();
  scene.materials[1].mirror = 0.5f;
  RenderSettings settings = direct_light_settings();
  settings.reflections = false;
  settings.force = {"mirror rays"};
  EXPECT_FALSE(plan_frame(scene, settings, true).mirror_rays) << "it would change the picture";
}

bool runs(const FramePlan& plan, const std::string& name) {
  for (const PlanEntry& entry : plan.entries) {
    if (entry.name == name) return entry.runs;
  }
  ADD_FAILURE() << "no entry '" << name << "'";
  return false;
}

TEST(FramePlanTest, EveryEntryHasItsNameAndReason) {
  RenderSettings settings = direct_light_settings();
  for (const Scene& scene : {Scene{}, plain_scene(), catcher_scene()}) {
    for (const bool camera : {false, true}) {
      const FramePlan plan = plan_frame(scene, settings, camera);
      EXPECT_GE(plan.entries.size(), 10u);
      for (const PlanEntry& entry : plan.entries) {
        EXPECT_FALSE(entry.name.empty());
        EXPECT_FALSE(entry.reason.empty()) << entry.name;
      }
    }
  }
}

TEST(FramePlanTest, FollowsTheSceneAndTheSettings) {
  RenderSettings settings = direct_light_settings();
  const FramePlan plain = plan_frame(plain_scene(), settings, false);
  EXPECT_TRUE(plain.polar);
  EXPECT_TRUE(plain.specular);
  EXPECT_FALSE(plain.textures);
  EXPECT_FALSE(plain.mirror_rays);
  EXPECT_FALSE(plain.catchers);
  EXPECT_FALSE(plain.camera);
  EXPECT_FALSE(runs(plain, "light samples"));

  Scene scene = plain_scene();
  scene.materials[1].mirror = 0.5f;
  scene.lights[0].path_radius_m = 1;
  scene.lights[0].path_period_s = 10;
  settings.light_samples = 64;
  settings.foveation = Foveation::off;
  settings.gaze_marker = true;
  const FramePlan rich = plan_frame(scene, settings, true);
  EXPECT_FALSE(rich.polar);
  EXPECT_TRUE(rich.mirror_rays);
  EXPECT_TRUE(runs(rich, "light samples"));
  EXPECT_TRUE(rich.camera);
  EXPECT_TRUE(rich.gaze_marker);
  EXPECT_FALSE(runs(rich, "density overlay"));
  settings.density_overlay = true;
  EXPECT_TRUE(runs(plan_frame(scene, settings, true), "density overlay"));
  EXPECT_TRUE(runs(rich, "mirror rays"));
  EXPECT_FALSE(runs(rich, "log-polar rays"));

  settings.reflections = settings.camera = false;
  const FramePlan without = plan_frame(scene, settings, true);
  EXPECT_FALSE(without.mirror_rays);
  EXPECT_FALSE(without.camera);
}

TEST(FramePlanTest, ThePapersFrameHasProbesAndOcclusionInPlaceOfConstantLight) {
  Scene scene = plain_scene();
  scene.ambient = glm::vec3{0.1f};
  const FramePlan paper = plan_frame(scene, RenderSettings(), false);
  EXPECT_TRUE(runs(paper, "probes"));
  EXPECT_TRUE(runs(paper, "ambient occlusion"));
  EXPECT_FALSE(runs(paper, "constant ambient light"));
  const FramePlan direct = plan_frame(scene, direct_light_settings(), false);
  EXPECT_FALSE(runs(direct, "probes"));
  EXPECT_FALSE(runs(direct, "ambient occlusion"));
  EXPECT_TRUE(runs(direct, "constant ambient light"));
  scene.ambient = glm::vec3{0.0f};
  EXPECT_FALSE(runs(plan_frame(scene, direct_light_settings(), false), "constant ambient light"));
}

TEST(FramePlanTest, ATextureCountsOnlyWhereTheMeshHasCoordinates) {
  Scene scene = plain_scene();
  scene.textures.push_back({"white", 1, 1, true, {}, {}, {255, 255, 255, 255}});
  scene.materials[0].base_colour_texture = 0;
  EXPECT_TRUE(plan_frame(scene, direct_light_settings(), false).textures);
  scene.meshes[0].uvs.clear();
  EXPECT_FALSE(plan_frame(scene, direct_light_settings(), false).textures);
}

TEST(FramePlanTest, CatchersShadowOneAnotherUnlessThereIsOneAndItIsFlat) {
  EXPECT_FALSE(plan_frame(catcher_scene(), direct_light_settings(), true).catchers_occlude);
  Scene two = catcher_scene();
  test::add(two, test::floor_quad(1, 1), test::matte(glm::vec3{0.5f}), true);
  EXPECT_TRUE(plan_frame(two, direct_light_settings(), true).catchers_occlude);
  Scene box;
  test::add(box, test::box({0, 0, 0}, {1, 1, 1}), test::matte(glm::vec3{0.5f}), true);
  EXPECT_TRUE(plan_frame(box, direct_light_settings(), true).catchers_occlude);
}

TEST(FramePlanTest, TheRatioHasAColourWhereLightOrAmbientHas) {
  Scene scene = catcher_scene();
  EXPECT_FALSE(plan_frame(scene, direct_light_settings(), true).coloured_ratio);
  scene.lights[0].intensity_w_sr = {15, 15, 14};
  EXPECT_TRUE(plan_frame(scene, direct_light_settings(), true).coloured_ratio);
  scene.lights[0].intensity_w_sr = {0, 0, 0};  // one that does not shine has no colour
  EXPECT_FALSE(plan_frame(scene, direct_light_settings(), true).coloured_ratio);
  scene.ambient = {0.1f, 0.1f, 0.2f};
  EXPECT_TRUE(plan_frame(scene, direct_light_settings(), true).coloured_ratio);
  scene.instances[0].catcher = false;
  EXPECT_FALSE(plan_frame(scene, direct_light_settings(), true).coloured_ratio);
}

}  // namespace
}  // namespace herr
