// Real recordings all the way through: converted with one command, inspected, replayed into pictures.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sessions/files/atomic_file.h"
#include "tests/paths.h"
#include "tests/recordings/real_data.h"
#include "tests/server/program/program_runner.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class Recordings : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::real_data().empty()) GTEST_SKIP() << "the real recordings are not here";
    // Two small viewports of the left eye: the whole way of a frame at a hundredth of its pixels.
    const std::string profile = R"({"name": "tiny", "display_hz": 60, "viewports": [
      {"name": "left_context", "eye": "left", "kind": "context", "width_px": 40, "height_px": 40,
       "left_deg": -45, "right_deg": 45, "down_deg": -45, "up_deg": 45},
      {"name": "left_focus", "eye": "left", "kind": "focus", "width_px": 48, "height_px": 28,
       "left_deg": -20, "right_deg": 20, "down_deg": -11.57, "up_deg": 11.57}]})";
    write_whole_file(root() / "tiny.json", profile);
  }
  const fs::path& root() const { return folder_.path(); }
  fs::path sessions() const { return test::real_data() / "sessions"; }

  Outcome herr(const std::string& arguments) const { return run_program(root(), arguments); }
  nlohmann::json herr_json(const std::string& arguments) const {
    const Outcome got = herr(arguments + " --json");
    EXPECT_EQ(got.exit_code, 0) << arguments << "\n" << got.err;
    return nlohmann::json::parse(got.out, nullptr, false);
  }
  std::string trial(const std::string& name) const {
    const std::string stem = (sessions() / "jov2023_vive_pro_eye" / name).string();
    return "'" + stem + "_head.csv' " + name + " --gaze '" + stem + "_gaze.csv' --preset jov2023";
  }
  // The scanned room with the bunny and the teapot on its table.
  std::string office_scene() const {
    const std::string line = "python3 '" + test::source_dir() + "/tests/recordings/make_office_scene.py' '" +
                             (test::real_data() / "models").string() + "' '" + (root() / "office").string() +
                             "' >/dev/null";
    EXPECT_EQ(std::system(line.c_str()), 0);
    return "office/office.scene.json";
  }
  TemporaryFolder folder_;
};

TEST_F(Recordings, AWalkInAScannedRoomIsReplayedWholeWithAPictureOfEveryViewportOfEveryFrame) {
  const std::string name = "office_fixed_6_S004_T002";
  const std::string feed = " --camera '" + (test::real_data() / "frames" / "rtabmap_samples").string() +
                           "' --camera-hz 15 --camera-loop --camera-hfov 66";
  ASSERT_EQ(herr("convert " + trial(name) + feed).exit_code, 0);
  const nlohmann::json run =
      herr_json("replay " + name + " --scene " + office_scene() +
                " --profile tiny.json --polar 128x96 --format png --contact-sheet none");
  const nlohmann::json& summary = run.at("sessions").at(0);
  // 21.78 s at 60 Hz, both ends shown.
  EXPECT_EQ(summary.at("frames").at("rendered"), 1307);
  EXPECT_EQ(lines_in(content_of(root() / "out" / name / "frames.csv")), 1 + 1307);
  EXPECT_EQ(files_below(root() / "out" / name / "frames").size(), 2u * 1307u);
  // The teapot mirrors and is seen; the room occludes and catches shadows; nothing went wrong on the way.
  EXPECT_GT(summary.at("counters").at("mirror_rays"), 10000);
  EXPECT_GT(summary.at("counters").at("catcher_shadow_rays"), 10000);
  EXPECT_EQ(summary.at("counters").at("nonfinite_values"), 0);
  EXPECT_EQ(summary.at("counters").at("invalid_rays"), 0);
}

