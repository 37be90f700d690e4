// The file of --view: what it may leave out, what it means, and how each mistake is named.
#include "server/settings/view_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>

#include "sessions/files/input_error.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

class ViewFile : public ::testing::Test {
 protected:
  OutsideView load(const std::string& text) const {
    const std::filesystem::path file = folder_.path() / "a.view.json";
    std::ofstream(file) << text;
    return load_view_file(file, warnings_);
  }
  // The one line of a refusal, without the folder; empty when there was none.
  std::string complaint(const std::string& text) const {
    try {
      load(text);
      return {};
    } catch (const InputError& error) {
      const std::string line = error.what();
      return line.substr(line.find("a.view.json"));
    }
  }

 protected:
  mutable std::vector<std::string> warnings_;

 private:
  TemporaryFolder folder_;
};

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_LT(glm::distance(a, b), 1e-12) << a.x << ", " << a.y << ", " << a.z;
}

TEST_F(ViewFile, APlaceAndAPointToLookAtAreEnough) {
  const OutsideView view = load(R"({"position_m": [1, 2, 3], "look_at_m": [1, 2, -7]})");
  OutsideView expected;  // all else as it stands there; -Z is straight ahead
  expected.space_from_camera.position = {1, 2, 3};
  expect_near(view.space_from_camera.orientation * glm::dvec3(0, 0, -1), {0, 0, -1});
  expect_near(view.space_from_camera.orientation * glm::dvec3(0, 1, 0), {0, 1, 0});
  EXPECT_EQ(view_text(view), view_text(expected));
  EXPECT_EQ(view.name, "outside");
}

TEST_F(ViewFile, UpTurnsThePictureAboutTheDirectionOfView) {
  // From the right, looking along -X; +Z is up, so the camera's right is ahead x up = (-1,0,0) x (0,0,1) =
  // (0, 1, 0).
  const OutsideView view = load(R"({"position_m": [5, 0, 0], "look_at_m": [0, 0, 0], "up": [0, 0, 9]})");
  const glm::dquat& turn = view.space_from_camera.orientation;
  expect_near(turn * glm::dvec3(0, 0, -1), {-1, 0, 0});
  expect_near(turn * glm::dvec3(0, 1, 0), {0, 0, 1});
  expect_near(turn * glm::dvec3(1, 0, 0), {0, 1, 0});
}

TEST_F(ViewFile, EveryFieldIsTaken) {
  const OutsideView view = load(R"({"name": "gallery_2", "space": "session", "position_m": [0, 0, 0],
"orientation_xyzw": [0, 0.70710678, 0, 0.70710678], "fov_deg": 20.5, "width_px": 320, "height_px": 200, "samples": 3,
"see_through_colour": "00ff10", "overlay": false, "frusta_m": 2.5})");
  EXPECT_EQ(view.name, "gallery_2");
  EXPECT_EQ(view.space, OutsideSpace::session);
  // 90 degrees about +Y carries -Z to -X.
  expect_near(view.space_from_camera.orientation * glm::dvec3(0, 0, -1), {-1, 0, 0});
  EXPECT_EQ(view.fov_deg, 20.5);
  EXPECT_EQ(view.width_px, 320);
  EXPECT_EQ(view.height_px, 200);
  EXPECT_EQ(view.samples, 3);
  EXPECT_EQ(view.see_through, (ShownColour{0, 0xff, 0x10}));
  EXPECT_FALSE(view.overlay);
  EXPECT_EQ(view.frusta_m, 2.5);
}

TEST_F(ViewFile, AQuaternionThatLooksWFirstIsAWarning) {
  load(R"({"position_m": [0, 1, 5], "orientation_xyzw": [0, 0, 0, 1]})");
  EXPECT_TRUE(warnings_.empty());
  load("{\"position_m\": [0, 1, 5],\n\"orientation_xyzw\": [1, 0, 0, 0]}");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("a.view.json:2: field orientation_xyzw is [1, 0, 0, 0], which looks w-first; "
                              "here w is last: write [0, 0, 0, 1]"),
            std::string::npos)
      << warnings_[0];
}

