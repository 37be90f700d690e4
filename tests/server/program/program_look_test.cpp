// `herr look` as its users run it: known colours at known pixels, silhouettes, names of files, errors.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "server/process/exit_code.h"
#include "sessions/pictures/picture_reader.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

struct Picture {
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> rgba;
  std::vector<int> at(int x, int y) const {
    const std::uint8_t* p = &rgba[4 * static_cast<std::size_t>(y * width + x)];
    return {p[0], p[1], p[2], p[3]};
  }
};

Picture read(const fs::path& file) {
  const std::string bytes = content_of(file);
  PictureReader reader("png", bytes);
  EXPECT_EQ(reader.problem(), "") << file;
  Picture picture{reader.header().width_px, reader.header().height_px, reader.header().channels, {}};
  picture.rgba.resize(4 * static_cast<std::size_t>(picture.width * picture.height));
  EXPECT_TRUE(reader.read_rgba8(picture.rgba.data())) << file;
  return picture;
}

class Look : public ::testing::Test {
 protected:
  const fs::path& root() const { return folder_.path(); }
  Outcome look(const std::string& arguments) const { return run_program(root(), "look " + arguments); }
  // A ball that only glows, nothing else, in a world of radiance `around`: no light falls on anything.
  void write_ball(const std::string& name, double radius, const std::string& glow, double around) const {
    const std::string level = std::to_string(around), grey = level + ", " + level + ", " + level;
    write_text(root() / name,
               R"({"format_version": 1, "name": "ball", "shapes": [{"name": "ball",
"sphere": {"centre": [7, -3, 2], "radius": )" +
                   std::to_string(radius) +
                   R"(}, "material": {"base_colour": [0, 0, 0], "roughness": 1, "emission": )" + glow +
                   R"(}}], "environment": [)" + grey +
                   R"(], "lights": [{"centre": [0, 9, 0], "intensity_w_sr": [0, 0, 0]}]})");
  }

 private:
  TemporaryFolder folder_;
};

// Radiance 0.5 is sRGB 1.055 * 0.5^(1/2.4) - 0.055 = 0.7354, byte 188; 0.25 is 0.5371, byte 137; 1 is 255.
// One stop more doubles: 255, 188 and white.
TEST_F(Look, ShowsAKnownColourAtTheMiddleAndTheEnvironmentBehind) {
  write_ball("ball.scene.json", 0.5, "[0.5, 0.25, 1]", 0.25);
  const Outcome got = look("ball.scene.json --preset direct --size 96x64 --exposure 0");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  EXPECT_EQ(lines_in(got.out), 1) << got.out;
  EXPECT_EQ(got.out.find("ball.png: 96x64, from 30,15 at "), 0u) << got.out;
  EXPECT_NE(got.out.find("exposure +0.00 EV, its own light"), std::string::npos) << got.out;
  const Picture picture = read(root() / "ball.png");
  EXPECT_EQ(picture.channels, 3);
  EXPECT_EQ(picture.at(48, 32), (std::vector<int>{188, 137, 255, 255}));
  EXPECT_EQ(picture.at(1, 1), (std::vector<int>{137, 137, 137, 255}));
  ASSERT_EQ(look("ball.scene.json --preset direct --size 96x64 --exposure 1 --out bright.png").exit_code, 0);
  EXPECT_EQ(read(root() / "bright.png").at(48, 32), (std::vector<int>{255, 188, 255, 255}));
  ASSERT_EQ(
      look("ball.scene.json --preset direct --size 96x64 --exposure 0 --background none --out clear.png")
          .exit_code,
      0);
  const Picture clear = read(root() / "clear.png");
  EXPECT_EQ(clear.channels, 4);
  EXPECT_EQ(clear.at(48, 32), (std::vector<int>{188, 137, 255, 255}));
  EXPECT_EQ(clear.at(1, 1), (std::vector<int>{0, 0, 0, 0}));
}

// Automatic exposure brings the 95th percentile of the model's luminance to 0.8: the ball has one radiance,
// so its pixels show 0.8, byte 231 (1.055 * 0.8^(1/2.4) - 0.055 = 0.9063), however bright it is. A hundredth
// of a stop is less than a step.
TEST_F(Look, ExposesLightOfAnyStrengthByTheModelAlone) {
  for (const char* glow : {"[0.003, 0.003, 0.003]", "[700, 700, 700]"}) {
    write_ball("ball.scene.json", 0.5, glow, 0);
    ASSERT_EQ(look("ball.scene.json --size 64x64 --overwrite").exit_code, 0);
    EXPECT_NEAR(read(root() / "ball.png").at(32, 32)[0], 231, 1) << glow;
  }
}

