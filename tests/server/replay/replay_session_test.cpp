// One session through the replay loop, in this process: what the program's own tests cannot bring about.
#include "server/replay/replay_session.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderer/settings_presets.h"
#include "server/process/stop_signal.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class ReplaySession : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "walk", 0.25);
    options_.out = root() / "o";
    options_.profile = (root() / "small.profile.json").string();
    options_.formats = {};
    options_.sheet = SheetChoice::none;
    options_.overwrite = true;
    options_.render = direct_light_settings();
    options_.render.polar_width = 64;
    options_.render.polar_height = 64;
    options_.render.threads = 1;
  }
  const fs::path& root() const { return folder_.path(); }
  SessionReport replay() const { return replay_session(root() / "walk", options_); }
  nlohmann::json summary() const {
    return nlohmann::json::parse(content_of(root() / "o" / "walk" / "summary.json"));
  }

  ReplayOptions options_;

 private:
  TemporaryFolder folder_;
};

TEST_F(ReplaySession, CountsTrianglesOnceAndNoCatchers) {
  ASSERT_EQ(replay().exit_code, 0);
  // One triangle; the floor's two are a catcher's.
  EXPECT_EQ(summary()["scene"]["triangles"], 1);
}

TEST_F(ReplaySession, TheSummarySaysHowTheProbesOfTheLastFrameFare) {
  options_.render.probes.on = true;
  const SessionReport report = replay();
  ASSERT_EQ(report.exit_code, 0) << report.error;
  const nlohmann::json probes = summary()["probes"];
  // 16 x 8 x 16 by default; every awake one is updated in each frame, by 64 rays in each of two sets.
  EXPECT_EQ(probes["active"].get<int>() + probes["inactive"].get<int>(), 2048);
  EXPECT_GT(probes["active"], 0);
  EXPECT_GE(probes["updated_per_frame"], probes["active"]);
  EXPECT_GT(probes["rays_per_frame"].get<std::int64_t>(), 64 * probes["active"].get<std::int64_t>());
  EXPECT_GE(probes["relocated"], 0);
  EXPECT_GT(probes["variability"], 0);
  EXPECT_LE(probes["variability"], 1);
}

// Grey, but for one NaN, one infinite and one negative value: three values that cannot be light.
void write_impossible_light(const fs::path& file) {
  OIIO::ImageSpec spec(64, 48, 3, OIIO::TypeDesc::FLOAT);
  spec["compression"] = std::string("zip");
  std::vector<float> values(64 * 48 * 3, 0.25f);
  values[0] = std::nanf("");
  values[100] = INFINITY;
  values[200] = -1.0f;
  const auto writer = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(writer && writer->open(file.string(), spec) &&
              writer->write_image(OIIO::TypeDesc::FLOAT, values.data()) && writer->close());
}

TEST_F(ReplaySession, ValuesOfTheCameraThatCannotBeLightAreCountedAndWarnedOf) {
  // Camera frames at 0, 0.1 and 0.2 s; the second one is shown for six frames and seen by both eyes.
  write_impossible_light(root() / "walk/cam0/data/000001.exr");
  std::string rows = content_of(root() / "walk/cam0/data.csv");
  rows.replace(rows.find("000001.png"), 10, "000001.exr");
  write_text(root() / "walk/cam0/data.csv", rows);
  const SessionReport report = replay();
  ASSERT_EQ(report.exit_code, 0) << report.error;
  EXPECT_EQ(summary()["session"]["sanitised_camera_values"], 3);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0].find("3 values of camera images"), 0u) << report.warnings[0];
}

TEST_F(ReplaySession, ACameraWithoutFaultsIsNotWarnedOf) {
  const SessionReport report = replay();
  EXPECT_EQ(summary()["session"]["sanitised_camera_values"], 0);
  EXPECT_TRUE(report.warnings.empty());
}

TEST_F(ReplaySession, ATargetOutOfReachEndsAtTheFloorAndIsWarnedOf) {
  options_.policy.deadline = true;
  options_.target_ms = 1e-3;  // no frame takes a microsecond
  options_.clock = ReplayClock::max;
  const SessionReport report = replay();
  ASSERT_EQ(report.exit_code, 0) << report.error;
  ASSERT_EQ(report.warnings.size(), 1u);
  const std::int64_t frames = report.statistics.frames;
  EXPECT_EQ(report.warnings[0].find(std::to_string(frames - 1) + " of " + std::to_string(frames) +
                                    " frames had the least quality allowed and still took longer than the "
                                    "target of 0.00 ms"),
            0u)
      << report.warnings[0];
  const nlohmann::json quality = summary()["quality"];
  EXPECT_EQ(quality["reasons"], nlohmann::json({{"start", 1}, {"floor_too_slow", frames - 1}}));
  EXPECT_EQ(quality["polar_width"]["max"], 8.0) << "an eighth of 64";
  EXPECT_EQ(quality["polar_height"]["max"], 16.0) << "a quarter of 64";
  EXPECT_EQ(report.statistics.floor_over_target, frames - 1);
  EXPECT_EQ(summary()["frames"]["over_target"], frames) << "whatever the display period is";
  EXPECT_EQ(summary()["settings"]["policy"], "deadline");
  EXPECT_FALSE(fs::exists(root() / "o/walk/checkpoint.json")) << "nobody could go on with it";
}

