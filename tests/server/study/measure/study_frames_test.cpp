// Which frames are chosen, of a session whose head turns faster and faster while the eyes look to and fro.
#include "server/study/measure/study_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <memory>

#include "renderer/settings_presets.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr double kRest_s = 0.6, kDuration_s = 6;
constexpr double kRestingGaze_deg = 5, kRadians = 0.017453292519943295;

// Still for kRest_s, then with 20 degrees/s^2.
double yaw_deg(double t_s) {
  const double moving_s = std::max(0.0, t_s - kRest_s);
  return 10 * moving_s * moving_s;
}
// 5 degrees at rest, then between 0 and 20, 1.3 times a second.
double gaze_deg(double t_s) {
  if (t_s <= kRest_s) return kRestingGaze_deg;
  return 10 - 10 * std::cos(8.168 * (t_s - kRest_s) + 1.0471975511965976);
}

void write_turning_session(const fs::path& folder) {
  SessionHeader header;
  header.name = "turning";
  header.profile = xr1_half_profile();
  header.scene = "../scene/small.scene.json";
  header.pose_hz = 90, header.gaze_hz = 90;
  SessionRecorder recorder(folder);
  recorder.write_header(header);
  const auto stamp = [](double t) { return TimeNs{1'000'000'000} + static_cast<TimeNs>(t * 1e9); };
  for (double t = 0; t <= kDuration_s; t += 1.0 / 90) {
    Pose pose;
    pose.position = {0, 1, 0};
    pose.orientation = glm::angleAxis(yaw_deg(t) * kRadians, glm::dvec3{0, 1, 0});
    recorder.add_pose({stamp(t), pose});
    const double angle = gaze_deg(t) * kRadians;
    const glm::dvec3 gaze{std::sin(angle), 0, -std::cos(angle)};
    recorder.add_gaze({stamp(t), {gaze, gaze}, {true, true}});
  }
  recorder.finish();
}

class StudyFramesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_turning_session(root() / "turning");
    write_small_session(root() / "short", 0.1);
    open("turning");
  }
  const fs::path& root() const { return folder_.path(); }

  void open(const char* session) {
    opened_ = std::make_unique<Opened>();
    opened_->options.scene = (root() / "scene/small.scene.json").string();
    opened_->options.profile = (root() / "small.profile.json").string();
    opened_->options.render = direct_light_settings();
    opened_->options.render.polar_width = opened_->options.render.polar_height = 16;
    opened_->options.render.threads = 1;
    opened_->report.name = session;
    opened_->report.session_folder = root() / session;
    open_session(opened_->options, opened_->report, opened_->session);
    step_ = std::make_unique<FrameStep>(opened_->options, opened_->report, opened_->session);
  }
  StudyFrames choose(int count, const SeenContrast& contrast = {}) {
    return choose_frames(*step_, opened_->report.range, count, contrast);
  }
  std::int64_t frames_there() const { return opened_->report.range.count; }

 private:
  struct Opened {
    ReplayOptions options;
    SessionReport report;
    OpenedSession session;
  };
  TemporaryFolder folder_;
  std::unique_ptr<Opened> opened_;
  std::unique_ptr<FrameStep> step_;
};

// Speed rises with time, so the parts by speed are thirds of the time. Of these the first has the middle of
// its gazes (0 to 20 degrees in a cosine: 10), the second the far end, the third the near one; 5/6 and 1/6 of
// a cosine's values lie beyond 10 +- 10 cos(30 degrees) = 18.7 and 1.3. Each third has 14 moments or so, so a
// rank lies off by 1/14 of the distribution: within 10 +- 10 cos(45 degrees), to be sure.
TEST_F(StudyFramesTest, SlowAndFastNearAndFarAllOccur) {
  const std::vector<StudyFrame> frames = choose(3).frames;
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t part = 0; part < 3; ++part) {
    EXPECT_GE(frames[part].time_s, kDuration_s * (double(part) / 3 - 0.03)) << part;
    EXPECT_LE(frames[part].time_s, kDuration_s * (double(part + 1) / 3 + 0.03)) << part;
    // 20 degrees/s^2; the recording and the display have frames of 1/90 and 1/60 s, within which a speed is
    // taken.
    EXPECT_NEAR(frames[part].head_deg_per_s, 20 * std::max(0.0, frames[part].time_s - kRest_s), 20 * 0.05);
    EXPECT_NEAR(frames[part].gaze_deg, gaze_deg(frames[part].time_s), 2);  // up to 82 degrees/s for 1/60 s
  }
  EXPECT_NEAR(frames[0].gaze_deg, 10, 7.1);
  EXPECT_GT(frames[1].gaze_deg, 17.1);
  EXPECT_LT(frames[2].gaze_deg, 2.9);
  EXPECT_LT(frames[0].head_deg_per_s, frames[1].head_deg_per_s);
  EXPECT_LT(frames[1].head_deg_per_s, frames[2].head_deg_per_s);
}

TEST_F(StudyFramesTest, TheClipIsWhereHeadAndGazeRest) {
  const std::vector<StudyFrame> clip = choose(3).clip;
  ASSERT_EQ(clip.size(), std::size_t{kClipFrames});
  for (std::size_t i = 0; i < clip.size(); ++i) {
    EXPECT_EQ(clip[i].number, clip[0].number + std::int64_t(i));
    EXPECT_LE(clip[i].time_s, kRest_s);
    EXPECT_NEAR(clip[i].gaze_deg, kRestingGaze_deg, 1e-6);
  }
}

TEST_F(StudyFramesTest, ChoosesTheSameAgain) {
  const StudyFrames one = choose(5);
  const StudyFrames other = choose(5);
  ASSERT_EQ(one.frames.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(one.frames[i].number, other.frames[i].number);
  EXPECT_EQ(one.clip.front().number, other.clip.front().number);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_LT(one.frames[i - 1].number, one.frames[i].number);
}

TEST_F(StudyFramesTest, TakesThoseInWhichThereIsMoreToSee) {
  // The session begins at 1 s: more than half of its 6 s.
  const auto late = [&](const FrameStep& step) { return step.sample().t_ns > 3'500'000'000 ? 1.0 : 0.0; };
  const StudyFrames chosen = choose(4, late);
  ASSERT_EQ(chosen.frames.size(), 4u);
  for (const StudyFrame& frame : chosen.frames) EXPECT_GT(frame.time_s, 2.5);
  EXPECT_GT(chosen.clip.front().time_s, 2.5);
}

TEST_F(StudyFramesTest, AShortSessionHasFewerFramesAndAClipOfWhatThereIs) {
  open("short");
  ASSERT_LT(frames_there(), kClipFrames);
  ASSERT_GT(frames_there(), 1);
  const StudyFrames chosen = choose(3);
  EXPECT_EQ(chosen.frames.size(), 1u);
  EXPECT_EQ(static_cast<std::int64_t>(chosen.clip.size()), frames_there());
}

}  // namespace
}  // namespace herr