TEST_F(Recordings, EveryTrialIsInspectedAndItsHitchesAndLostPupilsAreNamed) {
  struct Trial {
    const char* name;
    const char*
        longest_gap;  // of the poses: the largest difference of two stamps in the file; null: none stands out
  };
  for (const Trial& t :
       {Trial{"kitchen_cube_13_S004_T002", nullptr}, Trial{"kitchen_fixed_9_S002_T002", nullptr},
        Trial{"kitchen_object_10_S003_T011", nullptr}, Trial{"office_fixed_6_S004_T002", "47.8 ms"},
        Trial{"office_fixed_7_S001_T001", "333.4 ms"}, Trial{"office_fixed_7_S001_T002", "45.1 ms"},
        Trial{"office_laser_6_S001_T011", "44.1 ms"}, Trial{"office_object_8_S004_T011", "43.5 ms"}}) {
    ASSERT_EQ(herr("convert " + trial(t.name)).exit_code, 0) << t.name;
    const nlohmann::json report = herr_json("inspect " + std::string(t.name));
    EXPECT_TRUE(report.at("sound")) << t.name;
    std::string gap, lost;
    for (const nlohmann::json& finding : report.at("findings")) {
      const std::string problem = finding.at("problem");
      if (gap.empty() && problem.rfind("a gap of ", 0) == 0) gap = problem;
      if (problem.find("of the rows") != std::string::npos) lost += problem + "\n";
    }
    EXPECT_EQ(t.longest_gap == nullptr, gap.empty()) << t.name << ": " << gap;
    if (t.longest_gap) {
      EXPECT_NE(gap.find(t.longest_gap), std::string::npos) << t.name << ": " << gap;
    }
    EXPECT_NE(lost.find("have no gaze"), std::string::npos) << t.name;
    if (std::string(t.name) == "office_object_8_S004_T011") {
      // 84.2 % of its rows lack a pupil, that of the right eye mostly; a few more have no ray.
      EXPECT_NE(lost.find("one or both in 84.5 %"), std::string::npos) << lost;
    }
    const nlohmann::json run =
        herr_json("replay " + std::string(t.name) + " --scene '" + test::source_dir() +
                  "/scenes/samples/room.scene.json' --profile tiny.json --polar 64x32 --format none"
                  " --contact-sheet none --frames 120 --overwrite");
    EXPECT_EQ(run.at("total").at("frames").at("rendered"), 120) << t.name;
  }
}

TEST_F(Recordings, OneCommandImportsEachOtherKindOfRecording) {
  const std::string eyes = (sessions() / "eyedentify3d").string(),
                    aria = (sessions() / "aria_mps_gen1").string();
  const std::vector<std::pair<std::string, std::string>> imports{
      {"aria", "'" + aria + "/trajectory/closed_loop_trajectory.csv' aria --gaze '" + aria +
                   "/eye_gaze/generalized_eye_gaze.csv' --preset aria-mps"},
      {"quest", "'" + (sessions() / "quest_linked_tum/traj1_quest2_to_tool1_cut.txt").string() +
                    "' quest --preset tum"},
      {"euroc", "'" + (sessions() / "euroc_gt/V1_01_easy.csv").string() + "' euroc --preset euroc"},
      {"vive", "'" + eyes + "/HTC_Vive_Pro/TESTNA01_360VR_Fist3.csv' vive --preset vive-pro"},
      {"pico", "'" + eyes + "/Pico_Neo_3_Pro/boxing_VR.csv' pico --preset pico-neo"}};
  for (const auto& [name, arguments] : imports) {
    const Outcome made = herr("convert " + arguments);
    ASSERT_EQ(made.exit_code, 0) << name << ": " << made.err;
    EXPECT_EQ(herr("inspect " + name).exit_code, 0) << name;
    const nlohmann::json run = herr_json("replay " + name + " --scene '" + test::source_dir() +
                                         "/scenes/samples/room.scene.json' --profile tiny.json --polar 64x32"
                                         " --format none --contact-sheet none --frames 30");
    EXPECT_EQ(run.at("total").at("frames").at("rendered"), 30) << name;
  }
}

