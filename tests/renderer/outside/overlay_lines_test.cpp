// Head, gaze and frusta as lines in space, and lines in space as lines of a picture.
#include "renderer/outside/overlay_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/outside/line_drawing.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

bool has_line(const std::vector<OverlayLine>& lines, const glm::dvec3& from, const glm::dvec3& to,
              const ShownColour& colour) {
  return std::any_of(lines.begin(), lines.end(), [&](const OverlayLine& line) {
    return glm::distance(line.from, from) < 1e-12 && glm::distance(line.to, to) < 1e-12 &&
           line.colour == colour;
  });
}

// Looks along -Z from (0, 0, 5): 200 x 100 pixels, +-45 degrees up and down, tangents of +-2 to the sides.
PictureCamera wide_camera() {
  OutsideView view;
  view.fov_deg = 90;
  view.width_px = 200;
  view.height_px = 100;
  Pose pose;
  pose.position = {0, 0, 5};
  return picture_camera(view, pose);
}

OverlayLine line_between(const glm::dvec3& from, const glm::dvec3& to) {
  return {from, to, kGazeColour, kThinLine};
}

TEST(OverlayLinesTest, GazeAndFrustaStartAtTheEyesAndEndWhereTheyLead) {
  OverlaySubject subject;
  subject.anchored_from_head.position = {1, 2, 3};
  // Turned by 90 degrees to the left: the head looks along -X, its right is -Z.
  subject.anchored_from_head.orientation = glm::angleAxis(glm::half_pi<double>(), glm::dvec3{0, 1, 0});
  for (const Eye eye : kEyes) {
    Pose head_from_eye;
    head_from_eye.position.x = eye == Eye::left ? -0.03 : 0.03;
    subject.eyes[static_cast<std::size_t>(eye)].anchored_from_eye =
        subject.anchored_from_head * head_from_eye;
  }
  subject.gaze_m = {4, 0.5};
  const DisplayProfile profile = test::single_view(10, 10, 45, 45);  // of the left eye
  subject.viewports = profile.viewports;
  subject.frusta_m = 2;
  std::vector<OverlayLine> lines;
  overlay_lines(subject, lines);

  // 12 edges of the head, 8 lines of one frustum, gaze and two dots of the one eye that has a viewport.
  EXPECT_EQ(lines.size(), 23u);
  EXPECT_LE(lines.size(), most_overlay_lines(1));
  // 0.03 m to the left of a head that looks along -X lies at z = 3.03.
  const glm::dvec3 eye{1, 2, 3.03};
  EXPECT_TRUE(has_line(lines, eye, {-3, 2, 3.03}, kGazeColour)) << "4 m ahead";
  EXPECT_TRUE(has_line(lines, {-3, 2, 3.03}, {-3, 2, 3.03}, kGazeColour)) << "a dot at its end";
  EXPECT_TRUE(has_line(lines, eye, eye, kHeadColour));
  // 45 degrees at 2 m: 2 m to each side. Lower left (z grows to the left), upper right.
  EXPECT_TRUE(has_line(lines, eye, {-1, 0, 5.03}, kContextColour));
  EXPECT_TRUE(has_line(lines, eye, {-1, 4, 1.03}, kContextColour));
  EXPECT_TRUE(has_line(lines, {-1, 0, 5.03}, {-1, 0, 1.03}, kContextColour)) << "the lower border";
}

TEST(LineDrawingTest, APointLandsWhereThePinholePutsIt) {
  // 2 m ahead, 1 m to the right and 0.5 m up: tangents 0.5 and 0.25, that is a quarter of the way from the
  // middle to the right border (100 px of half width) and to the upper one (50 px).
  const auto line = screen_line(wide_camera(), line_between({1, 0.5, 3}, {1, 0.5, 3}));
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->x0, 100 + 25, 1e-9);
  EXPECT_NEAR(line->y0, 50 - 12.5, 1e-9);
  EXPECT_EQ(line->x0, line->x1);
}

TEST(LineDrawingTest, LinesEndAtTheNearPlaneAndHideBehindIt) {
  EXPECT_FALSE(screen_line(wide_camera(), line_between({0, 0, 6}, {1, 0, 5})));
  // From 1 m behind the camera to 1 m ahead, 1 m to the right all along: cut at the near plane.
  const auto cut = screen_line(wide_camera(), line_between({1, 0, 6}, {1, 0, 4}));
  ASSERT_TRUE(cut);
  EXPECT_NEAR(cut->from.z, 5 - kOverlayNear_m, 1e-12);
  EXPECT_NEAR(cut->x0, 100 * (1 + 1 / kOverlayNear_m / 2), 1e-6);
  EXPECT_NEAR(cut->x1, 100 * (1 + 0.5), 1e-9);
}

TEST(LineDrawingTest, HalfWayInThePictureIsNearerInSpace) {
  // Depths 1 and 3: 1 / depth is linear in the picture, so half-way it is (1 + 1/3) / 2, depth 1.5, which is
  // a quarter of the way.
  const auto line = screen_line(wide_camera(), line_between({1, 0, 4}, {1, 0, 2}));
  ASSERT_TRUE(line);
  const LinePoint middle = nearest_point(*line, 0.5 * (line->x0 + line->x1), 50 + 7);
  EXPECT_NEAR(middle.distance_px, 7, 1e-9);
  EXPECT_NEAR(middle.place.z, 3.5, 1e-9);
  // Beyond an end the end is nearest.
  EXPECT_NEAR(nearest_point(*line, line->x0 + 30, line->y0 + 40).distance_px, 50, 1e-9);
}

TEST(ShownColourTest, ReadsBothFormsAndRefusesOthers) {
  EXPECT_EQ(shown_colour_from("ff8cc6"), kPink);
  EXPECT_EQ(shown_colour_from("FF8CC6"), kPink);
  EXPECT_EQ(shown_colour_from("255,140,198"), kPink);
  EXPECT_EQ(text_of(ShownColour{0, 10, 255}), "000aff");
  for (const char* wrong : {"", "pink", "#ff8cc6", "ff8cc", "ff8cc6a", "fg0000", "1,2", "1,2,3,4", "256,0,0",
                            "1, 2,3", "01,2,3", "0.5,0,0", "-1,0,0", ",,"}) {
    EXPECT_THROW(shown_colour_from(wrong), std::invalid_argument) << wrong;
  }
  // sRGB 188 is a linear 0.5029 (IEC 61966-2-1: ((188/255 + 0.055) / 1.055)^2.4), here of a white of 2.
  EXPECT_NEAR(radiance_of({188, 0, 255}, 2).x, 2 * 0.5029, 2e-4);
  EXPECT_EQ(radiance_of({188, 0, 255}, 2).z, 2.0f);
}

}  // namespace
}  // namespace herr