// Blender's default lamp of 1000 W is 54351 cd in glTF. Square below it, 4 m away, a matte half grey without
// a highlight sends 54351 * 0.5 / (pi * 4^2) = 540.6. Exposed to 0.8: log2(0.8 / 540.6) = -9.40 EV, byte 231,
// neither white nor black; without the exposure it is white.
TEST_F(Look, ShowsWhatALampOfAThousandWattsLights) {
  const float corners[4][3] = {
      {-0.01f, -0.01f, -4}, {0.01f, -0.01f, -4}, {-0.01f, 0.01f, -4}, {0.01f, 0.01f, -4}};
  write_text(root() / "patch.bin", std::string(reinterpret_cast<const char*>(corners), sizeof corners));
  for (const char* lamp : {R"("type": "point")", R"("type": "spot", "spot": {"outerConeAngle": 0.5})"}) {
    write_text(root() / "patch.gltf",
               R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"mesh": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 5, "material": 0}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0},
  "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
  "min": [-0.01, -0.01, -4], "max": [0.01, 0.01, -4]}],
"bufferViews": [{"buffer": 0, "byteLength": 48}], "buffers": [{"byteLength": 48, "uri": "patch.bin"}],
"extensionsUsed": ["KHR_lights_punctual", "KHR_materials_specular"],
"extensions": {"KHR_lights_punctual": {"lights": [{"intensity": 54351.4, )" +
                   std::string(lamp) + "}]}}}");
    const Outcome got = look("patch.gltf --size 32x32 --json --overwrite");
    ASSERT_EQ(got.exit_code, 0) << got.err;
    EXPECT_NEAR(nlohmann::json::parse(got.out).at("exposure_ev").get<double>(), -9.40, 0.015) << lamp;
    EXPECT_NEAR(read(root() / "patch.png").at(16, 16)[1], 231, 1) << lamp;
    ASSERT_EQ(look("patch.gltf --size 32x32 --exposure 0 --overwrite").exit_code, 0);
    EXPECT_EQ(read(root() / "patch.png").at(16, 16)[1], 255) << lamp;
  }
}

// The silhouette's radius is 0.95 of half the shorter side, 0.95 * 40 = 38 pixels: alpha along the middle
// rows sums up to 76 pixels, and along the middle columns. Sixteen rays a pixel count each border to 1/8.
TEST_F(Look, FitsABallToThePictureAtAnyScale) {
  for (const double radius : {0.001, 0.5, 1000.0}) {
    write_ball("ball.scene.json", radius, "[1, 1, 1]", 0);
    ASSERT_EQ(look("ball.scene.json --size 120x80 --samples 16 --background none --overwrite").exit_code, 0);
    const Picture picture = read(root() / "ball.png");
    double across = 0, down = 0;
    for (int x = 0; x < 120; ++x) across += 0.5 * (picture.at(x, 39)[3] + picture.at(x, 40)[3]) / 255.0;
    for (int y = 0; y < 80; ++y) down += 0.5 * (picture.at(59, y)[3] + picture.at(60, y)[3]) / 255.0;
    EXPECT_NEAR(across, 76, 1) << radius;
    EXPECT_NEAR(down, 76, 1) << radius;
  }
}

TEST_F(Look, IsTheSameForAnyNumberOfThreadsAndInEveryRun) {
  write_small_scene(root());
  ASSERT_EQ(look("triangle.gltf --out a.png --size 100x70 --threads 1").exit_code, 0);
  ASSERT_EQ(look("triangle.gltf --out b.png --size 100x70 --threads 2").exit_code, 0);
  EXPECT_EQ(content_of(root() / "a.png"), content_of(root() / "b.png"));
  ASSERT_EQ(look("small.scene.json --out c.exr --size 100x70 --threads 1").exit_code, 0);
  ASSERT_EQ(look("small.scene.json --out d.exr --size 100x70 --threads 2").exit_code, 0);
  EXPECT_EQ(content_of(root() / "c.exr"), content_of(root() / "d.exr"));
}

