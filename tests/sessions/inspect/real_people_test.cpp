// The recordings of people with a Vive Pro Eye (jov2023): as they are, and with faults made of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/sessions/inspect/made_person.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using namespace test;

const glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

// The columns named by `names` of each line, as numbers.
std::vector<std::vector<double>> columns(const std::filesystem::path& file,
                                         const std::vector<std::string>& names) {
  std::ifstream reader(file);
  std::string line;
  std::vector<std::size_t> places;
  std::vector<std::vector<double>> numbers;
  while (std::getline(reader, line)) {
    std::stringstream text(line);
    std::vector<std::string> fields;
    for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
    if (places.empty()) {
      for (const std::string& name : names)
        places.push_back(
            static_cast<std::size_t>(std::find(fields.begin(), fields.end(), name) - fields.begin()));
      continue;
    }
    std::vector<double>& row = numbers.emplace_back();
    for (const std::size_t place : places) row.push_back(std::stod(fields.at(place)));
  }
  return numbers;
}

// Unity: left-handed, z forward, degrees about z, then x, then y. Turned to ours by (x, y, -z), (-qx, -qy,
// qz, qw).
MadeRecording trial(const std::filesystem::path& folder, const std::string& name) {
  MadeRecording recording;
  recording.per_eye = false;
  for (const auto& row : columns(
           folder / (name + "_head.csv"),
           {"time", "head_pos_x", "head_pos_y", "head_pos_z", "head_rot_x", "head_rot_y", "head_rot_z"})) {
    const glm::dquat q = glm::angleAxis(glm::radians(row[5]), kY) * glm::angleAxis(glm::radians(row[4]), kX) *
                         glm::angleAxis(glm::radians(row[6]), kZ);
    const TimeNs stamp_ns = std::llround(row[0] * 1e9);
    if (!recording.poses.empty() && recording.poses.back().stamp_ns >= stamp_ns) continue;
    recording.poses.push_back({stamp_ns, {{row[1], row[2], -row[3]}, glm::dquat(q.w, -q.x, -q.y, q.z)}});
  }
  for (const auto& row :
       columns(folder / (name + "_gaze.csv"), {"time", "dir_x", "dir_y", "dir_z", "pupil_l", "pupil_r"})) {
    GazeRow gaze;
    gaze.stamp_ns = std::llround(row[0] * 1e9);
    const bool tracked = (row[4] > 0 || row[5] > 0) && !(row[1] == 0 && row[2] == 0);
    if (tracked) gaze.head_direction.fill(glm::normalize(glm::dvec3(row[1], row[2], -row[3])));
    gaze.valid = {tracked, tracked};
    recording.gaze.push_back(gaze);
  }
  return recording;
}

struct RealFault {
  const char* name;
  std::function<void(MadeRecording&)> make;
  const char* finding;
  // In at least so many of the eight trials. Of mirrored gaze a few short ones, and one with 84 % of the
  // pupils lost, hold too few turns of the head to be certain.
  int trials;
};

const std::vector<RealFault> kRealFaults{
    {"world's z is up", [](MadeRecording& r) { turn_world(r, rows(kX, kZ, -kY)); }, "the head ", 7},
    {"head's z is up", [](MadeRecording& r) { turn_head(r, rows(kX, kZ, -kY)); }, "the head looks", 8},
    {"head's x is up", [](MadeRecording& r) { turn_head(r, rows(-kY, kX, kZ)); }, "on its side", 8},
    {"upside down", [](MadeRecording& r) { turn_head(r, rows(-kX, -kY, kZ)); }, "upside down", 8},
    {"gaze's x mirrored", [](MadeRecording& r) { turn_gaze(r, rows(-kX, kY, kZ)); }, "the eyes turn with it",
     6},
    {"gaze's y mirrored", [](MadeRecording& r) { turn_gaze(r, rows(kX, -kY, kZ)); }, "the eyes turn with it",
     7},
    {"gaze's axes exchanged", [](MadeRecording& r) { turn_gaze(r, rows(kY, kX, kZ)); },
     "the eyes turn up or down", 8},
    {"gaze's z turned round", [](MadeRecording& r) { turn_gaze(r, rows(kX, kY, -kZ)); },
     "off the head's axis", 8},
    {"joined by lines", join_every_third_pose, "straight lines between samples", 8},
};

TEST(RealPeople, RaiseNothingAsTheyAreAndEveryFaultThatIsMadeOfThem) {
  const std::filesystem::path folder = real_data() / "sessions" / "jov2023_vive_pro_eye";
  if (real_data().empty()) GTEST_SKIP() << "the real recordings are not here";
  std::map<std::string, int> found;
  int trials = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with("_head.csv")) continue;
    const std::string name = file.substr(0, file.size() - 9);
    const MadeRecording good = trial(folder, name);
    ++trials;
    EXPECT_EQ(judged(good), "") << name;
    for (const RealFault& fault : kRealFaults) {
      MadeRecording bad = good;
      fault.make(bad);
      found[fault.name] += holds(judged(bad), fault.finding) ? 1 : 0;
    }
  }
  EXPECT_EQ(trials, 8);
  for (const RealFault& fault : kRealFaults) {
    std::cout << fault.name << ": found in " << found[fault.name] << " of " << trials << "\n";
    EXPECT_GE(found[fault.name], fault.trials) << fault.name;
  }
}

// Short recordings, as people cut them out for others: the sum of the evidence decides between readings of
// the gaze.
TEST(RealPeople, RaiseNothingInPiecesOfTwoHundredRows) {
  const std::filesystem::path folder = real_data() / "sessions" / "jov2023_vive_pro_eye";
  if (real_data().empty()) GTEST_SKIP() << "the real recordings are not here";
  constexpr std::size_t kRows = 200;
  for (const char* name :
       {"office_fixed_7_S001_T001", "kitchen_fixed_9_S002_T002", "office_laser_6_S001_T011"}) {
    const MadeRecording whole = trial(folder, name);
    for (std::size_t first = 0; first + kRows <= whole.poses.size(); first += kRows) {
      const TimeNs from_ns = whole.poses[first].stamp_ns, to_ns = whole.poses[first + kRows - 1].stamp_ns;
      MadeRecording piece;
      piece.per_eye = false;
      for (const PoseRow& row : whole.poses)
        if (row.stamp_ns >= from_ns && row.stamp_ns <= to_ns) piece.poses.push_back(row);
      for (const GazeRow& row : whole.gaze)
        if (row.stamp_ns >= from_ns && row.stamp_ns <= to_ns) piece.gaze.push_back(row);
      const std::string text = judged(piece, false);
      // Somebody who works at a low table looks straight down for two seconds: that is all that may be said.
      if (holds(text, "looks straight down")) continue;
      EXPECT_EQ(text, "") << name << " from row " << first;
    }
  }
}

}  // namespace
}  // namespace herr
