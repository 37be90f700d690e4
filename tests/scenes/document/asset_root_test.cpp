// Files of a scene document that lie below a folder of models in place of the document's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/load_scene.h"
#include "sessions/files/input_error.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class AssetRoot : public ::testing::Test {
 protected:
  fs::path scene(const std::string& named) const {
    return folder_.write("scene/room.scene.json",
                         json{{"format_version", 1},
                              {"name", "room"},
                              {"catchers", {{{"box", {{"min", {0, 0, 0}}, {"max", {1, 1, 1}}}}}}},
                              {"gltf", {{{"file", named}}}}}
                             .dump());
  }
  // An empty glTF shows nothing, and says under which path it was found.
  fs::path model(const std::string& name) const {
    return folder_.write(name, R"({"asset": {"version": "2.0"}})");
  }
  std::string error_of(const fs::path& file, const std::vector<fs::path>& roots) const {
    try {
      (void)load_scene(file, roots);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  fs::path root(const std::string& name) const { return folder_.path() / name; }

  TemporaryFolder folder_;
};

TEST_F(AssetRoot, ModelsAreFoundInTheScenesFolderThenInEachRootInOrder) {
  const fs::path file = scene("a/model.gltf");
  const std::vector<fs::path> roots{root("one"), root("two")};
  fs::create_directories(roots[0]);
  const fs::path in_two = model("two/a/model.gltf");
  EXPECT_EQ(load_scene(file, roots).files.back(), in_two);
  const fs::path in_one = model("one/a/model.gltf");
  EXPECT_EQ(load_scene(file, roots).files.back(), in_one);
  const fs::path own = model("scene/a/model.gltf");
  EXPECT_EQ(load_scene(file, roots).files.back(), own);
}

TEST_F(AssetRoot, AMissingModelNamesEveryRootThatWasSearched) {
  const fs::path file = scene("a/model.gltf");
  EXPECT_NE(error_of(file, {}).find("needs --asset-root DIR"), std::string::npos) << error_of(file, {});
  fs::create_directories(root("one"));
  fs::create_directories(root("two"));
  const std::string error = error_of(file, {root("one"), root("two")});
  EXPECT_NE(error.find("gltf[0].file names " + root("scene/a/model.gltf").string() +
                       ", which does not exist; nor is it below --asset-root " + root("one").string() + ", " +
                       root("two").string()),
            std::string::npos)
      << error;
}

TEST_F(AssetRoot, NoNameLeadsOutOfARoot) {
  model("elsewhere/model.gltf");
  fs::create_directories(root("one"));
  const std::vector<fs::path> roots{root("one")};
  EXPECT_NE(error_of(scene("../elsewhere/model.gltf"), roots).find("not below the folder"),
            std::string::npos);
  EXPECT_NE(error_of(scene(root("elsewhere/model.gltf").string()), roots).find("not below the folder"),
            std::string::npos);
  fs::create_symlink(root("elsewhere/model.gltf"), root("one/model.gltf"));
  const std::string error = error_of(scene("model.gltf"), roots);
  EXPECT_NE(error.find("a link that leads out of --asset-root " + root("one").string()), std::string::npos)
      << error;
  // The folder itself may be reached by a link.
  model("one/inner/model.gltf");
  fs::create_symlink(root("one"), root("link"));
  EXPECT_EQ(load_scene(scene("inner/model.gltf"), {{root("link")}}).name, "room");
}

TEST_F(AssetRoot, ARootThatIsNoFolderIsRefusedByName) {
  const std::string error = error_of(scene("model.gltf"), {root("absent")});
  EXPECT_EQ(error.find(root("absent").string() + ": is no folder"), 0u) << error;
}

// A bare glTF or VOX names files beside itself alone: who gives a root is told that nobody looks there.
TEST_F(AssetRoot, OfABareModelIsSaidToHaveNoEffect) {
  fs::create_directories(root("one"));
  const fs::path bare = model("scene/model.gltf");
  const auto about_roots = [](const Scene& scene) {
    return std::count_if(scene.warnings.begin(), scene.warnings.end(), [](const std::string& warning) {
      return warning.find("--asset-root has no effect") != std::string::npos;
    });
  };
  EXPECT_EQ(about_roots(load_scene(bare, {{root("one")}})), 1);
  EXPECT_EQ(about_roots(load_scene(bare)), 0);
  EXPECT_EQ(about_roots(load_scene(scene("model.gltf"), {{root("one")}})), 0);
}

}  // namespace
}  // namespace herr