TEST_F(Look, WritesOverNothingUnlessItIsAskedTo) {
  write_small_scene(root());
  write_text(root() / "triangle.png", "mine");
  const Outcome got = look("triangle.gltf --size 16x16");
  EXPECT_EQ(got.exit_code, kExitUsage);
  EXPECT_EQ(
      got.err,
      "herr: --out: 'triangle.png' is there already; give --overwrite to replace it, or another --out\n");
  EXPECT_EQ(content_of(root() / "triangle.png"), "mine");
  EXPECT_EQ(look("triangle.gltf --size 16x16 --overwrite").exit_code, 0);
  EXPECT_EQ(read(root() / "triangle.png").width, 16);
  EXPECT_EQ(look("triangle.gltf --out triangle.jpg").exit_code, kExitUsage);
}

TEST_F(Look, SaysInOneLineWhatItCannotLookAtAndLeavesNothing) {
  write_small_scene(root() / "scene");
  write_small_session(root() / "session", 0.1);
  write_text(root() / "bad.gltf", "{");
  write_text(root() / "empty.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})");
  const struct {
    const char* arguments;
    int exit_code;
    const char* part;
  } kCases[] = {{"session", kExitUsage, "is a session; use `herr replay`"},
                {"session/session.json", kExitUsage, "is a session; use `herr replay`"},
                {"scene", kExitUsage, "is a folder"},
                {"none.glb", kExitBadInput, "none.glb"},
                {"bad.gltf", kExitBadInput, "bad.gltf"},
                {"empty.gltf", kExitBadInput, "has nothing to look at"},
                {"scene/triangle.gltf --from 30", kExitUsage, "write AZIMUTH,ELEVATION"},
                {"scene/triangle.gltf --from 0,91", kExitUsage, "--from"},
                {"scene/triangle.gltf --from frnt", kExitUsage, "front"},
                {"scene/triangle.gltf --environment none.hdr", kExitBadInput, "none.hdr"},
                {"scene/triangle.gltf --turntable 4 --out t.png", kExitUsage, "it is a folder"},
                {"scene/triangle.gltf --out . --format png", kExitUsage, "--out: '.' is a folder"},
                {"scene/triangle.gltf --out .. --format exr", kExitUsage, "--out: '..' is a folder"},
                {"scene/triangle.gltf --out new/.. --format png", kExitUsage, "--out: 'new/..' is a folder"},
                {"scene/triangle.gltf --out new/ --format png", kExitUsage, "--out: 'new/' is a folder"},
                {"scene/triangle.gltf --out scene --format png", kExitUsage, "--out: 'scene' is a folder"},
                {"scene/triangle.gltf --out scene/ --format png", kExitUsage, "give the name of a file"}};
  const std::vector<std::string> before = files_below(root());
  for (const auto& [arguments, exit_code, part] : kCases) {
    const Outcome got = look(std::string(arguments) + " --size 16x16");
    EXPECT_EQ(got.exit_code, exit_code) << arguments << ": " << got.err;
    EXPECT_NE(got.err.find(part), std::string::npos) << arguments << ": " << got.err;
    EXPECT_EQ(got.err.find("herr: "), 0u) << arguments;
    EXPECT_EQ(got.out, "") << arguments;
  }
  std::vector<std::string> after = files_below(root());
  std::erase_if(after, [](const std::string& name) { return name == "stdout.txt" || name == "stderr.txt"; });
  EXPECT_EQ(after, before);
}

