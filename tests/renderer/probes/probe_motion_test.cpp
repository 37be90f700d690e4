// What moves is followed by the sight of probes: walls that come hold the light, walls that go let it in, at
// the pace of tau, and no slower than 3 tau.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/probes/probe_reader.h"
#include "scenes/changes/world.h"
#include "scenes/model/placed_objects.h"
#include "tests/renderer/probes/probe_scenes.h"

namespace herr {
namespace {

constexpr double kAlbedo = 0.5, kTau = 0.1, kHz = 90;
constexpr glm::dvec3 kSize{3, 2, 6};
constexpr double kAway = 20;  // z of the wall while it is out of the way
const char* const kWall = "instance 1";

// A closed room, a lamp in its near half, and a wall of 5 cm across it whose middle lies at z.
Scene room_with_wall_at(double z) {
  Scene scene;
  test::add(scene, test::box({0, 0, 0}, glm::vec3(kSize)),
            test::matte(glm::vec3{static_cast<float>(kAlbedo)}));
  const glm::vec3 half{1.51f, 1.01f, 0.025f};
  test::add(scene, test::box(-half, half), test::matte(glm::vec3{static_cast<float>(kAlbedo)}), false,
            glm::translate(glm::dmat4(1.0), glm::dvec3(1.5, 1, z)));
  scene.lights = {test::light_at({1.2, 1.1, 1.2}, glm::vec3{5.0f})};
  scene.probes.counts = {6, 4, 12};
  scene.probes.box = Bounds{{0, 0, 0}, kSize};
  scene.changes = true;
  complete_objects(scene);
  return scene;
}

// A renderer of that room at 90 Hz, and the changes that the world makes in it.
class MovingRoom {
 public:
  explicit MovingRoom(double wall_z, int threads = 2)
      : scene_(room_with_wall_at(wall_z)),
        world_(scene_),
        renderer_(scene_, view(), settings(threads), false) {
    sample_.head.world_from_head.position = {1.5, 1, 5.4};
    sample_.head.world_from_head.orientation = glm::angleAxis(-0.6, glm::dvec3{1, 0, 0});
  }
  static const DisplayProfile& view() {
    static const DisplayProfile profile = test::single_view(16, 16, 40, 40);
    return profile;
  }
  static RenderSettings settings(int threads) {
    RenderSettings settings = test::probe_settings(kTau);
    settings.threads = threads;
    return settings;
  }
  void move_wall(double z) {
    SceneChange change;
    change.kind = ChangeKind::move;
    change.name = kWall;
    change.placement.translation = {1.5, 1, z};
    ASSERT_FALSE(world_.apply(change));
    world_.advance(0);
  }
  void run(int frames) {
    for (int i = 0; i < frames; ++i) {
      sample_.t_ns += static_cast<TimeNs>(std::llround(1e9 / kHz));
      renderer_.render_frame(sample_, world_.state(), frame_);
    }
  }
  // Mean of the picture: no lamp shines on what it shows while the wall stands between, all is indirect.
  double mean() const {
    double sum = 0;
    test::for_each_pixel(frame_.viewports[0], [&](int, int, const test::Pixel& pixel) { sum += pixel[1]; });
    return sum / (16 * 16);
  }
  double indirect_mean() {
    RenderSettings without = settings(2);
    without.probes.on = false;
    Renderer direct(scene_, view(), without, false);
    RenderedFrame lit;
    direct.render_frame(sample_, world_.state(), lit);
    return test::mean_of(test::indirect_of_pixels(frame_.viewports[0], lit.viewports[0], kAlbedo));
  }
  const ProbeMotion& motion() { return *renderer_.internals().probe_motion; }
  Renderer& renderer() { return renderer_; }
  const RenderedFrame& frame() const { return frame_; }
  void take_up(const RendererState& state, const FrameSample& sample) {
    renderer_.restore(state);
    sample_ = sample;
  }
  void turn_back(double seconds) { sample_.t_ns -= static_cast<TimeNs>(std::llround(1e9 * seconds)); }
  const FrameSample& sample() const { return sample_; }