TEST_F(ReplaySession, ATargetThatIsEasilyReachedGivesTheWholeWidth) {
  options_.policy = {true, true};
  options_.target_ms = 10'000;
  options_.clock = ReplayClock::max;
  ASSERT_EQ(replay().exit_code, 0);
  EXPECT_EQ(summary()["frames"]["over_target"], 0);
  const nlohmann::json quality = summary()["quality"];
  EXPECT_EQ(quality["polar_width"]["min"], 8.0) << "the first frame, of which nothing is known";
  EXPECT_EQ(quality["polar_width"]["max"], 64.0);
  EXPECT_EQ(quality["polar_height"]["min"], 16.0);
  EXPECT_EQ(quality["polar_height"]["max"], 64.0);
  EXPECT_EQ(quality["reasons"]["grow_limited"], 4)
      << "8 x 16 samples, twice, 4, 8 and 16 times as many, then 64 x 64";
}

TEST_F(ReplaySession, TheHeaderOfAPictureTellsTheSettingsThatShapedIt) {
  options_.formats = PictureFormat::exr;
  options_.frames = 1;
  options_.render.isa = Isa::sse4;
  const auto header = [this] {
    EXPECT_EQ(replay().exit_code, 0);
    const auto file = OIIO::ImageInput::open((root() / "o/walk/frames/frame_000000.exr").string());
    return file ? std::string(file->spec().get_string_attribute("herr.settings")) : "no picture";
  };
  EXPECT_EQ(
      header(),
      "polar 128x64, light samples 1, occlusion rays 0, reflections, no probes, camera, isa sse4, profile "
      "small");
  options_.render.light_samples = 16;
  options_.render.adaptive_min_samples = 4;
  options_.render.seed = 7;
  options_.session.sampling = SamplingMode::interpolate;
  EXPECT_EQ(
      header(),
      "polar 128x64, light samples 16, occlusion rays 0, reflections, no probes, camera, first light samples "
      "4, seed 7, isa sse4, profile small, sampling interpolate");
}

TEST_F(ReplaySession, EachNameInTheSummaryHasItsFormulaThere) {
  ASSERT_EQ(replay().exit_code, 0);
  const nlohmann::json whole = summary();
  for (const char* part : {"pace", "feed"}) {
    for (const auto& [name, value] : whole[part].items()) {
      EXPECT_TRUE(name == "unit" || whole["definitions"].contains(name)) << part << "." << name;
    }
  }
  EXPECT_EQ(whole["feed"]["misregistration"]["count"], whole["frames"]["rendered"]);
  EXPECT_EQ(whole["quality"]["reasons"], nlohmann::json({{"fixed", whole["frames"]["rendered"]}}));
  EXPECT_EQ(whole["quality"]["polar_width"]["min"], 64.0);
  EXPECT_EQ(whole["quality"]["polar_height"]["min"], 64.0);
}

TEST_F(ReplaySession, BothFormatsInOneRunAreTheFilesOfTwoRuns) {
  const fs::path frames = root() / "o/walk/frames";
  options_.frames = 2;
  std::map<std::string, std::string> apart;
  std::int64_t bytes = 0;
  for (const PictureFormat format : {PictureFormat::png, PictureFormat::exr}) {
    options_.formats = format;
    const SessionReport report = replay();
    ASSERT_EQ(report.exit_code, 0) << report.error;
    bytes += report.bytes_written;
    for (const auto& file : fs::directory_iterator(frames))
      apart[file.path().filename().string()] = content_of(file.path());
  }
  options_.formats = {PictureFormat::png, PictureFormat::exr};
  const SessionReport both = replay();
  ASSERT_EQ(both.exit_code, 0) << both.error;
  EXPECT_EQ(both.files_written, 2 * (4 + 1));
  EXPECT_EQ(both.bytes_written, bytes);
  EXPECT_EQ(summary()["settings"]["format"], "png,exr");
  for (const auto& [name, content] : apart) EXPECT_TRUE(content_of(frames / name) == content) << name;

  // A frame is done when the files of both are there.
  fs::remove(frames / "frame_000001.exr");
  options_.overwrite = false;
  options_.resume = true;
  const SessionReport resumed = replay();
  EXPECT_EQ(resumed.exit_code, 0) << resumed.error;
  EXPECT_EQ(resumed.kept_frames, 1);
  EXPECT_EQ(resumed.files_written, both.files_written);
  EXPECT_EQ(resumed.bytes_written, both.bytes_written);
  EXPECT_EQ(resumed.statistics.clipped_pixels, both.statistics.clipped_pixels) << "by the rows of frames.csv";
  EXPECT_TRUE(content_of(frames / "frame_000001.exr") == apart.at("frame_000001.exr"));
}