// Two cubes' worth of sides: a quarter turn of the camera about a model with four equal sides changes
// nothing, so the studio's light must turn with it.
TEST_F(Look, TurnsAModelInItsLightOnATurntable) {
  write_text(root() / "post.scene.json", R"({"format_version": 1, "name": "post", "shapes": [{"name": "post",
"box": {"min": [-1, -2, -1], "max": [1, 2, 1]}, "material": {"base_colour": [0.5, 0.5, 0.5]}}]})");
  const Outcome got = look("post.scene.json --turntable 4 --size 48x48 --out around --json");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  const auto json = nlohmann::json::parse(got.out);
  EXPECT_EQ(json.at("pictures"), 4);
  EXPECT_EQ(json.at("light"), "studio light");
  EXPECT_EQ(files_below(root() / "around"),
            (std::vector<std::string>{"post-000.png", "post-001.png", "post-002.png", "post-003.png"}));
  const Picture first = read(root() / "around/post-000.png");
  for (const char* name : {"around/post-001.png", "around/post-002.png", "around/post-003.png"}) {
    const Picture other = read(root() / name);
    int differing = 0;
    for (std::size_t i = 0; i < first.rgba.size(); ++i)
      differing += std::abs(int{first.rgba[i]} - int{other.rgba[i]}) > 2 ? 1 : 0;
    EXPECT_LT(differing, 4 * 48) << name << ": rays of edges fall anew, the faces are the same";
  }
  EXPECT_EQ(look("post.scene.json --turntable 4 --size 16x16 --out around").exit_code, kExitUsage);
  EXPECT_EQ(look("post.scene.json --turntable 3 --size 16x16 --out around --overwrite").exit_code, 0);
  EXPECT_EQ(files_below(root() / "around").size(), 3u);
  write_text(root() / "around/mine.txt", "mine");
  EXPECT_EQ(look("post.scene.json --turntable 4 --size 16x16 --out around --overwrite").exit_code,
            kExitUsage);
  EXPECT_EQ(content_of(root() / "around/mine.txt"), "mine");
}

// One ray goes through the middle of its pixel: whatever the seed, the picture is the same.
TEST_F(Look, SendsASingleRayThroughTheMiddleOfAPixel) {
  write_ball("ball.scene.json", 0.5, "[0.5, 0.25, 1]", 0.25);
  std::string first;
  for (const char* seed : {"1", "2"}) {
    ASSERT_EQ(
        look(std::string("ball.scene.json --size 48x48 --overwrite --samples 1 --exposure 0 --seed ") + seed)
            .exit_code,
        0);
    const std::string bytes = content_of(root() / "ball.png");
    EXPECT_TRUE(first.empty() || bytes == first) << "seed " << seed;
    first = bytes;
  }
}

// Auto brightens the ball of 1 / 64, the document's own exposure of 0 leaves it.
TEST_F(Look, MetersWhereItIsAskedToWhateverTheDocumentSays) {
  write_ball("ball.scene.json", 0.5, "[0.015625, 0.015625, 0.015625]", 0);
  std::string text = content_of(root() / "ball.scene.json");
  write_text(root() / "ball.scene.json", text.insert(1, R"("exposure_ev": 0, )"));
  const Outcome own = look("ball.scene.json --size 48x48 --overwrite");
  EXPECT_NE(own.out.find("exposure +0.00 EV"), std::string::npos) << own.out;
  const Outcome metered = look("ball.scene.json --size 48x48 --overwrite --exposure auto");
  EXPECT_EQ(metered.exit_code, 0) << metered.err;
  EXPECT_EQ(metered.out.find("exposure +0.00 EV"), std::string::npos) << metered.out;
}

TEST_F(Look, LeavesADocumentTheLightThatItHas) {
  const std::string shape = R"({"format_version": 1, "name": "ball", "shapes": [{"name": "ball",
"sphere": {"centre": [0, 0, 0], "radius": 1}, "material": {"base_colour": [0.5, 0.5, 0.5])";
  const std::pair<std::string, std::string> lit[] = {
      {R"(}}], "environment": [0.5, 0.5, 0.5]})", "its own light"},
      {R"(, "emission": [1, 1, 1]}}]})", "its own light"},
      {R"(}}]})", "studio light"}};
  for (const auto& [rest, light] : lit) {
    write_text(root() / "ball.scene.json", shape + rest);
    const Outcome got = look("ball.scene.json --size 48x48 --overwrite");
    EXPECT_NE(got.out.find(light), std::string::npos) << got.out << got.err;
    EXPECT_EQ(got.err.find("no lights") == std::string::npos, light == "studio light") << got.err;
  }
}

TEST_F(Look, NamesTheWholeRangeOfNumbersWithASign) {
  write_ball("ball.scene.json", 0.5, "[1, 1, 1]", 0);
  EXPECT_NE(look("ball.scene.json --exposure -20").err.find("'-20' is out of range: -15 to 15"),
            std::string::npos);
  EXPECT_NE(look("ball.scene.json --from -400,0").err.find("'-400' is out of range: -360 to 360"),
            std::string::npos);
}

}  // namespace
}  // namespace herr