 private:
  Scene scene_;
  World world_;
  Renderer renderer_;
  FrameSample sample_ = test::sample_from({0, 0, 0});
  RenderedFrame frame_;
};

int frames_in(double taus) {
  return static_cast<int>(std::ceil(taus * kTau * kHz));
}

TEST(ProbeMotionTest, AWallThatComesHoldsTheLightAfterThreeTau) {
  MovingRoom room(kAway);
  room.run(frames_in(12));
  const double open = room.indirect_mean();
  room.move_wall(3);
  room.run(frames_in(3));
  EXPECT_LE(room.mean() / test::scattered_share(kAlbedo), 0.01 * open);
}

// Walls between the probes' layers and in one: the light that comes is that of a renderer which knew the room
// so from the start.
TEST(ProbeMotionTest, AWallThatGoesLetsTheLightInAsIfItHadNeverBeenThere) {
  for (const double z : {3.0, 3.25}) {
    SCOPED_TRACE(z);
    MovingRoom room(z), fresh(kAway);
    room.run(frames_in(12));
    fresh.run(frames_in(12));
    room.move_wall(kAway);
    room.run(frames_in(3));
    const double expected = fresh.indirect_mean();
    EXPECT_NEAR(room.indirect_mean(), expected, 0.05 * expected);
    EXPECT_EQ(room.motion().restless(), 0);
  }
}

// The same for a wall that moves on within the room, by less than one cell and by several.
TEST(ProbeMotionTest, AWallThatMovesOnIsWhereItIs) {
  MovingRoom open(kAway);
  open.run(frames_in(12));
  const double lit = open.indirect_mean();
  for (const double z : {2.9, 4.0}) {
    SCOPED_TRACE(z);
    MovingRoom room(2.6);
    room.run(frames_in(6));
    room.move_wall(z);
    room.run(frames_in(3));
    EXPECT_LE(room.mean() / test::scattered_share(kAlbedo), 0.01 * lit);
  }
}

// Along +z a probe at z0 sees the end of the room at 6 - z0, then the wall at z - 0.025 - z0. Its inverse
// goes from one to the other as 1 - exp(-t / tau), as of its last look, at most a quarter of tau and a frame
// ago.
TEST(ProbeMotionTest, SightSettlesWithTau) {
  MovingRoom room(kAway);
  room.run(10);
  const auto reader = room.renderer().probes();
  const ProbeGrid& grid = reader->grid();
  const int probe = grid.index({4, 3, 6});
  const double from = grid.position({4, 3, 6}).z, wall = 3.8;
  int node = 0;  // towards +z: the middle of the map
  for (int i = 0; i < DistanceNodes::kCount; ++i) {
    if (DistanceNodes::direction(i).z > 0.9999) node = i;
  }
  const auto inverse = [&] {
    ProbeReader::Sight sight;
    room.renderer().probes()->sight(0, probe, sight);
    return 1.0 / double{sight.distance_m[static_cast<std::size_t>(node)]};
  };
  const double before = 1 / (kSize.z - from), after = 1 / (wall - 0.025 - from);
  ASSERT_NEAR(inverse(), before, 0.002 * before);
  room.move_wall(wall);
  for (int frame = 1; frame <= frames_in(3); ++frame) {
    room.run(1);
    const double t = frame / kHz, settled = (inverse() - before) / (after - before);
    EXPECT_LE(settled, (t < 2.25 * kTau ? 1 - std::exp(-t / kTau) : 1.0) + 0.01) << frame;
    EXPECT_GE(settled, 1 - std::exp(-std::max(t - kTau / 4 - 1 / kHz, 0.0) / kTau) - 0.01) << frame;
  }
  EXPECT_NEAR(inverse(), after, 0.002 * after);
}

// Layers of 6 x 4 probes stand every 0.5 m from z = 0.25 on. A wall of 5 cm at 2.6 m changes those within 1.5
// layers: of 2.25, 2.75 and 3.25 m; at 3.2 m those of 2.75, 3.25 and 3.75 m. Each of the 96 looks 4 times in
// a tau of 9 frames. Nothing looks where nothing has moved, or what is told to move to where it is.
TEST(ProbeMotionTest, WhatAFrameLooksAtIsBounded) {
  MovingRoom room(2.6);
  room.run(3);
  EXPECT_EQ(room.motion().looked(), 0);
  room.move_wall(2.6);
  room.run(1);
  EXPECT_EQ(room.motion().looked(), 0);
  room.move_wall(3.2);
  room.run(1);
  EXPECT_EQ(room.motion().restless(), 96);
  for (int frame = 1; frame < frames_in(3); ++frame) {
    EXPECT_LE(room.motion().looked(), std::ceil(96 * 4 / 9.0));
    room.run(1);
  }
  EXPECT_EQ(room.motion().restless(), 0);
  room.run(1);
  EXPECT_EQ(room.motion().looked(), 0);
}

// Another run begins: all that the first frame of it shows is as things stand.
TEST(ProbeMotionTest, TimeThatTurnsBackBringsAllUpToDate) {
  MovingRoom room(kAway), fresh(3);
  room.run(20);
  room.move_wall(3);
  room.turn_back(0.1);
  room.run(1), fresh.run(1);
  EXPECT_EQ(room.motion().restless(), 0);
  ProbeReader::Sight seen, expected;
  for (int probe = 0; probe < 6 * 4 * 12; ++probe) {
    room.renderer().probes()->sight(0, probe, seen);
    fresh.renderer().probes()->sight(0, probe, expected);
    ASSERT_EQ(seen.distance_m, expected.distance_m) << probe;
    ASSERT_EQ(seen.deviation_per_m, expected.deviation_per_m) << probe;
  }
}

TEST(ProbeMotionTest, PicturesAreTheSameWithAnyThreadsAndAfterAResume) {
  const auto move_on = [](MovingRoom& room) {
    room.move_wall(3.4);
    room.run(5);
  };
  MovingRoom one(kAway, 1), three(kAway, 3);
  for (MovingRoom* room : {&one, &three}) {
    room->run(4);
    room->move_wall(3);
    room->run(6);
  }
  test::expect_same_bits(one.frame(), three.frame());
  const RendererState state = one.renderer().state();
  // Another renderer is built on the room as it is loaded; the world brings it to where the wall stands.
  MovingRoom resumed(kAway, 2);
  resumed.take_up(state, one.sample());
  resumed.move_wall(3);
  resumed.run(1), one.run(1);
  test::expect_same_bits(one.frame(), resumed.frame());
  EXPECT_EQ(one.motion().looked(), resumed.motion().looked());
  EXPECT_GT(one.motion().restless(), 0);
  move_on(one), move_on(resumed);
  test::expect_same_bits(one.frame(), resumed.frame());
  EXPECT_EQ(one.renderer().state().probes, resumed.renderer().state().probes);
}

TEST(ProbeMotionTest, StatesThatWereCutOffAreRefused) {
  MovingRoom room(kAway);
  room.run(1);
  room.move_wall(3);
  room.run(3);
  const RendererState whole = room.renderer().state();
  for (const std::size_t left :
       {std::size_t{0}, std::size_t{7}, whole.probes.size() / 2, whole.probes.size() - 1}) {
    RendererState part = whole;
    part.probes.resize(left);
    MovingRoom other(kAway);
    EXPECT_THROW(other.take_up(part, room.sample()), std::invalid_argument) << left;
  }
}

}  // namespace
}  // namespace herr
