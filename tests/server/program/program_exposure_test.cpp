// How bright pictures are shown, by the program as its users run it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/paths.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class Exposed : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "walk", 0.1);
  }
  const fs::path& root() const { return folder_.path(); }
  Outcome replay(const std::string& flags) const {
    return run_program(root(),
                       with_more("replay walk --profile small.profile.json --preset direct --polar 128x64 "
                                 "--threads 2 --contact-sheet none ",
                                 flags));
  }
  nlohmann::json settings(const std::string& out) const {
    return nlohmann::json::parse(content_of(root() / out / "walk" / "summary.json"))["settings"];
  }
  std::string picture(const std::string& out) const {
    return content_of(root() / out / "walk/frames/frame_000002.left_context.png");
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Exposed, ASceneAndAFlagSayTheSame) {
  ASSERT_EQ(replay("--out plain").exit_code, 0);
  ASSERT_EQ(replay("--out zero --exposure 0").exit_code, 0);
  ASSERT_EQ(replay("--out flag --exposure -1.5").exit_code, 0);
  EXPECT_EQ(settings("flag")["exposure_ev"], -1.5);
  EXPECT_EQ(picture("zero"), picture("plain"));
  EXPECT_NE(picture("flag"), picture("plain"));
  std::string scene = content_of(root() / "scene/small.scene.json");
  scene.insert(1, R"("exposure_ev": -1.5, )");
  write_text(root() / "scene/small.scene.json", scene);
  ASSERT_EQ(replay("--out scene").exit_code, 0);
  EXPECT_EQ(picture("scene"), picture("flag"));
  EXPECT_EQ(settings("scene")["exposure_ev"], -1.5);
  // The flag wins.
  ASSERT_EQ(replay("--out wins --exposure 0").exit_code, 0);
  EXPECT_EQ(picture("wins"), picture("plain"));
}

TEST_F(Exposed, AutomaticIsOneNumberWhateverRangeIsDrawn) {
  ASSERT_EQ(replay("--out whole --auto-exposure").exit_code, 0);
  ASSERT_EQ(replay("--out part --auto-exposure --start 0.03").exit_code, 0);
  const double ev = settings("whole")["exposure_ev"].get<double>();
  EXPECT_EQ(settings("part")["exposure_ev"], ev);
  EXPECT_EQ(settings("whole")["auto_exposure"], true);
  EXPECT_EQ(picture("part"), picture("whole"));
  // The number alone gives the same pictures, and another number is another run to --resume.
  ASSERT_EQ(replay("--out number --exposure " + std::to_string(ev)).exit_code, 0);
  EXPECT_EQ(picture("number"), picture("whole"));
  ASSERT_EQ(replay("--out whole --auto-exposure --resume").exit_code, 0);
  const Outcome other = replay("--out number --exposure 3 --resume");
  EXPECT_NE((other.out + other.err).find("--exposure"), std::string::npos) << other.out << other.err;
}

TEST_F(Exposed, AThousandTimesTheLightIsTenStopsLess) {
  ASSERT_EQ(replay("--out usual --auto-exposure --no-camera").exit_code, 0);
  std::string scene = content_of(root() / "scene/small.scene.json");
  scene.replace(scene.find("[10, 10, 10]"), 12, "[10240, 10240, 10240]");
  scene.replace(scene.find("[0.2, 0.2, 0.2]"), 15, "[204.8, 204.8, 204.8]");
  write_text(root() / "scene/small.scene.json", scene);
  ASSERT_EQ(replay("--out bright --auto-exposure --no-camera").exit_code, 0);
  // 1024 = 2^10; the numbers are multiples of 1/100.
  EXPECT_NEAR(
      settings("usual")["exposure_ev"].get<double>() - settings("bright")["exposure_ev"].get<double>(), 10.0,
      0.015);
}

TEST_F(Exposed, MistakesAreOneLineEach) {
  for (const char* flags : {"--exposure 16", "--exposure x", "--exposure 1 --auto-exposure"}) {
    const Outcome outcome = replay(std::string("--out o ") + flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_EQ(lines_in(outcome.err), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("exposure"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(root() / "o"));
  }
  std::string scene = content_of(root() / "scene/small.scene.json");
  scene.insert(1, R"("exposure_ev": 1, "auto_exposure": true, )");
  write_text(root() / "scene/small.scene.json", scene);
  const Outcome outcome = replay("--out o");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("stands beside exposure_ev"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace herr
