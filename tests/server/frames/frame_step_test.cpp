// The one frame step: rewound it gives the frames of a fresh replay, bit for bit, and it allocates nothing.
#include "server/frames/frame_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "renderer/frame_counters.h"
#include "renderer/settings_presets.h"
#include "server/check/measure/allocation_counter.h"
#include "server/process/steady_time.h"
#include "server/results/fingerprint.h"
#include "server/results/settings_report.h"
#include "tests/server/moving_scene.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

struct Opened {
  ReplayOptions options;
  SessionReport report;
  OpenedSession session;
};

struct Picture {
  std::vector<std::uint16_t> values;
  FrameCounters counters;
};

class FrameStepTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_moving_scene(root() / "moving.scene.json");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "walk", 0.2);
    options_.scene = (root() / "moving.scene.json").string();
    options_.profile = (root() / "small.profile.json").string();
    options_.render = direct_light_settings();
    options_.render.polar_width = 64;
    options_.render.polar_height = 64;
    options_.render.threads = 2;
  }
  const fs::path& root() const { return folder_.path(); }

  std::unique_ptr<Opened> open() const {
    auto opened = std::make_unique<Opened>();
    opened->options = options_;
    opened->report.name = "walk";
    opened->report.session_folder = root() / "walk";
    open_session(opened->options, opened->report, opened->session);
    return opened;
  }

  static Picture picture_of(const RenderedFrame& frame) {
    Picture picture;
    for (const ViewportImage& viewport : frame.viewports) {
      for (int y = 0; y < viewport.height_px; ++y) {
        const auto* row = viewport.row(y);
        picture.values.insert(picture.values.end(), row, row + 4 * viewport.width_px);
      }
    }
    picture.counters = frame.counters;
    return picture;
  }

  // Every frame of the range from the `first` on.
  static std::vector<Picture> pictures(FrameStep& step, const FrameRange& range, std::int64_t first = 0) {
    std::vector<Picture> all;
    RenderedFrame frame;
    for (std::int64_t i = first; i < range.count; ++i) {
      step.prepare(range.first + i);
      EXPECT_TRUE(step.render(frame));
      all.push_back(picture_of(frame));
    }
    return all;
  }

  static void expect_same(const std::vector<Picture>& one, const std::vector<Picture>& other) {
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_TRUE(one[i].values == other[i].values) << "frame " << i;
      EXPECT_EQ(one[i].counters.rays.of_kind, other[i].counters.rays.of_kind) << "frame " << i;
      for (const CounterRow& row : counter_rows()) {
        EXPECT_EQ(one[i].counters.*row.value, other[i].counters.*row.value) << row.name << " of frame " << i;
      }
    }
  }

  ReplayOptions options_;

 private:
  TemporaryFolder folder_;
};

// The small session looks straight ahead, at 60 Hz of its display: 1000 / 60 ms.
TEST_F(FrameStepTest, TellsTheGazeAndThePeriodOfAFrame) {
  const auto opened = open();
  FrameStep step(opened->options, opened->report, opened->session);
  RenderedFrame frame;
  step.prepare(opened->report.range.first + 1);
  ASSERT_TRUE(step.render(frame));
  EXPECT_NEAR(step.record().period_ms, 1000.0 / 60, 1e-9);
  for (const glm::dvec3& gaze : step.record().gaze_in_head) EXPECT_EQ(gaze, glm::dvec3(0, 0, -1));
}