// Eight colour frames (20 a second) and four of each of two grey cameras (10 a second) of glasses lie in one
// folder, with stamps in their names, in microseconds, and in a table, in nanoseconds. There are no poses of
// them: a still head lasts as long.
TEST_F(Recordings, CamerasThatShareAFolderAreToldApart) {
  std::string still;
  for (int i = 0; i <= 50; ++i) still += "86." + std::to_string(300 + 10 * i) + " 0 1.6 0 0 0 0 1\n";
  write_whole_file(root() / "still.txt", still);
  const std::string frames = "'" + (test::real_data() / "frames" / "aria_aea").string() + "'";
  const nlohmann::json grey = herr_json("convert still.txt grey --preset tum --camera " + frames +
                                        " --camera-names '1201-1_{s}' --camera " + frames +
                                        " --camera-names '1201-2_{s}' --camera-hfov 110");
  ASSERT_EQ(grey.at("cameras").size(), 2u);
  for (const nlohmann::json& camera : grey.at("cameras")) EXPECT_EQ(camera.at("frames"), 4);
  const std::string rows =
      "timestamp_ns,filename\n86435295000,000000.jpg\n86535295000,000001.jpg\n"
      "86635295000,000002.jpg\n86735295000,000003.jpg\n";
  EXPECT_EQ(content_of(root() / "grey/cam0/data.csv"), rows);
  EXPECT_EQ(content_of(root() / "grey/cam1/data.csv"), rows);
  EXPECT_EQ(content_of(root() / "grey/cam1/data/000003.jpg"),
            content_of(test::real_data() / "frames/aria_aea/1201-2_86.735295.jpg"));
  // The lens of the colour camera by its calibration.
  const nlohmann::json colour =
      herr_json("convert still.txt colour --preset tum --camera " + frames + " --camera-names '214-1_{s}' " +
                "--camera-calibration " + frames + "/calib.json --camera-label camera-rgb");
  EXPECT_EQ(colour.at("cameras").at(0).at("frames"), 8);
  const std::string named = content_of(root() / "colour/cam0/data.csv");
  EXPECT_NE(named.find("86385246000,000000.jpg\n86435218000,000001.jpg\n"), std::string::npos) << named;
  // All pictures of the folder are those of several cameras: the sizes differ.
  EXPECT_EQ(herr("convert still.txt mixed --preset tum --camera " + frames + " --camera-hfov 66").exit_code,
            3);
  EXPECT_EQ(herr("inspect grey").exit_code, 0);
  EXPECT_EQ(herr("inspect colour").exit_code, 0);
}

// Warnings about axes, mirrored gaze, dead trackers and clocks: what `inspect` says of gaps, blinks and lost
// eyes is true of these recordings, and a file of the head alone has no gaze.
std::string warnings_in(const nlohmann::json& report) {
  std::string text;
  for (const nlohmann::json& finding : report.at("findings")) {
    const std::string problem = finding.at("problem");
    const bool known = problem.rfind("a gap of ", 0) == 0 ||
                       problem.find("of the rows have no gaze") != std::string::npos ||
                       problem.find("alone is lost in") != std::string::npos || problem == "does not exist";
    if (finding.at("severity") == "warning" && !known) text += problem + "\n";
  }
  return text;
}

TEST_F(Recordings, CheckNamesTheCommandThatMakesEachOfThemASessionWithoutWarnings) {
  const std::string eyes = (sessions() / "eyedentify3d").string(),
                    aria = (sessions() / "aria_mps_gen1").string();
  const std::string trial = (sessions() / "jov2023_vive_pro_eye/office_laser_6_S001_T011").string();
  const std::vector<std::string> recordings{"'" + trial + "_head.csv' --gaze '" + trial + "_gaze.csv'",
                                            "'" + aria + "/trajectory/closed_loop_trajectory.csv' --gaze '" +
                                                aria + "/eye_gaze/generalized_eye_gaze.csv'",
                                            "'" + aria + "'",
                                            "'" + (sessions() / "euroc_gt/V1_01_easy.csv").string() + "'",
                                            "'" + eyes + "/HTC_Vive_Pro/TESTNA01_360VR_Fist3.csv'",
                                            "'" + eyes + "/Pico_Neo_3_Pro/boxing_VR.csv'"};
  for (const std::string& recording : recordings) {
    std::string command = herr_json("convert --check " + recording).at("command");
    // "herr convert FILE OUT ...", as it is printed.
    const std::size_t out = command.find(" OUT");
    ASSERT_NE(out, std::string::npos) << recording;
    command.replace(out, 4, " made --overwrite");
    const Outcome made = herr(command.substr(5));
    EXPECT_EQ(made.exit_code, 0) << command << "\n" << made.err;
    EXPECT_EQ(warnings_in(herr_json("inspect made")), "") << command;
  }
}

TEST(MadeRecordings, OfEveryMotionAndGazeRaiseNoWarning) {
  const TemporaryFolder folder;
  for (const std::string motion : {"desk", "standing", "turning", "walking", "still"})
    for (const std::string gaze : {"fixations", "pursuit", "reading", "still", "jumping"}) {
      const std::string name = motion + "-" + gaze;
      ASSERT_EQ(run_program(folder.path(),
                            "synth " + name + " --duration 10 --motion " + motion + " --gaze " + gaze)
                    .exit_code,
                0)
          << name;
      const Outcome got = run_program(folder.path(), "inspect " + name + " --json");
      EXPECT_EQ(warnings_in(nlohmann::json::parse(got.out, nullptr, false)), "") << name;
    }
}

}  // namespace
}  // namespace herr