TEST_F(ViewFile, EachMistakeIsNamedByItsField) {
  const std::string place = R"("position_m": [0, 1, 5], )", there = R"("look_at_m": [0, 0, 0])";
  const auto with = [&](const std::string& more) {
    return complaint("{" + place + there + ", " + more + "}");
  };
  EXPECT_NE(complaint("{" + there + "}").find("position_m"), std::string::npos);
  EXPECT_NE(complaint(R"({"position_m": [0, 1, 5]})").find("look_at_m"), std::string::npos);
  EXPECT_NE(with(R"("orientation_xyzw": [0, 0, 0, 1])").find("orientation_xyzw stands beside look_at_m"),
            std::string::npos);
  EXPECT_NE(complaint(R"({"position_m": [0, 1, 5], "orientation_xyzw": [0, 0, 0, 2]})")
                .find("not of unit length but 2;"),
            std::string::npos);
  EXPECT_NE(
      complaint(R"({"position_m": [0, 1, 5], "orientation_xyzw": [0, 0, 0, 1], "up": [0, 1, 0]})").find("up"),
      std::string::npos);
  EXPECT_NE(complaint(R"({"position_m": [1, 2, 3], "look_at_m": [1, 2, 3]})").find("look_at_m is position_m"),
            std::string::npos);
  EXPECT_NE(complaint(R"({"position_m": [0, 5, 0], "look_at_m": [0, 0, 0]})").find("which way is up"),
            std::string::npos)
      << "straight down, and up is +Y";
  EXPECT_NE(with(R"("up": [0, 0, 0])").find("which way is up"), std::string::npos);
  EXPECT_NE(with(R"("name": "Über")").find("name"), std::string::npos);
  EXPECT_NE(with(R"("name": "../x")").find("name"), std::string::npos);
  EXPECT_NE(with(R"("name": "")").find("name"), std::string::npos);
  EXPECT_NE(with(R"("space": "head")").find("scene or session"), std::string::npos);
  for (const char* fov : {"0", "180", "-50", "\"wide\"", "1e999"}) {
    EXPECT_NE(with(std::string(R"("fov_deg": )") + fov), "") << fov;
  }
  for (const char* key : {"width_px", "height_px", "samples"}) {
    for (const char* value : {"0", "-1", "8193", "1.5", "true"}) {
      EXPECT_NE(with('"' + std::string(key) + R"(": )" + value).find(key), std::string::npos) << value;
    }
  }
  EXPECT_NE(with(R"("width_px": 8192, "height_px": 8192, "samples": 2)").find("268435456 rays"),
            std::string::npos)
      << "8192^2 x 4";
  EXPECT_NE(with(R"("see_through_colour": "pink")").find("'pink' is no sRGB colour"), std::string::npos);
  EXPECT_NE(with(R"("overlay": 1)").find("overlay"), std::string::npos);
  EXPECT_NE(with(R"("frusta_m": 0)").find("frusta_m"), std::string::npos);
  EXPECT_NE(with(R"("fov_dg": 50)").find("fov_deg"), std::string::npos) << "the nearest name is told";
  EXPECT_NE(complaint("[]"), "");
  EXPECT_NE(complaint("{"), "");
  EXPECT_EQ(with(R"("fov_deg": 50)"), "");
}

TEST_F(ViewFile, AnythingThatChangesThePictureChangesItsText) {
  const std::string usual = R"({"position_m": [0, 1, 5], "look_at_m": [0, 0, 0])";
  const std::string text = view_text(load(usual + "}"));
  for (const char* more :
       {R"("name": "b")", R"("space": "session")", R"("up": [1, 1, 0])", R"("fov_deg": 51)",
        R"("width_px": 9)", R"("height_px": 9)", R"("samples": 1)", R"("see_through_colour": "ff8cc6")",
        R"("overlay": false)", R"("frusta_m": 1.5)"}) {
    EXPECT_NE(view_text(load(usual + ", " + more + "}")), text) << more;
  }
  EXPECT_NE(view_text(load(R"({"position_m": [0, 1, 6], "look_at_m": [0, 0, 0]})")), text);
  EXPECT_NE(view_text(load(R"({"position_m": [0, 1, 5], "look_at_m": [0, 0.1, 0]})")), text);
}

}  // namespace
}  // namespace herr