TEST_F(FrameStepTest, FramesAfterRewindingAreThoseOfAFreshReplay) {
  for (const bool probes : {false, true}) {
    options_.render.probes.on = probes;
    const auto opened = open();
    FrameStep step(opened->options, opened->report, opened->session);
    const std::vector<Picture> first = pictures(step, opened->report.range);
    FrameCounters all;
    for (const Picture& picture : first) all += picture.counters;
    // The cart in each frame but the first, the ball once; the box comes, changes and goes.
    EXPECT_EQ(all.instances_moved, opened->report.range.count - 1 + 1);
    EXPECT_EQ(all.instances_spawned, 1);
    EXPECT_EQ(all.instances_restyled, 1);
    EXPECT_EQ(all.instances_removed, 1);
    EXPECT_GT(all.plan_changes, 0);
    for (int again = 0; again < 2; ++again) {
      step.rewind();
      expect_same(pictures(step, opened->report.range), first);
    }
  }
}

// Told in the header of pictures and in the fingerprint as it was used, whoever named it.
TEST_F(FrameStepTest, TheFeedLiesWhereTheFlagElseTheSessionSays) {
  const auto told = [](const Opened& opened) {
    return settings_text(resolved_options(opened.options, opened.report), true);
  };
  const auto usual = open();
  EXPECT_EQ(usual->report.settings.feed_distance_m, 2.0);
  EXPECT_EQ(told(*usual).find("feed distance"), std::string::npos);

  const fs::path header = root() / "walk" / "session.json";
  std::ifstream in(header);
  nlohmann::json json = nlohmann::json::parse(in);
  json["feed_distance_m"] = 3.5;
  std::ofstream(header) << json;
  const auto named = open();
  EXPECT_EQ(named->report.settings.feed_distance_m, 3.5);
  EXPECT_NE(told(*named).find("feed distance 3.5 m"), std::string::npos) << told(*named);
  const auto before = fingerprint_of(usual->report, usual->options, usual->session.scene);
  const auto now = fingerprint_of(named->report, named->options, named->session.scene);
  EXPECT_EQ(difference(before, now), "--feed-distance was 2, is 3.5");

  options_.render.feed_distance_m = 1.25;
  EXPECT_EQ(open()->report.settings.feed_distance_m, 1.25);
}

TEST_F(FrameStepTest, RewoundInTheMiddleItBeginsAtTheBeginning) {
  const auto opened = open();
  FrameStep step(opened->options, opened->report, opened->session);
  const std::vector<Picture> first = pictures(step, opened->report.range);
  step.rewind();
  RenderedFrame frame;
  step.prepare(opened->report.range.first + 7);  // the box is there
  step.render(frame);
  EXPECT_EQ(frame.counters.instances_spawned, 1);
  step.rewind();
  expect_same(pictures(step, opened->report.range), first);
}

TEST_F(FrameStepTest, AnotherRendererRewoundBeginsAtTheBeginning) {
  const auto opened = open();
  FrameStep step(opened->options, opened->report, opened->session);
  const std::vector<Picture> first = pictures(step, opened->report.range);
  step.rewind();
  build_renderer(options_.render, opened->report, opened->session);
  step.rewind();
  expect_same(pictures(step, opened->report.range), first);
}

TEST_F(FrameStepTest, FramesAfterThosePassedOverAreTheSame) {
  options_.render.probes.on = true;
  const auto opened = open();
  FrameStep step(opened->options, opened->report, opened->session);
  std::vector<Picture> all = pictures(step, opened->report.range);
  step.rewind();
  for (std::int64_t i = 0; i < 8; ++i) {
    step.prepare(opened->report.range.first + i);
    step.skip_frame();
  }
  all.erase(all.begin(), all.begin() + 8);
  expect_same(pictures(step, opened->report.range, 8), all);
}

TEST_F(FrameStepTest, ALapTakesTheSceneBackAndKeepsTheRenderer) {
  const auto opened = open();
  FrameStep step(opened->options, opened->report, opened->session);
  const std::vector<Picture> first = pictures(step, opened->report.range);
  step.begin_lap();
  const std::vector<Picture> lap = pictures(step, opened->report.range);
  for (std::size_t i = 0; i < lap.size(); ++i) EXPECT_TRUE(lap[i].values == first[i].values) << i;
}

