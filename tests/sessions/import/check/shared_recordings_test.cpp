// Recordings of other people, and small files of their kinds, each with what it is: how many of them
// `convert --check` names rightly. Skipped where the files are absent.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/check/proposal.h"
#include "sessions/import/presets/recording_folder.h"
#include "sessions/import/presets/trial_import.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr double kRightShare = 0.85;

const std::string kUnity =
    R"("world_axes": ["right", "up", "forward"], "head_axes": ["right", "up", "forward"]}]})";
std::string unity_map(const std::string& table) {
  return R"({"format_version": 1, "name": "unity", "head": [{)" + table +
         R"("time": {"column": "time", "unit": "s"}, "position": {"columns": ["pos_x", "pos_y", "pos_z"]},
         "orientation": {"euler_xyz": ["rot_x", "rot_y", "rot_z"], "unit": "deg", "order": "zxy"}, )" +
         kUnity;
}
const std::string kUnreal = R"({"format_version": 1, "name": "unreal", "head": [{"separator": "tab",
  "time": {"column": "Time", "unit": "s"}, "position": {"columns": ["HeadX", "HeadY", "HeadZ"], "unit": "cm"},
  "orientation": {"euler_xyz": ["Roll", "Pitch", "Yaw"], "unit": "deg", "order": "xyz", "sense": [-1, -1, 1]},
  "world_axes": ["forward", "right", "up"], "head_axes": ["forward", "right", "up"]}]})";

struct Known {
  std::string file, gaze;                    // below the folder of all
  std::string preset, variant;               // what it is
  std::string map;                           // no preset: what it is
  bool still_head = false, refused = false;  // refused: no conversion is right
};

std::vector<Known> cases() {
  return {{"aria-gen2/closed_loop_trajectory.csv", "aria-gen2/general_eye_gaze.csv", "aria-mps", "gen2", ""},
          {"clock-reset/head_movement.csv", "", "", "", unity_map("")},
          {"float32-unix-seconds/p.csv", "", "", "", "", false, true},
          {"gaze-out-of-order/head.csv", "gaze-out-of-order/gaze.csv", "", "", "any"},
          {"hl2-streamrecorder/log_head_hand_eye.csv", "", "hololens2", "", ""},
          {"hot3d-headset-trajectory/headset_trajectory.csv", "", "hot3d", "quest3", ""},
          {"negative-time/head_movement.csv", "", "", "", unity_map("")},
          {"neon-cloud-export/imu.csv", "neon-cloud-export/gaze.csv", "neon", "", ""},
          {"one-stamp-in-the-future/p.csv", "", "tum", "y-up", ""},
          {"quaternion-sign-flips/p.csv", "", "tum", "y-up", ""},
          {"quaternion-without-w/varjo_gaze_output.csv", "", "varjo-base", "", ""},
          {"quest-passthrough-capture/hmd_poses.csv", "", "quest-capture", "", ""},
          {"replica-traj/traj.txt", "", "replica", "y-up", ""},
          {"ros1-rostopic/pose.csv", "", "ros", "", ""},
          {"sranipal-trailing-comma-both/eye.txt", "", "vive-pro", "raw", ""},
          {"sranipal-x-negated/eye.txt", "", "vive-pro", "negated", ""},
          {"stray-scanner/odometry.csv", "", "stray-scanner", "", ""},
          {"tobii-xr-xml/gaze.xml", "", "tobii-xr", "quaternion", ""},
          {"tum-commas/t.txt", "", "tum", "y-up", ""},
          {"tum-double-space-nan/t.txt", "", "tum", "y-up", ""},
          {"tum-header-no-hash/t.txt", "", "tum", "y-up", ""},
          {"tum-tab-trailing/t.txt", "", "tum", "y-up", ""},
          {"tumvi-mocap/data.csv", "", "euroc", "tumvi", ""},
          {"unity-decimal-comma/head_movement.csv", "", "", "",
           unity_map(R"("separator": ";", "decimal": ",", )")},
          {"unreal-rotator/vr.tsv", "", "", "", kUnreal},
          {"varjo-base-no-head/varjo_gaze_output.csv", "", "varjo-base", "", ""},
          {"video360-wall-clock/v.csv", "", "video360", "", ""}};
}

