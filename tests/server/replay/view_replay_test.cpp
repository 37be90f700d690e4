// A replay with --view: its file beside those of the viewports, which stay as they are, and what --resume
// makes of another view.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/replay/replay_session.h"
#include "sessions/files/input_error.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class ViewReplay : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "walk", 0.2);
    write_text(view_file(), R"({"name": "overview", "position_m": [0, 3, 4], "look_at_m": [0, 0, -1],
"width_px": 64, "height_px": 40, "samples": 1})");
    options_.profile = (root() / "small.profile.json").string();
    options_.render.polar_width = 64;
    options_.render.polar_height = 64;
    options_.render.threads = 2;
    options_.render.probes.on = true;
    options_.render.probes.rays = 8;
    options_.render.probes.density = 0.25;
    options_.render.occlusion_rays = 1;
    options_.policy.motion = true;
    options_.overwrite = true;
  }
  const fs::path& root() const { return folder_.path(); }
  fs::path view_file() const { return root() / "overview.view.json"; }
  SessionReport replay(const std::string& out) {
    options_.out = root() / out;
    return replay_session(root() / "walk", options_);
  }
  fs::path frames(const std::string& out) const { return root() / out / "walk" / "frames"; }

  ReplayOptions options_;

 private:
  TemporaryFolder folder_;
};

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".png") files.push_back(entry.path().lexically_relative(folder));
  }
  return files;
}

TEST_F(ViewReplay, WritesOnePictureMoreAndChangesNoOther) {
  options_.sheet = SheetChoice::none;
  ASSERT_EQ(replay("without").exit_code, 0);
  options_.view = view_file().string();
  const SessionReport report = replay("with");
  ASSERT_EQ(report.exit_code, 0) << report.error;
  const std::vector<fs::path> others = pictures_in(root() / "without");
  // Four viewports and one view for each of the dozen frames.
  const auto frame_count = static_cast<std::size_t>(report.statistics.frames);
  ASSERT_GE(frame_count, 10u);
  ASSERT_EQ(others.size(), 4 * frame_count);
  for (const fs::path& file : others) {
    EXPECT_EQ(content_of(root() / "with" / file), content_of(root() / "without" / file)) << file;
  }
  EXPECT_EQ(pictures_in(root() / "with").size(), 5 * frame_count);
  EXPECT_TRUE(fs::exists(frames("with") / "frame_000009.overview.png"));
  const auto summary = nlohmann::json::parse(content_of(root() / "with/walk/summary.json"));
  EXPECT_EQ(summary["settings"]["view"], "overview");
  ASSERT_EQ(summary["further_views"].size(), 1u);
  EXPECT_EQ(summary["further_views"][0]["kind"], "outside");
  EXPECT_EQ(report.statistics.views.count(), report.statistics.frames);
  EXPECT_EQ(report.statistics.outside.count(), report.statistics.frames);
  // Beside it only the pictures are set up.
  EXPECT_LE(report.statistics.outside.sum_ns(), report.statistics.views.sum_ns());
}

TEST_F(ViewReplay, AnotherViewStartsAnew) {
  options_.view = view_file().string();
  ASSERT_EQ(replay("o").exit_code, 0);
  options_.overwrite = false;
  options_.resume = true;
  EXPECT_TRUE(replay("o").nothing_to_do);
  // The same content under another name is the same view.
  fs::rename(view_file(), root() / "b.view.json");
  options_.view = (root() / "b.view.json").string();
  EXPECT_TRUE(replay("o").nothing_to_do);
  std::string text = content_of(root() / "b.view.json");
  text.replace(text.find("[0, 3, 4]"), 9, "[0, 3, 5]");
  write_text(root() / "b.view.json", text);
  const SessionReport report = replay("o");
  EXPECT_FALSE(report.nothing_to_do);
  EXPECT_NE((report.remark + report.error).find("the view has changed"), std::string::npos)
      << report.remark << report.error;
}

TEST_F(ViewReplay, AWrongFileEndsBeforeTheFirstFrame) {
  write_text(view_file(), R"({"position_m": [0, 3, 4], "look_at_m": [0, 0, -1], "fov_deg": 200})");
  options_.view = view_file().string();
  const SessionReport report = replay("o");
  EXPECT_EQ(report.exit_code, kExitBadInput);
  EXPECT_NE(report.error.find("overview.view.json:1: field fov_deg"), std::string::npos) << report.error;
  EXPECT_FALSE(fs::exists(root() / "o/walk/frames.csv"));
}

TEST_F(ViewReplay, ItsNameIsNoViewports) {
  write_text(view_file(), R"({"name": "left_focus", "position_m": [0, 3, 4], "look_at_m": [0, 0, -1]})");
  options_.view = view_file().string();
  const SessionReport report = replay("o");
  EXPECT_EQ(report.exit_code, kExitBadInput);
  EXPECT_NE(report.error.find("left_focus"), std::string::npos) << report.error;
}

}  // namespace
}  // namespace herr
