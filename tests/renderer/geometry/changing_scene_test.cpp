// Scenes that change: what a change costs, and that a changed scene is the picture of one loaded that way.
#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdio>

#include "renderer/frame/renderer_impl.h"
#include "scenes/changes/world.h"
#include "scenes/model/placed_objects.h"
#include "tests/renderer/geometry/changing_scenes.h"

namespace herr {
namespace {

using test::bring_up_to_date;
using test::fresh;
using test::small_world;
using test::with_threads;

SceneChange change(ChangeKind kind, const std::string& name, const glm::dvec3& to = glm::dvec3(0.0)) {
  SceneChange made;
  made.kind = kind;
  made.name = name;
  if (kind == ChangeKind::move || kind == ChangeKind::spawn) made.placement.translation = to;
  if (kind == ChangeKind::spawn) made.of = "instance 2";
  return made;
}

TEST(ChangingSceneTest, AnUnchangedFrameCommitsNothingAndAMovedInstanceOnlyTheTopLevel) {
  Scene scene = small_world();
  World world(scene);
  Renderer renderer(scene, test::small_profile(), with_threads(1), false);
  const FrameSample sample = test::sample_from({0, 0, 0});
  RenderedFrame frame;
  renderer.render_frame(sample, world.state(), frame);
  EXPECT_EQ(frame.counters.commits, 1);  // the anchor's first place
  EXPECT_GT(frame.times.commit_ms, 0);
  EXPECT_LE(frame.times.commit_ms, frame.times[Stage::acceleration]);
  renderer.render_frame(sample, world.state(), frame);
  EXPECT_EQ(frame.counters.commits, 0);
  EXPECT_EQ(frame.times.commit_ms, 0);
  EXPECT_EQ(frame.counters.instances_moved, 0);
  ASSERT_FALSE(world.apply(change(ChangeKind::move, "instance 1", {0.5, 0.2, -3})));
  world.advance(0);
  renderer.render_frame(sample, world.state(), frame);
  EXPECT_EQ(frame.counters.commits, 1);
  EXPECT_EQ(frame.counters.instances_moved, 1);
  EXPECT_EQ(frame.counters.meshes_rebuilt + frame.counters.meshes_refitted, 0);
  test::expect_same_bits(frame, fresh(scene, world.state(), with_threads(1), sample));
}

TEST(ChangingSceneTest, EachKindOfChangeGivesThePictureOfASceneLoadedThatWay) {
  for (const int threads : {1, 2, 4}) {
    SCOPED_TRACE(threads);
    Scene scene = small_world();
    World world(scene);
    const RenderSettings settings = with_threads(threads);
    Renderer renderer(scene, test::small_profile(), settings, false);
    const FrameSample sample = test::sample_from({0, 0, 0}, {0.1, -0.1, -1});
    RenderedFrame frame;
    renderer.render_frame(sample, world.state(), frame);
    SceneChange mirror = change(ChangeKind::set_material, "instance 1");
    mirror.material.emplace();
    mirror.material->mirror = 0.7f;
    SceneChange mesh = change(ChangeKind::replace_mesh, "instance 1");
    mesh.of = "instance 2";
    for (const SceneChange& one :
         {change(ChangeKind::spawn, "a", {0.8, 0, -2.5}), change(ChangeKind::spawn, "b", {-0.8, 0, -2.5}),
          mirror, change(ChangeKind::remove, "a"), mesh, change(ChangeKind::remove, "instance 0")}) {
      SCOPED_TRACE(static_cast<int>(one.kind));
      ASSERT_FALSE(world.apply(one));
      world.advance(0);
      renderer.render_frame(sample, world.state(), frame);
      test::expect_same_bits(frame, fresh(scene, world.state(), settings, sample));
    }
  }
}

TEST(ChangingSceneTest, AMirrorThatAppearsChangesThePlanAndOneThatGoesChangesItBack) {
  Scene scene = small_world();
  World world(scene);
  Renderer renderer(scene, test::small_profile(), with_threads(1), false);
  const FrameSample sample = test::sample_from({0, 0, 0});
  RenderedFrame frame;
  renderer.render_frame(sample, world.state(), frame);
  EXPECT_FALSE(renderer.plan().mirror_rays);
  const FramePlan before = renderer.plan();
  SceneChange mirror = change(ChangeKind::set_material, "instance 1");
  mirror.material.emplace();
  mirror.material->mirror = 1.0f;
  ASSERT_FALSE(world.apply(mirror));
  world.advance(0);
  renderer.render_frame(sample, world.state(), frame);
  EXPECT_EQ(frame.counters.plan_changes, 1);
  EXPECT_TRUE(renderer.plan().mirror_rays);
  EXPECT_GT(frame.counters.rays[RayKind::mirror], 0);
  ASSERT_EQ(differing_entries(before, renderer.plan()).size(), 1u);
  EXPECT_EQ(differing_entries(before, renderer.plan())[0].name, "mirror rays");
  ASSERT_FALSE(world.apply(change(ChangeKind::remove, "instance 1")));
  world.advance(0);
  renderer.render_frame(sample, world.state(), frame);
  EXPECT_EQ(frame.counters.plan_changes, 1);
  EXPECT_FALSE(renderer.plan().mirror_rays);
}

TEST(ChangingSceneTest, AThousandSpawnsAndRemovalsEndWithTheMemoryAndThePicturesOfAFreshStart) {
  Scene scene = small_world();
  World world(scene);
  RenderSettings settings = with_threads(2);
  settings.polar_width = 16;
  settings.polar_height = 12;
  Renderer renderer(scene, test::small_profile(), settings, false);
  const FrameSample sample = test::sample_from({0, 0, 0});
  RenderedFrame frame;
  const auto bytes_in_use = [] {
    return static_cast<std::int64_t>(mallinfo2().uordblks + mallinfo2().hblkhd);
  };
  // Ten objects are there at a time: one comes and one goes with each frame.
  const auto name = [](int i) { return "object " + std::to_string(i); };
  std::int64_t start = 0;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 0.1 * i;
    ASSERT_FALSE(world.apply(change(ChangeKind::spawn, name(i),
                                    {std::cos(angle), 0.5 * std::sin(3 * angle), -2.5 + std::sin(angle)})));
    if (i >= 10) {
      ASSERT_FALSE(world.apply(change(ChangeKind::remove, name(i - 10))));
    }
    world.advance(0);
    renderer.render_frame(sample, world.state(), frame);
    EXPECT_EQ(frame.counters.instances_spawned, 1);
    if (i == 20) start = bytes_in_use();
    if (i % 100 == 50) test::expect_same_bits(frame, fresh(scene, world.state(), settings, sample));
  }
  const std::int64_t end = bytes_in_use();
  std::printf("memory after 1000 spawns and removals: %+.3f MB\n", static_cast<double>(end - start) * 1e-6);
  EXPECT_LT(end - start, 1'000'000);
  EXPECT_LE(scene.instances.size(), 14u);  // three of the scene, ten at a time and one that overlaps
}

TEST(ChangingSceneTest, OneOfTenThousandInstancesMovesAtTheCostOfBareEmbreesTopLevel) {
  Scene scene;
  test::add(scene, test::box({-0.3f, -0.3f, -0.3f}, {0.3f, 0.3f, 0.3f}), test::matte(glm::vec3{0.5f}));
  const Instance first = scene.instances[0];
  scene.instances.clear();
  for (int i = 0; i < 10'000; ++i) {
    Instance& instance = scene.instances.emplace_back(first);
    instance.name = "instance " + std::to_string(i);
    instance.world_from_object[3] = {i % 22, i / 22 % 22, i / 484};
  }
  complete_objects(scene);
  World world(scene);
  RenderThreads threads(2);
  std::unique_ptr<EmbreeScene> geometry;
  threads.inside([&] { geometry = std::make_unique<EmbreeScene>(scene, resolve_isa(Isa::best), 2); });
  SceneUpdate update;
  threads.inside([&] { update = bring_up_to_date(*geometry, world.state()); });
  // The same again with nothing of ours around it.
  const EmbreeDevice device(resolve_isa(Isa::best), 2);
  const MeshGeometry mesh = build_mesh(device, scene.meshes[0], {});
  const EmbreeSceneHandle top(device);
  rtcSetSceneBuildQuality(top.get(), RTC_BUILD_QUALITY_HIGH);
  std::vector<RTCGeometry> bare;
  const auto place = [&](std::size_t i, float x) {
    const glm::dvec3& p = scene.instances[i].world_from_object[3];
    const float to_x = static_cast<float>(p.x) + x, to_y = static_cast<float>(p.y),
                to_z = static_cast<float>(p.z);
    const float columns[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, to_x, to_y, to_z};
    rtcSetGeometryTransform(bare[i], 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    rtcCommitGeometry(bare[i]);
  };
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    bare.push_back(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(bare[i], mesh.scene.get());
    rtcAttachGeometryByID(top.get(), bare[i], static_cast<unsigned>(i));
    place(i, 0);
  }
  threads.inside([&] { top.commit(); });
  std::vector<double> ours, embrees, nothing;
  for (int i = 0; i < 15; ++i) {
    const double x = 0.01 * (i + 1);
    ours.push_back(wall_ms([&] {
      ASSERT_FALSE(world.apply(change(ChangeKind::move, "instance 4242", {4 + x, 0, 0})));
      world.advance(0);
      threads.inside([&] { update = bring_up_to_date(*geometry, world.state()); });
    }));
    EXPECT_EQ(update.commits, 1);
    EXPECT_EQ(update.moved, 1);
    embrees.push_back(wall_ms([&] {
      place(4242, static_cast<float>(x));
      threads.inside([&] { top.commit(); });
    }));
    nothing.push_back(wall_ms([&] {
      world.advance(0);
      threads.inside([&] { update = bring_up_to_date(*geometry, world.state()); });
    }));
    EXPECT_EQ(update.commits, 0);
  }
  for (RTCGeometry geometry_of_one : bare) rtcReleaseGeometry(geometry_of_one);
  std::printf(
      "10,000 instances, one moved: %.2f ms, bare Embree %.2f ms; nothing moved: %.4f ms (medians of 15)\n",
      median(ours), median(embrees), median(nothing));
  // The two do the same commit: what is around it is a comparison of 10,000 numbers.
  EXPECT_LT(median(ours), 1.5 * median(embrees));
  EXPECT_LT(median(nothing), 0.1 * median(embrees));
}

}  // namespace
}  // namespace herr
