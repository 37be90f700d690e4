#include "sessions/format/display_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/paths.h"
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

// Published: 2064x2208 pixels for each eye, 110 by 96 degrees, 90 Hz. 2064 / (2 tan 55) * pi / 180 = 12.612
// pixels a degree in the middle across, 2208 / (2 tan 48) * pi / 180 = 17.349 down.
TEST(Quest3, HasTheNumbersThatItsMakerPublishes) {
  const DisplayProfile profile = quest3_profile();
  EXPECT_EQ(profile.name, "quest3");
  EXPECT_EQ(profile.display_hz, 90);
  ASSERT_EQ(profile.viewports.size(), 2u);
  for (const Viewport& viewport : profile.viewports) {
    EXPECT_FALSE(viewport.focus);
    EXPECT_EQ(viewport.width_px, 2064);
    EXPECT_EQ(viewport.height_px, 2208);
    EXPECT_NEAR(viewport.tan_right - viewport.tan_left, 2 * tan_deg(110.0 / 2), 1e-12);
    EXPECT_NEAR(viewport.tan_up - viewport.tan_down, 2 * tan_deg(96.0 / 2), 1e-12);
    EXPECT_NEAR(centre_density(viewport), 12.612, 0.0005);
  }
  EXPECT_EQ(profile.viewports[0].name, "left_context");
  EXPECT_EQ(profile.viewports[1].name, "right_context");
  EXPECT_EQ(profile.viewports[0].eye, Eye::left);
  EXPECT_EQ(profile.viewports[1].eye, Eye::right);
}

TEST(Generic90, IsRound) {
  const DisplayProfile profile = generic_90_profile();
  EXPECT_EQ(profile.name, "generic-90");
  EXPECT_EQ(profile.display_hz, 90);
  ASSERT_EQ(profile.viewports.size(), 2u);
  for (const Viewport& viewport : profile.viewports) {
    EXPECT_EQ(viewport.width_px, 2000);
    EXPECT_EQ(viewport.height_px, 2000);
    EXPECT_NEAR(viewport.tan_right, 1, 1e-12);
    EXPECT_NEAR(viewport.tan_down, -1, 1e-12);
  }
}

TEST(BuiltInProfiles, AreFoundByTheNamesOfTheOneList) {
  const std::string names = builtin_display_profile_names();
  EXPECT_EQ(names, "xr1, xr1-half, quest3, generic-90");
  for (const char* name : {"xr1", "xr1-half", "quest3", "generic-90"}) {
    const auto profile = builtin_display_profile(name);
    ASSERT_TRUE(profile) << name;
    EXPECT_EQ(profile->name, name);
  }
  EXPECT_FALSE(builtin_display_profile("xr1, xr1-half"));
}

// 0.3 * 1980 = 594, 0.3 * 1350 = 405; 0.1 * 1350 = 135; a pixel remains of any.
TEST(ScaledProfile, HasTheSameFieldsWithFewerPixels) {
  const DisplayProfile full = xr1_profile(), small = scaled_profile(full, 0.3);
  ASSERT_EQ(small.viewports.size(), 4u);
  EXPECT_EQ(small.viewports[0].width_px, 594);
  EXPECT_EQ(small.viewports[0].height_px, 594);
  EXPECT_EQ(small.viewports[1].width_px, 720);
  EXPECT_EQ(small.viewports[1].height_px, 405);
  EXPECT_EQ(scaled_profile(full, 0.1).viewports[1].height_px, 135);
  for (std::size_t i = 0; i < 4; ++i) {
    Viewport same = small.viewports[i];
    same.width_px = full.viewports[i].width_px, same.height_px = full.viewports[i].height_px;
    EXPECT_EQ(same, full.viewports[i]);
  }
  EXPECT_EQ(scaled_profile(full, 1), full);
  EXPECT_EQ(scaled_profile(full, 1e-6).viewports[1].width_px, 1);
  DisplayProfile half = scaled_profile(full, 0.5);
  half.name = "xr1-half";
  EXPECT_EQ(half, xr1_half_profile());
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

std::string readme_of_sessions() {
  std::ifstream file(test::source_dir() + "/sessions/README.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ReadmeOfSessions, ShowsABuiltInProfileAsAFileWouldHaveIt) {
  const std::string readme = readme_of_sessions(), fence = "```json\n";
  const std::size_t begin = readme.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t end = readme.find("```", begin + fence.size());
  ASSERT_NE(end, std::string::npos);
  const nlohmann::json shown =
      nlohmann::json::parse(readme.substr(begin + fence.size(), end - begin - fence.size()));
  const DisplayProfile profile = parse(shown);
  const auto built_in = builtin_display_profile(profile.name);
  ASSERT_TRUE(built_in) << profile.name;
  EXPECT_EQ(profile, *built_in);
  // Each key, and no other, in the table below it.
  const std::size_t table = readme.find("| key |", end);
  ASSERT_NE(table, std::string::npos);
  const std::string rows = readme.substr(table, readme.find("\n\n", table) - table);
  for (const auto& [key, value] : shown.items())
    EXPECT_NE(rows.find('`' + key + '`'), std::string::npos) << key;
  for (const auto& [key, value] : shown["viewports"][0].items()) {
    EXPECT_NE(rows.find('`' + key + '`'), std::string::npos) << key;
  }
}

TEST(DisplayProfileName, IsBuiltInOrAFile) {
  EXPECT_EQ(load_display_profile("xr1-half").viewports[0].width_px, 990);
  EXPECT_INPUT_ERROR(load_display_profile("xr2"), "use xr1, xr1-half, quest3, generic-90 or the path");
  EXPECT_INPUT_ERROR(load_display_profile("/nowhere/p.json"), "cannot be opened");
  const test::RecordedFolder folder;
  folder.write("p.json", one_viewport().dump());
  EXPECT_EQ(load_display_profile((folder / "p.json").string()).name, "mono");
}

}  // namespace
}  // namespace herr
