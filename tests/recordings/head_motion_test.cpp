// Where the limits of the policy `motion` lie in other people's recordings: whoever looks at something has
// everything, a deliberate turn has less.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "server/quality/motion_policy.h"
#include "tests/recordings/head_stretches.h"
#include "tests/recordings/real_data.h"
#include "tests/server/program/program_runner.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

struct Speeds {
  std::vector<double> all, quiet, resting, turns;

  void add(const Speeds& other) {
    all.insert(all.end(), other.all.begin(), other.all.end());
    quiet.insert(quiet.end(), other.quiet.begin(), other.quiet.end());
    resting.insert(resting.end(), other.resting.begin(), other.resting.end());
    turns.insert(turns.end(), other.turns.begin(), other.turns.end());
  }
};

Speeds speeds_of(const fs::path& session) {
  const std::vector<test::HeadFrame> frames = test::head_frames(session);
  Speeds speeds;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    speeds.all.push_back(frames[i].deg_s);
    if (test::is_quiet(frames, i)) speeds.quiet.push_back(frames[i].deg_s);
    if (test::head_rests(frames, i)) speeds.resting.push_back(frames[i].deg_s);
    if (test::is_turn(frames, i)) speeds.turns.push_back(frames[i].deg_s);
  }
  return speeds;
}

double percentile(std::vector<double> values, double percent) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(percent / 100 * double(values.size() - 1)))];
}

// Of the frames those that have everything under `config`; 1 of none.
double full_share(const std::vector<double>& speeds, const MotionConfig& config = {}) {
  const auto full = std::count_if(speeds.begin(), speeds.end(),
                                  [&](double deg_s) { return motion_share(deg_s, config) == 0; });
  return speeds.empty() ? 1 : double(full) / double(speeds.size());
}

// For README and changelog: the figures that the limits were chosen by.
void print_row(const std::string& name, const Speeds& speeds) {
  const MotionConfig before{10, 100};
  std::printf("%-28s %6zu frames, full %5.1f %% (limits 10 ... 100: %5.1f %%)\n", name.c_str(),
              speeds.all.size(), 100 * full_share(speeds.all), 100 * full_share(speeds.all, before));
  const auto part = [&](const char* what, const std::vector<double>& values) {
    if (values.empty()) return;
    std::printf("    %-10s n = %5zu, full %5.1f %% (%5.1f %%), deg/s", what, values.size(),
                100 * full_share(values), 100 * full_share(values, before));
    for (const double p : {1., 5., 25., 50., 75., 95., 99.}) {
      std::printf("  p%.0f %.1f", p, percentile(values, p));
    }
    std::printf("\n");
  };
  part("quiet", speeds.quiet), part("rests", speeds.resting), part("turns", speeds.turns);
}

struct Recording {
  std::string name, arguments;  // of convert, below the sessions' folder
  bool people = true;           // with their gaze
};

std::vector<Recording> all_recordings(const fs::path& sessions) {
  const auto quoted = [&](const std::string& file) { return "'" + (sessions / file).string() + "'"; };
  std::vector<Recording> all;
  for (const fs::directory_entry& entry : fs::directory_iterator(sessions / "jov2023_vive_pro_eye")) {
    const std::string file = entry.path().filename().string(), end = "_head.csv";
    if (!file.ends_with(end)) continue;
    const std::string stem = file.substr(0, file.size() - end.size());
    const std::string folder = "jov2023_vive_pro_eye/";
    all.push_back({stem, quoted(folder + file) + " " + stem + " --preset jov2023 --gaze " +
                             quoted(folder + stem + "_gaze.csv")});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  const std::string eyes = "eyedentify3d/", aria = "aria_mps_gen1/", quest = "quest_linked_tum/";
  all.push_back({"vive-1", quoted(eyes + "HTC_Vive_Pro/TESTNA01_360VR_Fist3.csv") + " vive-1"});
  all.push_back({"vive-2", quoted(eyes + "HTC_Vive_Pro/TESTNA05_360VR_Spread7.csv") + " vive-2"});
  all.push_back({"pico", quoted(eyes + "Pico_Neo_3_Pro/boxing_VR.csv") + " pico --preset pico-neo"});
  all.push_back({"aria", quoted(aria + "trajectory/closed_loop_trajectory.csv") +
                             " aria --preset aria-mps --gaze " +
                             quoted(aria + "eye_gaze/generalized_eye_gaze.csv")});
  // A robot's arm moves the headset here, and this one flies: no gaze, and not the choice of a head.
  all.push_back({"quest2",
                 quoted(quest + "traj1_quest2_to_tool1_cut.txt") + " quest2 --still-gaze --preset tum",
                 false});
  all.push_back({"quest-pro",
                 quoted(quest + "traj1_quest_pro_to_tool1_cut.txt") + " quest-pro --still-gaze --preset tum",
                 false});
  all.push_back(
      {"robot", quoted(quest + "traj1_tool1_gt_cut.txt") + " robot --still-gaze --preset tum", false});
  all.push_back({"euroc", quoted("euroc_gt/V1_01_easy.csv") + " euroc --still-gaze --preset euroc", false});
  return all;
}

TEST(HeadMotion, WhoLooksAtSomethingHasEverythingAndATurnHasLess) {
  if (test::real_data().empty()) GTEST_SKIP() << "the real recordings are not here";
  TemporaryFolder folder;
  Speeds people;
  for (const Recording& recording : all_recordings(test::real_data() / "sessions")) {
    const Outcome made = run_program(folder.path(), "convert " + recording.arguments);
    ASSERT_EQ(made.exit_code, 0) << recording.name << ": " << made.err;
    Speeds speeds = speeds_of(folder.path() / recording.name);
    if (!recording.people) speeds.quiet.clear();
    print_row(recording.name, speeds);
    // Of each some stretches lie near a limit: no more than one frame in eight of them.
    EXPECT_GE(full_share(speeds.quiet), 0.875) << recording.name;
    EXPECT_LE(full_share(speeds.turns), 0.125) << recording.name;
    if (recording.people) people.add(speeds);
  }
  print_row("people, all", people);
  // As the README has it, counted by another program: the lower limit is the 99th percentile of quiet frames
  // and the 1st of turns, the upper one the median of turns, each to the next 5 degrees a second.
  const MotionConfig limits;
  EXPECT_NEAR(percentile(people.quiet, 99), limits.still_deg_s, 2.5);
  EXPECT_NEAR(percentile(people.turns, 1), limits.still_deg_s, 2.5);
  EXPECT_NEAR(percentile(people.turns, 50), limits.fast_deg_s, 2.5);
  EXPECT_GE(people.quiet.size(), 4000u);
  EXPECT_GE(people.turns.size(), 2000u);
  EXPECT_GE(full_share(people.quiet), 0.985);
  EXPECT_LE(full_share(people.turns), 0.015);
}

}  // namespace
}  // namespace herr