// Nothing moves: a ball of glass and a mirror before the feed, and a real floor.
void write_still_scene(const fs::path& file) {
  write_text(file, R"({"format_version": 1, "name": "still",
"shapes": [
  {"name": "ball", "sphere": {"centre": [0.4, 1, -2], "radius": 0.3},
   "material": {"roughness": 0, "transmission": 1, "refractive_index": 1.5}},
  {"name": "mirror", "box": {"min": [-0.8, 0.6, -2.2], "max": [-0.3, 1.2, -1.8]},
   "material": {"mirror": 1, "roughness": 0}},
  {"name": "block", "box": {"min": [-0.2, 0, -3], "max": [0.2, 0.8, -2.6]}}],
"catchers": [{"name": "floor", "quad": [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5]]}],
"lights": [{"name": "lamp", "centre": [0, 3, 1], "size": [0.5, 0.1, 0.5], "intensity_w_sr": [10, 10, 10]}],
"ambient": [0.2, 0.2, 0.2]})");
}

// Of frames once every one of them was rendered before.
struct WarmFrames {
  std::int64_t frames = 0, allocations = 0;
  FrameCounters counters;
};

WarmFrames warm_frames(Opened& opened) {
  FrameStep step(opened.options, opened.report, opened.session);
  RenderedFrame frame;
  WarmFrames found;
  for (const bool warm : {false, true}) {
    for (std::int64_t i = 0; i < opened.report.range.count; ++i) {
      step.prepare(opened.report.range.first + i);
      const std::int64_t before = *allocations_counted();
      count_allocations(warm);
      step.render(frame);
      count_allocations(false);
      // A frame with another plan writes its reasons, and Embree's trees grow in the arena of their builders.
      if (!warm || frame.counters.commits > 0) continue;
      ++found.frames;
      found.allocations += *allocations_counted() - before;
      found.counters += frame.counters;
    }
    step.rewind();
  }
  return found;
}

// Where polar buffers follow the display, as where their size is fixed.
TEST_F(FrameStepTest, RenderingAllocatesNothingOnceEverythingWasThere) {
  if (!allocations_counted()) GTEST_SKIP() << "a sanitizer owns the allocator";
  write_still_scene(root() / "still.scene.json");
  options_.scene = (root() / "still.scene.json").string();
  for (const bool acuity : {false, true}) {
    options_.render.polar_acuity = acuity;
    if (acuity) options_.frames = 4;  // large ones
    const auto opened = open();
    const WarmFrames found = warm_frames(*opened);
    EXPECT_GE(found.frames, opened->report.range.count - 1) << "nothing moves after the first";
    EXPECT_EQ(found.allocations, 0) << acuity;
  }
}

// The default frame has probes, smoothed occlusion, mirrors, glass and the feed in both; further pictures are
// made of it.
TEST_F(FrameStepTest, ThePapersFrameAndFurtherPicturesAllocateNothingEither) {
  if (!allocations_counted()) GTEST_SKIP() << "a sanitizer owns the allocator";
  write_still_scene(root() / "still.scene.json");
  write_text(root() / "overview.view.json",
             R"({"name": "overview", "position_m": [2, 3, 3], "look_at_m": [0, 1, -1], "fov_deg": 60,
"width_px": 48, "height_px": 32, "samples": 2})");
  const RenderSettings direct = options_.render;
  options_.scene = (root() / "still.scene.json").string();
  for (const bool further : {false, true}) {
    options_.render = RenderSettings();
    options_.render.polar_width = direct.polar_width;
    options_.render.polar_height = direct.polar_height;
    options_.render.threads = direct.threads;
    ASSERT_TRUE(options_.render.probes.on && options_.render.occlusion_smoothing);
    ASSERT_GT(options_.render.occlusion_rays, 0);
    if (further) {
      options_.render.blended_view = Blend::context;
      options_.view = (root() / "overview.view.json").string();
    }
    const auto opened = open();
    EXPECT_EQ(further_views(opened->report.profile, opened->session.renderer->settings()).size(),
              further ? 3u : 0u)
        << "blended: of each eye";
    EXPECT_TRUE(opened->session.renderer->plan().mirrored_feed);
    const WarmFrames found = warm_frames(*opened);
    EXPECT_EQ(found.frames, opened->report.range.count) << "nothing moves";
    EXPECT_EQ(found.allocations, 0) << further;
    for (const RayKind kind :
         {RayKind::probe, RayKind::catcher_probe, RayKind::occlusion, RayKind::mirror, RayKind::refraction}) {
      EXPECT_GT(found.counters.rays[kind], 0) << name_of(kind);
    }
  }
}

