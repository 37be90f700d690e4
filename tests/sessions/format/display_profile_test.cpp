#include "sessions/format/display_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

double tan_deg(double angle_deg) {
  return std::tan(glm::radians(angle_deg));
}

// Pixels per degree where the plane faces the eye: W / (tan right - tan left) * pi / 180.
double centre_density(const Viewport& viewport) {
  return viewport.width_px / (viewport.tan_right - viewport.tan_left) * glm::radians(1.0);
}

TEST(Xr1, HasTheNumbersOfThePaper) {
  const DisplayProfile profile = xr1_profile();
  EXPECT_EQ(profile.name, "xr1");
  EXPECT_EQ(profile.display_hz, 60);
  ASSERT_EQ(profile.viewports.size(), 4u);
  const char* names[] = {"left_context", "left_focus", "right_context", "right_focus"};
  for (std::size_t i = 0; i < 4; ++i) {
    const Viewport& viewport = profile.viewports[i];
    const bool focus = i % 2 == 1;
    EXPECT_EQ(viewport.name, names[i]);
    EXPECT_EQ(viewport.eye, i < 2 ? Eye::left : Eye::right);
    EXPECT_EQ(viewport.focus, focus);
    EXPECT_EQ(viewport.width_px, focus ? 2400 : 1980);
    EXPECT_EQ(viewport.height_px, focus ? 1350 : 1980);
    EXPECT_EQ(viewport.tan_right, tan_deg(focus ? 20 : 45));
    EXPECT_EQ(viewport.tan_left, -viewport.tan_right);
    EXPECT_EQ(viewport.tan_up, tan_deg(focus ? 11.57 : 45));
    EXPECT_EQ(viewport.tan_down, -viewport.tan_up);
  }
  // On average 1980 / 90 = 22 and 2400 / 40 = 60 pixels per degree. A plane is sparser at its centre:
  // 1980 / 2 * pi / 180 = 17.279, and 2400 / (2 * 0.363970) * pi / 180 = 57.543.
  EXPECT_NEAR(centre_density(profile.viewports[0]), 17.279, 0.0005);
  EXPECT_NEAR(centre_density(profile.viewports[1]), 57.543, 0.0005);
}

TEST(Xr1Half, HasTheSameFieldsAtHalfTheSize) {
  const DisplayProfile full = xr1_profile(), half = xr1_half_profile();
  ASSERT_EQ(half.viewports.size(), full.viewports.size());
  for (std::size_t i = 0; i < full.viewports.size(); ++i) {
    EXPECT_EQ(2 * half.viewports[i].width_px, full.viewports[i].width_px);
    EXPECT_EQ(2 * half.viewports[i].height_px, full.viewports[i].height_px);
    EXPECT_EQ(half.viewports[i].tan_up, full.viewports[i].tan_up);
    EXPECT_EQ(half.viewports[i].name, full.viewports[i].name);
  }
}

nlohmann::json one_viewport() {
  return nlohmann::json::parse(
      R"({"name": "mono", "display_hz": 90, "viewports": [{"name": "all", "eye": "left",
      "kind": "context", "width_px": 100, "height_px": 50, "left_deg": -50, "right_deg": 40, "down_deg": -30,
      "up_deg": 20, "edge_blend_deg": 2}]})");
}

DisplayProfile parse(const nlohmann::json& document) {
  return parse_display_profile(document, "p.json", "");
}

TEST(DisplayProfileFile, IsReadWithLopsidedFields) {
  const DisplayProfile profile = parse(one_viewport());
  EXPECT_EQ(profile.display_hz, 90);
  ASSERT_EQ(profile.viewports.size(), 1u);
  const Viewport& viewport = profile.viewports[0];
  EXPECT_EQ(viewport.tan_left, tan_deg(-50));
  EXPECT_EQ(viewport.tan_right, tan_deg(40));
  EXPECT_EQ(viewport.tan_down, tan_deg(-30));
  EXPECT_EQ(viewport.tan_up, tan_deg(20));
  EXPECT_EQ(viewport.edge_blend_deg, 2);
}

TEST(DisplayProfileFile, IsRefusedFieldByField) {
  const struct {
    const char* pointer;
    nlohmann::json value;
    const char* part;
  } cases[] = {
      {"/display_hz", 0.5, "field display_hz is 0.5"},
      {"/viewports", nlohmann::json::array(), "list 1 to 64 viewports"},
      {"/viewport", 1, "field viewport is not known; did you mean 'viewports'?"},
      {"/viewports/0/name", "Left Eye", "viewports[0].name is 'Left Eye'"},
      {"/viewports/0/name", "../x", "viewports[0].name"},
      {"/viewports/0/name", std::string(41, 'a'), "viewports[0].name"},
      {"/viewports/0/eye", "both", "write left or right"},
      {"/viewports/0/kind", "main", "write focus or context"},
      {"/viewports/0/width_px", 0, "width_px is 0"},
      {"/viewports/0/width_px", 16385, "width_px is 16385"},
      {"/viewports/0/left_deg", 90, "left_deg is 90"},
      {"/viewports/0/left_deg", 40, "right_deg is not right of left_deg"},
      {"/viewports/0/up_deg", -30, "up_deg is not above down_deg"},
  };
  for (const auto& [pointer, value, part] : cases) {
    nlohmann::json document = one_viewport();
    document[nlohmann::json::json_pointer(pointer)] = value;
    EXPECT_INPUT_ERROR(parse(document), part) << pointer;
  }
  nlohmann::json twice = one_viewport();
  twice["viewports"].push_back(twice["viewports"][0]);
  EXPECT_INPUT_ERROR(parse(twice), "'all' is used twice");
}

// 2 * 16384 * 16384 pixels are 2^29; the limit is 2^28.
TEST(DisplayProfileDocument, MorePixelsThanMemoryIsRefusedBeforeAnyIsAllocated) {
  nlohmann::json document = one_viewport();
  document["viewports"][0]["width_px"] = document["viewports"][0]["height_px"] = 16384;
  EXPECT_EQ(parse(document).viewports[0].width_px, 16384);
  document["viewports"].push_back(document["viewports"][0]);
  document["viewports"][1]["name"] = "other";
  EXPECT_INPUT_ERROR(parse(document), "536870912 pixels together");
}

TEST(DisplayProfileName, IsBuiltInOrAFile) {
  EXPECT_EQ(load_display_profile("xr1-half").viewports[0].width_px, 990);
  EXPECT_INPUT_ERROR(load_display_profile("xr2"), "use xr1, xr1-half");
  EXPECT_INPUT_ERROR(load_display_profile("/nowhere/p.json"), "cannot be opened");
  const test::RecordedFolder folder;
  folder.write("p.json", one_viewport().dump());
  EXPECT_EQ(load_display_profile((folder / "p.json").string()).name, "mono");
}

}  // namespace
}  // namespace herr