std::vector<Known> recordings() {
  const std::string aria = "aria_mps_gen1/", eyes = "eyedentify3d/", quest = "quest_linked_tum/traj1_";
  const std::string walk = aria + "trajectory/closed_loop_trajectory.csv";
  std::vector<Known> all{{walk, "", "aria-mps", "gen1", ""},
                         {walk, aria + "eye_gaze/generalized_eye_gaze.csv", "aria-mps", "gen1", ""},
                         {walk, aria + "eye_gaze/eyegaze.csv", "aria-mps", "gen1", ""},
                         {walk, aria + "eye_gaze_vergence/generalized_gaze.csv", "aria-mps", "gen1", ""},
                         {"", aria + "eye_gaze_vergence/generalized_gaze.csv", "aria-mps", "gen1", "", true},
                         {eyes + "HTC_Vive_Pro/TESTNA01_360VR_Fist3.csv", "", "vive-pro", "raw", ""},
                         {eyes + "HTC_Vive_Pro/TESTNA05_360VR_Spread7.csv", "", "vive-pro", "raw", ""},
                         {eyes + "Pico_Neo_3_Pro/boxing_VR.csv", "", "pico-neo", "", ""},
                         {quest + "quest2_to_tool1_cut.txt", "", "tum", "y-up", ""},
                         {quest + "quest_pro_to_tool1_cut.txt", "", "tum", "y-up", ""},
                         {quest + "tool1_gt_cut.txt", "", "tum", "robot", ""},
                         {"euroc_gt/V1_01_easy.csv", "", "euroc", "euroc", ""}};
  for (const char* trial :
       {"kitchen_cube_13_S004_T002", "kitchen_fixed_9_S002_T002", "kitchen_object_10_S003_T011",
        "office_fixed_6_S004_T002", "office_fixed_7_S001_T001", "office_fixed_7_S001_T002",
        "office_laser_6_S001_T011", "office_object_8_S004_T011"}) {
    const std::string stem = std::string("jov2023_vive_pro_eye/") + trial;
    all.push_back({stem + "_head.csv", stem + "_gaze.csv", "jov2023", "", ""});
  }
  return all;
}

std::shared_ptr<const ColumnMap> parsed_map(const std::string& json) {
  if (json.empty()) return nullptr;
  return std::make_shared<const ColumnMap>(parse_column_map(json, "map.json"));
}

FormatRequest request_of(const fs::path& folder, const Known& known) {
  FormatRequest request;
  if (!known.file.empty()) request.files.head = folder / known.file;
  if (!known.gaze.empty()) request.files.gaze = folder / known.gaze;
  request.still.head = known.still_head;
  return request;
}

// All rows, as the options say.
TrialImport read_as(FormatRequest request, const std::string& preset, const std::string& variant,
                    const std::string& map, const StillParts& still) {
  request.preset = preset;
  request.variant = variant;
  request.map = parsed_map(map);
  request.still = still;
  if (still.head && !request.files.gaze) request.files = {{}, request.files.head};
  const ChosenFormat chosen = choose_format(request);
  return trial_import(import_request(request, chosen.format.columns), 0);
}

struct Score {
  int all = 0, right = 0, wrong = 0;
};

const char* certainty_word(Proposal::Certainty certainty) {
  return certainty == Proposal::Certainty::certain  ? "certain"
         : certainty == Proposal::Certainty::likely ? "likely"
                                                    : "cannot tell";
}