// A picture from outside of 256 times as many pixels as the display has. The display's period lies between
// the time of a frame and that of the picture, as far from one as from the other.
TEST_F(FrameStepTest, FurtherViewsCountAgainstTheTicksOfADisplay) {
  std::ofstream(root() / "large.view.json")
      << R"({"position_m": [0, 1.5, 3], "look_at_m": [0, 1, -2], "width_px": 2048, "height_px": 960,)"
         R"( "samples": 1})";
  options_.view = (root() / "large.view.json").string();
  const auto opened = open();
  FrameStep step(opened->options, opened->report, opened->session);
  RenderedFrame frame;
  const auto render = [&](const FramePacing& pacing) {
    step.prepare(opened->report.range.first);
    EXPECT_TRUE(step.render(frame, nullptr, pacing));
    step.rewind();
  };
  const TimeNs begun_ns = steady_now_ns();
  render({});
  const double frame_ms = frame.times.frame_ms, views_ms = frame.times.views_ms;
  ASSERT_GT(views_ms, 3 * frame_ms);
  EXPECT_LE(static_cast<double>(step.finished_ns()) + 1e6 * views_ms, static_cast<double>(steady_now_ns()));
  EXPECT_GT(step.finished_ns(), begun_ns);

  const double period_ns = 1e6 * std::sqrt(frame_ms * views_ms);
  const TimeNs paced_ns = steady_now_ns();
  FramePacer pacer(paced_ns, period_ns, opened->report.range.first, opened->report.range.count);
  ASSERT_TRUE(pacer.begin(paced_ns));
  render({&pacer, 0});
  const FrameRecord& record = step.record();
  EXPECT_GE(static_cast<double>(step.finished_ns() - paced_ns),
            1e6 * (record.times.frame_ms + record.times.views_ms) - 1);
  ASSERT_LT(1e6 * record.times.frame_ms, period_ns);
  ASSERT_GT(1e6 * record.times.views_ms, period_ns);
  EXPECT_TRUE(record.missed);
  // Shown at the first tick after the views, not after the frame.
  ASSERT_TRUE(record.motion_to_photon_ms && record.pose_age_ms);
  EXPECT_GT(*record.motion_to_photon_ms - *record.pose_age_ms, record.times.views_ms);
}

TEST_F(FrameStepTest, DescribesTheFrameThatItRendered) {
  const auto opened = open();
  FrameStep step(opened->options, opened->report, opened->session);
  RenderedFrame frame;
  step.prepare(opened->report.range.first + 2);
  ASSERT_TRUE(step.render(frame));
  const FrameRecord& record = step.record();
  EXPECT_EQ(record.frame, opened->report.range.first + 2);
  EXPECT_EQ(record.t_ns, opened->report.range.time_ns(record.frame));
  EXPECT_EQ(record.times.frame_ms, frame.times.frame_ms);
  EXPECT_EQ(record.counters.viewport_pixels, 4 * 48 * 40);
  EXPECT_GT(record.sample_ms, 0);
  EXPECT_EQ(record.decision.reason, QualityReason::fixed);
  const std::atomic<bool> abandon{true};
  EXPECT_FALSE(step.render(frame, &abandon));
}

}  // namespace
}  // namespace herr
