#include "sessions/import/presets/recording_folder.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

class RecordingFolder : public ::testing::Test {
 protected:
  RecordedFolder folder_;
};

TEST_F(RecordingFolder, OfEurocIsFoundFromAboveAndFromWithin) {
  for (const std::string name :
       {"mav0/state_groundtruth_estimate0/data.csv", "mav0/cam0/data.csv", "mav0/cam0/sensor.yaml",
        "mav0/cam0/data/1.png", "mav0/cam1/data.csv", "mav0/cam1/data/1.png"})
    folder_.write(name, "");
  for (const std::filesystem::path& given : {folder_.path(), folder_ / "mav0"}) {
    const FoundRecording found = find_recording(given, "");
    EXPECT_EQ(found.preset, "euroc");
    EXPECT_EQ(found.files.head, folder_ / "mav0/state_groundtruth_estimate0/data.csv");
    EXPECT_FALSE(found.files.gaze);
    ASSERT_EQ(found.cameras.size(), 2u);
    EXPECT_EQ(found.cameras[0].pictures, folder_ / "mav0/cam0/data");
    EXPECT_EQ(found.cameras[0].stamps, folder_ / "mav0/cam0/data.csv");
    EXPECT_EQ(found.cameras[0].calibration, folder_ / "mav0/cam0/sensor.yaml");
    EXPECT_EQ(found.cameras[1].pictures, folder_ / "mav0/cam1/data");
    EXPECT_TRUE(found.cameras[1].calibration.empty());
  }
}

TEST_F(RecordingFolder, NeedsNoCameraAndTakesTheOneThereIs) {
  folder_.write("mav0/mocap0/data.csv", "");
  EXPECT_TRUE(find_recording(folder_.path(), "euroc").cameras.empty());
  folder_.write("mav0/cam1/data.csv", "");
  EXPECT_TRUE(find_recording(folder_.path(), "euroc").cameras.empty()) << "stamps without pictures";
  folder_.write("mav0/cam1/data/1.png", "");
  ASSERT_EQ(find_recording(folder_.path(), "euroc").cameras.size(), 1u);
}

// The personal gaze is the general one corrected for the wearer.
TEST_F(RecordingFolder, OfAriaPrefersPersonalGaze) {
  folder_.write("mps_walk_vrs/slam/closed_loop_trajectory.csv", "");
  EXPECT_FALSE(find_recording(folder_.path(), "").files.gaze);
  folder_.write("mps_walk_vrs/eye_gaze/general_eye_gaze.csv", "");
  EXPECT_EQ(find_recording(folder_.path(), "").files.gaze,
            folder_ / "mps_walk_vrs/eye_gaze/general_eye_gaze.csv");
  folder_.write("mps_walk_vrs/eye_gaze/personalized_eye_gaze.csv", "");
  EXPECT_EQ(find_recording(folder_.path(), "").files.gaze,
            folder_ / "mps_walk_vrs/eye_gaze/personalized_eye_gaze.csv");
}

TEST_F(RecordingFolder, WithTwoRecordingsNamesBoth) {
  folder_.write("mps_b_vrs/slam/closed_loop_trajectory.csv", "");
  folder_.write("mps_a_vrs/slam/closed_loop_trajectory.csv", "");
  EXPECT_INPUT_ERROR(find_recording(folder_.path(), ""),
                     "holds several recordings: mps_a_vrs/slam/closed_loop_trajectory.csv and "
                     "mps_b_vrs/slam/closed_loop_trajectory.csv; name the file of one of them");
}

TEST_F(RecordingFolder, OfTwoFormatsAsksForThePreset) {
  folder_.write("headset_trajectory.csv", "");
  folder_.write("mps/slam/closed_loop_trajectory.csv", "");
  EXPECT_INPUT_ERROR(find_recording(folder_.path(), ""),
                     "mps/slam/closed_loop_trajectory.csv (aria-mps) and headset_trajectory.csv (hot3d); say "
                     "which one with --preset");
  EXPECT_EQ(find_recording(folder_.path(), "hot3d").files.head, folder_ / "headset_trajectory.csv");
}

TEST_F(RecordingFolder, WithoutAKnownFileSaysWhatSuchFoldersHold) {
  folder_.write("notes.txt", "");
  EXPECT_INPUT_ERROR(find_recording(folder_.path(), ""), "holds no recording of a known layout");
  EXPECT_INPUT_ERROR(find_recording(folder_.path(), ""), "mav0/state_groundtruth_estimate0/data.csv (euroc)");
  EXPECT_INPUT_ERROR(find_recording(folder_.path(), "hot3d"),
                     "holds no recording as preset hot3d knows it; such folders hold headset_trajectory.csv");
  EXPECT_INPUT_ERROR(find_recording(folder_.path(), "ros"), "preset ros reads single files");
}

TEST_F(RecordingFolder, ASessionNeedsNoConversion) {
  folder_.write("session.json", "{}");
  EXPECT_INPUT_ERROR(find_recording(folder_.path(), ""),
                     "is a session already, it has a session.json; replay it as it is: herr replay ");
}

}  // namespace
}  // namespace herr::test