// Right: every stamp, pose and ray is that of the known reading.
void judge_one(const fs::path& folder, const Known& known, Score& score, std::ostream& table) {
  const FormatRequest request = request_of(folder, known);
  const Proposal proposal = propose_format(request);
  const bool told = proposal.certainty != Proposal::Certainty::cannot_tell;
  std::string verdict = "cannot tell";
  if (known.refused) verdict = told ? "WRONG" : "right";
  if (!known.refused && told) {
    const TrialImport got =
        read_as(request, proposal.preset, proposal.variant, proposal.map_json, proposal.still);
    const TrialImport expected =
        read_as(request, known.preset, known.variant, known.map, {known.still_head, false});
    const bool same = !got.error && !expected.error && got.rows_hash == expected.rows_hash;
    verdict = same ? "right" : "WRONG";
  }
  ++score.all;
  score.right += verdict == "right" ? 1 : 0;
  score.wrong += verdict == "WRONG" ? 1 : 0;
  const auto words = [](const std::string& preset, const std::string& variant, bool map) {
    return map ? std::string("a map") : preset + (variant.empty() ? "" : " " + variant);
  };
  table << std::left << std::setw(60) << (known.file.empty() ? known.gaze : known.file) << std::setw(20)
        << (known.refused ? "no conversion" : words(known.preset, known.variant, !known.map.empty()))
        << std::setw(20)
        << (told ? words(proposal.preset, proposal.variant, !proposal.map_json.empty()) : "-")
        << std::setw(13) << certainty_word(proposal.certainty) << verdict << "\n";
}

TEST(SharedRecordings, AreNamedRightlyOrLeftToTheUserAndNeverWrongly) {
  if (real_data().empty()) GTEST_SKIP() << "the real recordings are not here";
  Score score;
  std::ostringstream table;
  table << std::left << std::setw(60) << "recording" << std::setw(20) << "is" << std::setw(20) << "proposed"
        << std::setw(13) << "confidence"
        << "\n";
  for (const Known& known : recordings()) judge_one(real_data() / "sessions", known, score, table);
  const fs::path small = real_data().parent_path() / "cases" / "sessions";
  if (fs::is_directory(small))
    for (const Known& known : cases()) judge_one(small, known, score, table);
  std::cout << table.str() << score.right << " of " << score.all << " right, " << score.wrong << " wrong\n";
  EXPECT_EQ(score.wrong, 0);
  EXPECT_GE(score.right, kRightShare * score.all);
}

// What a conversion would warn of, in a recording that is good.
std::string warnings_of(const fs::path& folder, const Known& known) {
  FormatRequest request = request_of(folder, known);
  request.preset = known.preset;
  request.variant = known.variant;
  const ChosenFormat chosen = choose_format(request);
  PlausibilityMeter meter;
  if (known.still_head) meter.expect_still_head();
  const GazeColumns* gaze = chosen.format.columns.gaze;
  const bool per_eye = gaze != nullptr && gaze->rays.size() > 1;
  const ImportReport report = import_rows(
      import_request(request, chosen.format.columns),
      {[&](const PoseRow& row) { meter.add(row); }, [&](const GazeRow& row) { meter.add(row, per_eye); }});
  FindingList findings;
  meter.judge(request.files.head, request.files.gaze.value_or(request.files.head), findings);
  std::string text;
  for (const Finding& finding : findings.sorted())
    if (finding.severity == Severity::warning) text += finding.text() + "\n";
  for (const std::string& warning : report.warnings) text += warning + "\n";
  for (const std::string& remark : report.remarks) text += remark + "\n";
  return text;
}

TEST(SharedRecordings, RaiseNoneOfTheWarningsOfWrongAxesClocksAndDeadTrackers) {
  if (real_data().empty()) GTEST_SKIP() << "the real recordings are not here";
  for (const Known& known : recordings())
    // Left and right are exchanged in the gaze file with vergence: its rays meet behind the head, at the
    // distance that it calls depth. Beside the head, which its eyes counter, this is a note.
    if (!known.still_head) {
      EXPECT_EQ(warnings_of(real_data() / "sessions", known), "") << known.file << " " << known.gaze;
    }
}

}  // namespace
}  // namespace herr