// At +15 EV nearly all light is brighter than white, and EXR has it all the same.
TEST_F(ReplaySession, PixelsThatPngCannotShowAreCounted) {
  options_.formats = PictureFormat::exr;
  options_.frames = 2;
  options_.render.exposure_ev = 15;
  EXPECT_EQ(replay().statistics.clipped_pixels, 0) << "no PNG is written";
  options_.formats = {PictureFormat::png, PictureFormat::exr};
  const SessionReport report = replay();
  EXPECT_GT(report.statistics.clipped_pixels, 0);
  EXPECT_LE(report.statistics.clipped_pixels, report.statistics.counters.viewport_pixels);
  EXPECT_EQ(summary()["counters"]["clipped_pixels"], report.statistics.clipped_pixels);
}

// What each eye sees is written beside the viewports, timed by itself, and looked for by a resumed run.
TEST_F(ReplaySession, AFurtherViewIsAPictureOfItsFrame) {
  options_.formats = PictureFormat::png;
  options_.sheet = SheetChoice::all;
  options_.frames = 3;
  options_.render.blended_view = Blend::context;
  const SessionReport report = replay();
  ASSERT_EQ(report.exit_code, 0) << report.error;
  EXPECT_EQ(report.files_written, 3 * (4 + 2 + 1));
  EXPECT_EQ(report.statistics.views.count(), 3);
  const nlohmann::json views = summary()["further_views"];
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0], nlohmann::json({{"name", "blended-left"},
                                      {"width_px", 48},
                                      {"height_px", 40},
                                      {"kind", "blended"},
                                      {"eye", "left"}}));
  EXPECT_EQ(summary()["latency"]["views"]["count"], 3);

  const fs::path picture = root() / "o/walk/frames/frame_000001.blended-right.png";
  const std::string bytes = content_of(picture);
  fs::remove(picture);
  options_.overwrite = false;
  options_.resume = true;
  const SessionReport resumed = replay();
  EXPECT_EQ(resumed.exit_code, 0) << resumed.error;
  EXPECT_EQ(resumed.kept_frames, 1);
  EXPECT_NE(resumed.remark.find("blended-right.png"), std::string::npos) << resumed.remark;
  EXPECT_TRUE(content_of(picture) == bytes);
  EXPECT_EQ(resumed.statistics.views.count(), 3);

  options_.render.blended_view = Blend::off;
  const SessionReport other = replay();
  EXPECT_NE(other.exit_code, 0);
  EXPECT_NE(other.error.find("--blended-view was context, is off"), std::string::npos) << other.error;
}

TEST_F(ReplaySession, WithoutFurtherViewsThereIsNoneAndNoTimeOfOne) {
  options_.frames = 1;
  ASSERT_EQ(replay().exit_code, 0);
  EXPECT_EQ(summary()["further_views"], nlohmann::json::array());
  EXPECT_EQ(summary()["latency"]["views"]["count"], 0);
}

using ReplaySessionDeathTest = ReplaySession;

TEST_F(ReplaySessionDeathTest, ASignalBeforeTheFirstFrameLeavesEarlierResultsAlone) {
  // The signal stays for the rest of a process, so it is sent in a process of its own.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  write_text(root() / "o/walk/summary.json", "earlier");
  const auto interrupted = [&] {
    install_signal_handling();
    ::raise(SIGINT);
    const SessionReport report = replay();
    const bool kept = content_of(root() / "o/walk/summary.json") == "earlier";
    fs::remove_all(root());  // exit() does not end the fixture
    std::exit(kept && report.state == ReplayState::interrupted ? report.exit_code : 1);
  };
  EXPECT_EXIT(interrupted(), ::testing::ExitedWithCode(130), "");
}

}  // namespace
}  // namespace herr
