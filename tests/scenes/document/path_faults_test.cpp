// Paths of objects that are refused when a scene is loaded, each by one line that names its field.
#include <gtest/gtest.h>

#include "tests/scenes/document/path_scenes.h"

namespace herr::test {
namespace {

TEST(PathFaultsTest, PathsThatCannotBeAreRefusedByTheNameOfTheirField) {
  const struct {
    std::string path, says;
  } cases[] = {
      {"[]", "path is an array, not an object"},
      {"{}", "path.keys"},
      {R"({"keys": []})", "path.keys has no key; write where the object stands"},
      {R"({"key": []})", "did you mean 'keys'?"},
      {R"({"keys": [], "loop": 1})", "path.loop"},
      {R"({"keys": [{"translation": [0, 0, 0]}]})", "path.keys[0].t_s"},
      {R"({"keys": [{"t_s": -1}]})", "path.keys[0].t_s"},
      {R"({"keys": [{"t_s": 5e9}]})", "path.keys[0].t_s"},
      {R"({"keys": [{"t_s": 0, "translatoin": [0, 0, 0]}]})", "did you mean 'translation'?"},
      {R"({"keys": [{"t_s": 0, "translation": [0, 0]}]})", "path.keys[0].translation"},
      {R"({"keys": [{"t_s": 0, "translation": [0, 0, 2e9]}]})", "path.keys[0].translation"},
      {R"({"keys": [{"t_s": 0, "rotation_xyzw": [0, 0, 0, 0.5]}]})",
       "is [0, 0, 0, 0.5], not of unit length but 0.5"},
      {R"({"keys": [{"t_s": 0, "scale": 0}]})", "is 0: the object would have no extent"},
      {R"({"keys": [{"t_s": 0, "scale": 1e10}]})", "path.keys[0].scale"},
      {R"({"keys": [{"t_s": 1}, {"t_s": 1}]})", "path.keys[1].t_s is not after that of the key before"},
      {R"({"keys": [{"t_s": 2}, {"t_s": 1}]})", "path.keys[1].t_s is not after that of the key before"},
      {R"({"keys": [{"t_s": 0}, {"t_s": 1, "scale": [1, -1, 1]}]})",
       "path.keys[1].scale passes through 0 on the y axis"},
      {R"({"keys": [{"t_s": 0, "scale": -1}, {"t_s": 1}]})", "path.keys[1].scale passes through 0"},
      {R"({"keys": [{"t_s": 0}, {"t_s": 1, "scale": 1e-13}]})", "path.keys[1] places the object so that it"},
      {R"({"keys": [{"t_s": 0}, {"t_s": 1, "scale": [1e6, 1e-22, 1e-22]}]})", "flattens or shrinks"},
  };
  for (const auto& [path, says] : cases) {
    const TemporaryFolder folder;
    const std::string error = error_of(write_kinds(folder, "\"path\": " + path));
    EXPECT_TRUE(contains(error, says)) << path << "\n" << error;
    EXPECT_TRUE(contains(error, "kinds.scene.json")) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(PathFaultsTest, EachKindOfEntryChecksItsOwnPath) {
  const std::string good = R"({"t_s": 0, "translation": [0, 1, 0]})";
  const auto error_with = [&](const std::string& entries) {
    const TemporaryFolder folder;
    write_model(folder, triangle_document());
    folder.write("one.vox", vox_bytes(vox_model(1, 1, 1, {{0, 0, 0, 1}})));
    return error_of(folder.write("s.scene.json", R"({"format_version": 1, "name": "s", )" + entries + "}"));
  };
  const std::string small = R"("path": {"keys": [)" + good + R"(, {"t_s": 1, "scale": 2e-13}]})";
  EXPECT_TRUE(
      contains(error_with(R"("gltf": [{"file": "model.gltf", )" + small + "}]"), "gltf[0].path.keys[1]"));
  EXPECT_TRUE(
      contains(error_with(R"("voxels": [{"file": "one.vox", )" + small + "}]"), "voxels[0].path.keys[1]"));
  EXPECT_TRUE(
      contains(error_with(R"("catchers": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, )" + small + "}]"),
               "catchers[0].path.keys[1]"));
  EXPECT_TRUE(
      contains(error_with(R"("shapes": [{"sphere": {"centre": [0, 0, 0], "radius": 1}, )" + small + "}]"),
               "shapes[0].path.keys[1]"));
  // A room is real: it stands.
  EXPECT_TRUE(contains(error_with(R"("room_scan": {"file": "room.json", "path": {}})"), "room_scan.path"));
}

TEST(PathFaultsTest, AKeyThatReachesTooFarIsRefused) {
  // The triangle reaches 1 m; its node scales that to 1e7 m, and the key by 1e6: sqrt(2) * 1e13 m.
  const TemporaryFolder folder;
  nlohmann::json document = triangle_document();
  document["nodes"][0]["scale"] = {1e7, 1e7, 1e7};
  write_model(folder, document);
  const auto with_scale = [&](const std::string& scale) {
    return error_of(folder.write("s.scene.json", R"({"format_version": 1, "name": "s", "gltf": [
      {"file": "model.gltf", "path": {"keys": [{"t_s": 0}, {"t_s": 1, "scale": )" +
                                                     scale + "}]}}]}"));
  };
  EXPECT_EQ(with_scale("7e4"), "");  // each coordinate 7e11, together 9.9e11
  EXPECT_TRUE(contains(with_scale("8e4"), "path.keys[1] places the object so that it reaches farther"));
}

}  // namespace
}  // namespace herr::test
