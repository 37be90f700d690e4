#include "sessions/format/session_header.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sessions/format/header_text.h"
#include "tests/paths.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::RecordedFolder;

// The complete example of sessions/format/README.md: what users copy must work.
nlohmann::json example() {
  std::ifstream file(std::filesystem::path(test::source_dir()) / "sessions" / "format" / "README.md");
  std::stringstream text;
  text << file.rdbuf();
  const std::string page = text.str(), fence = "```json\n";
  const std::size_t start = page.find(fence) + fence.size();
  return nlohmann::json::parse(page.substr(start, page.find("```", start) - start));
}

ParsedSessionHeader read(const nlohmann::json& document) {
  const RecordedFolder folder;
  folder.write("session.json", document.dump());
  return read_session_header(folder / "session.json");
}

TEST(SessionHeader, ReadsTheExampleOfTheReadme) {
  const auto [header, start_ns, end_ns, warnings] = read(example());
  EXPECT_EQ(header.name, "desk-walk");
  EXPECT_EQ(header.profile.name, "xr1");
  EXPECT_EQ(header.head_from_eye[0].position, glm::dvec3(-0.032, 0, 0));
  EXPECT_EQ(header.head_from_eye[1].position, glm::dvec3(0.032, 0, 0));
  EXPECT_TRUE(header.gaze_combined);
  EXPECT_EQ(header.vergence_m, 0.8);
  EXPECT_EQ(header.pose_hz, 90);
  EXPECT_EQ(header.scene, "../../scenes/general.scene.json");
  EXPECT_EQ(start_ns, 1'000'000'000);
  EXPECT_EQ(end_ns, 61'000'000'000);
  ASSERT_EQ(header.cameras.size(), 1u);
  EXPECT_EQ(header.cameras[0].model.kind, CameraModelKind::kb4);
  EXPECT_EQ(header.cameras[0].model.distortion[3], 0.0001);
  EXPECT_GT(header.cameras[0].model.max_angle_rad, 1);
  EXPECT_EQ(header.cameras[0].head_from_camera.position.y, 0.02);
  EXPECT_TRUE(warnings.empty());
}

TEST(SessionHeader, HasPlainDefaults) {
  const nlohmann::json least = nlohmann::json::parse(test::header_json());
  const SessionHeader header = read(least).header;
  EXPECT_EQ(header.head_from_eye[0].position.x, -0.0315);
  EXPECT_EQ(header.head_from_eye[1].position.x, 0.0315);
  EXPECT_FALSE(header.gaze_combined);
  EXPECT_FALSE(header.vergence_m);
  EXPECT_TRUE(header.cameras.empty());
}

TEST(SessionHeader, IsRefusedFieldByField) {
  const struct {
    const char* pointer;
    nlohmann::json value;
    const char* part;
  } cases[] = {
      {"/format_version", 2, "is 2, and this program reads version 1; use a newer herr"},
      {"/format_version", 0, "is 0, and this program reads version 1"},
      {"/format_version", "1", "not a whole number"},
      {"/gaze_knd", 1, "did you mean 'gaze_kind'?"},
      {"/name", 7, "field name is a number"},
      {"/display_profile", "xr3", "display_profile is 'xr3'"},
      {"/display_profile", "/etc/passwd", "display_profile is '/etc/passwd'"},
      {"/gaze_kind", "both", "write per_eye or combined"},
      {"/gaze_kind", "per_eye", "vergence_m is given for per_eye gaze"},
      {"/vergence_m", 0, "vergence_m is 0"},
      {"/eye_offsets/left", {0, 0}, "eye_offsets.left has 2 elements"},
      {"/eye_offsets/left", {64e9, 0, 0}, "eye_offsets.left[0] is 6.4e+10"},
      {"/rates_hz/pose", 1e6, "rates_hz.pose"},
      {"/start_ns", 1.5, "not a whole number"},
      {"/end_ns", 5, "end_ns lies before start_ns"},
      {"/scene", "/etc/scene.json", "absolute path"},
      {"/cameras/0/model", "kb5", "cameras[0].model is 'kb5'; did you mean 'kb4'?"},
      {"/cameras/0/width_px", 0, "cameras[0].width_px is 0"},
      {"/cameras/0/width_px", 4294967297, "cameras[0].width_px is 4294967297"},
      {"/cameras/0/fx", 0, "cameras[0].fx is 0"},
      {"/cameras/0/distortion", {1, 2, 3, 4, 5}, "cameras[0].distortion has 5 elements"},
      {"/cameras/0/distortion", {-999, 0, 0, 0}, "turns the image back"},
      {"/cameras/0/head_from_camera/orientation_xyzw", {0, 0, 0, 0}, "not of unit length but 0"},
      {"/cameras/0/head_from_camera/position", {0, 0, "0"}, "position[2] is a text"},
  };
  for (const auto& [pointer, value, part] : cases) {
    nlohmann::json document = example();
    document[nlohmann::json::json_pointer(pointer)] = value;
    EXPECT_INPUT_ERROR(read(document), part) << pointer;
  }
  nlohmann::json three = example();
  three["cameras"] = {three["cameras"][0], three["cameras"][0], three["cameras"][0]};
  EXPECT_INPUT_ERROR(read(three), "cameras has 3 elements");
}

TEST(SessionHeader, FeedDistanceAndConversionAreReadAsTheyAreWritten) {
  SessionHeader header = read(example()).header;
  EXPECT_FALSE(header.feed_distance_m);
  EXPECT_TRUE(header.conversion.empty());
  EXPECT_EQ(nlohmann::json::parse(header_text(header)).count("conversion"), 0u);
  header.feed_distance_m = 3.25;
  header.conversion.left_out = {{"pose", 40, 1200, "the stamp is far from its neighbours"},
                                {"cam1", 0, 7, ""}};
  header.conversion.assumed = {"camera stamps were not recorded: 15 pictures a second"};
  const auto [again, start_ns, end_ns, warnings] = read(nlohmann::json::parse(header_text(header)));
  EXPECT_EQ(again.feed_distance_m, 3.25);
  ASSERT_EQ(again.conversion.left_out.size(), 2u);
  EXPECT_EQ(again.conversion.left_out[0].stream, "pose");
  EXPECT_EQ(again.conversion.left_out[0].rows, 40);
  EXPECT_EQ(again.conversion.left_out[0].of, 1200);
  EXPECT_EQ(again.conversion.left_out[0].reason, "the stamp is far from its neighbours");
  EXPECT_EQ(again.conversion.left_out[1].stream, "cam1");
  EXPECT_EQ(again.conversion.assumed, header.conversion.assumed);
  EXPECT_TRUE(warnings.empty());
}

TEST(SessionHeader, RefusesFeedDistancesAndConversionsThatAreNone) {
  const nlohmann::json entry{{"stream", "pose"}, {"rows", 4}, {"of", 12}, {"reason", "lost"}};
  const auto with = [&](const char* key, const nlohmann::json& value) {
    nlohmann::json document = example();
    document[key] = value;
    return document;
  };
  const auto left_out = [&](const char* key, const nlohmann::json& value) {
    nlohmann::json changed = entry;
    changed[key] = value;
    return with("conversion", {{"left_out", {changed}}});
  };
  EXPECT_INPUT_ERROR(read(with("feed_distance_m", 0)), "feed_distance_m is 0");
  EXPECT_INPUT_ERROR(read(with("feed_distance_m", 1e10)), "feed_distance_m is 1e+10");
  EXPECT_INPUT_ERROR(read(with("conversion", {{"leftout", 1}})), "conversion.leftout");
  EXPECT_INPUT_ERROR(read(left_out("stream", "head")), "conversion.left_out[0].stream is 'head'");
  EXPECT_INPUT_ERROR(read(left_out("rows", 13)), "conversion.left_out[0].rows is 13");
  EXPECT_INPUT_ERROR(read(left_out("of", 0)), "conversion.left_out[0].of is 0");
  EXPECT_INPUT_ERROR(read(left_out("why", "x")), "conversion.left_out[0].why");
  EXPECT_INPUT_ERROR(read(left_out("reason", std::string(1001, 'x'))), "reason has 1001 bytes");
  EXPECT_INPUT_ERROR(read(with("conversion", {{"left_out", std::vector(65, entry)}})),
                     "conversion.left_out has 65 elements");
  EXPECT_INPUT_ERROR(read(with("conversion", {{"assumed", std::vector(65, std::string("x"))}})),
                     "conversion.assumed has 65 elements");
  EXPECT_INPUT_ERROR(read(with("conversion", {{"assumed", {1}}})),
                     "conversion.assumed holds what is no text");
  EXPECT_INPUT_ERROR(read(with("conversion", {{"assumed", "x"}})), "conversion.assumed is no list");
}

TEST(SessionHeader, WarnsOfSwappedEyesAndOfEyesMetresApart) {
  nlohmann::json document = example();
  document["eye_offsets"] = {{"left", {0.5, 0, 0}}, {"right", {-0.5, 0, 0}}};
  const std::vector<InputError> warnings = read(document).warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_PRED2(test::holds, warnings[0].what(), "are the eyes swapped?");
  EXPECT_PRED2(test::holds, warnings[1].what(), "1000 mm apart");
}

// 39.9 mm are less than 40; told as 40 they would not be.
TEST(SessionHeader, TellsAnEyeDistanceJustOutOfRangeWithAllItsDigits) {
  nlohmann::json document = example();
  document["eye_offsets"] = {{"left", {-0.0399, 0, 0}}, {"right", {0, 0, 0}}};
  const std::vector<InputError> warnings = read(document).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_PRED2(test::holds, warnings[0].what(), "are 39.9 mm apart; eyes are 40 to 85 mm apart");
}

// Offsets in millimetres look like those of a session that was scaled with its scene.
TEST(SessionHeader, WarnsOfOffsetsInMillimetres) {
  nlohmann::json document = example();
  document["eye_offsets"] = {{"left", {-32, 0, 0}}, {"right", {32, 0, 0}}};
  const ParsedSessionHeader parsed = read(document);
  EXPECT_EQ(parsed.header.head_from_eye[0].position.x, -32);
  ASSERT_EQ(parsed.warnings.size(), 1u);
  EXPECT_PRED2(test::holds, parsed.warnings[0].what(), "64000 mm apart");
}

}  // namespace
}  // namespace herr
