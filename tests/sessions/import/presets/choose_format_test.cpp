// Which preset and variant a recording is taken for, and when that is refused.
#include "sessions/import/presets/choose_format.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <string>

#include "sessions/text/fixed_text.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

class FormatChoice : public ::testing::Test {
 protected:
  // In EuRoC's layout, 100 Hz: turned about the file's z by `step_deg` a row.
  std::filesystem::path euroc(double step_deg) {
    std::string text = "#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z\n";
    for (int i = 0; i < 100; ++i) {
      const double half = glm::radians(step_deg * i / 2);
      text += std::to_string(1500000000000000000 + 10000000LL * i) + ",0,0,1.5," +
              fixed_text(std::cos(half), 9) + ",0,0," + fixed_text(std::sin(half), 9) + "\n";
    }
    folder_.write("data.csv", text);
    return folder_ / "data.csv";
  }
  ChosenFormat choose(const std::filesystem::path& head, const std::string& preset,
                      const std::string& variant = "") {
    return choose_format({head, {}}, preset, nullptr, variant, {});
  }
  RecordedFolder folder_;
};

// A body that turns about the file's z and stays level: TUM-VI's z points up. With EuRoC's body it would look
// straight up; with y up it would roll, by up to 50 degrees.
TEST_F(FormatChoice, TellsSiblingsByTheHorizon) {
  const ChosenFormat format = choose(euroc(0.5), "euroc");
  EXPECT_EQ(format.variant, "tumvi");
  ASSERT_EQ(format.remarks.size(), 2u);
  EXPECT_PRED2(holds, format.remarks[0],
               "variant tumvi was taken and not euroc: the head is upright in 100 % of");
}

// A body that never turns is level by TUM-VI's axes and by those with y up.
TEST_F(FormatChoice, RefusesWhatTheDataCannotTell) {
  EXPECT_INPUT_ERROR(
      choose(euroc(0), "euroc"),
      "fits several variants of 'euroc', and the data cannot tell which: euroc, tumvi, y-up; give "
      "--variant NAME");
  const ChosenFormat format = choose(euroc(0), "euroc", "y-up");
  EXPECT_EQ(format.variant, "y-up");
  EXPECT_EQ(format.columns.head->variant, "y-up");
  EXPECT_INPUT_ERROR(choose(euroc(0), "euroc", "z-up"), "its variants are: euroc, tumvi, y-up");
}

TEST_F(FormatChoice, KnowsAPresetByItsColumns) {
  folder_.write("log.csv",
                "timestamp, frame, x, y, z, qx, qy, qz, qw\n1.0, 0, 0, 1.4, 0, 1, 0, 0, 0\n1.1, 1, 0, 1.4, "
                "0, 1, 0, 0, 0\n");
  const ChosenFormat format = choose(folder_ / "log.csv", "");
  EXPECT_EQ(format.preset, "stray-scanner");
  ASSERT_FALSE(format.remarks.empty());
  EXPECT_EQ(format.remarks[0], "it is read as --preset stray-scanner");
}

// Seconds as nanoseconds would be 0.01 ns apart: EuRoC's layout is not meant, though it has as many columns.
TEST_F(FormatChoice, TakesNoUnitThatMakesStampsImpossible) {
  std::string text;
  for (int i = 0; i < 100; ++i) {
    const double half = glm::radians(0.25 * i);
    text += fixed_text(1700000000 + 0.01 * i, 2) + ",0,1.5,0,0," + fixed_text(std::sin(half), 9) + ",0," +
            fixed_text(std::cos(half), 9) + "\n";
  }
  folder_.write("t.txt", text);
  EXPECT_EQ(choose(folder_ / "t.txt", "").preset, "tum");
}

TEST_F(FormatChoice, NamesWhatIsMissing) {
  folder_.write("log.csv", "timestamp, frame, x, y, z, qx, qy, qz, q_w\n1.0, 0, 0, 1.4, 0, 1, 0, 0, 0\n");
  EXPECT_INPUT_ERROR(choose(folder_ / "log.csv", "stray-scanner"), "log.csv:1: has no column 'qw'");
  folder_.write("notes.txt", "Dear diary,\ntoday I wore a headset.\n");
  EXPECT_INPUT_ERROR(choose(folder_ / "notes.txt", ""), "notes.txt: fits none of the built-in formats");
}

}  // namespace
}  // namespace herr::test
