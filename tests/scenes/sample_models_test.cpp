// Models of other people, hundreds of them broken on purpose: each loads whole or is refused with one line.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <set>

#include "tests/paths.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

std::filesystem::path data_folder() {
  if (const char* folder = std::getenv("HERR_TEST_DATA")) return folder;
  return std::filesystem::path(test::source_dir()) / "../shared/data";
}

std::vector<std::filesystem::path> models_in(const std::string& folder) {
  std::vector<std::filesystem::path> models;
  const auto root = data_folder() / "models" / folder;
  if (!std::filesystem::is_directory(root)) return models;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const auto extension = entry.path().extension();
    if (extension == ".gltf" || extension == ".glb") models.push_back(entry.path());
  }
  std::sort(models.begin(), models.end());
  return models;
}

// What scene.h promises about every scene that load_scene returns.
void expect_sound(const Scene& scene, const std::string& name) {
  for (const TriangleMesh& mesh : scene.meshes) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << name;
    ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size()) << name;
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) ASSERT_LT(vertex, mesh.positions.size()) << name;
    }
    for (const glm::vec3& position : mesh.positions)
      ASSERT_TRUE(std::isfinite(glm::dot(position, position))) << name;
    // A unit vector rounded to float has a length within 1e-7 * sqrt(3) of 1.
    for (const glm::vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1.0, 5e-7) << name;
  }
  for (const Instance& instance : scene.instances) {
    ASSERT_LT(instance.mesh, scene.meshes.size()) << name;
    ASSERT_LT(instance.material, scene.materials.size()) << name;
  }
  const auto textures = static_cast<int>(scene.textures.size());
  for (const Material& material : scene.materials) {
    ASSERT_LT(material.base_colour_texture, textures) << name;
    ASSERT_LT(material.metallic_roughness_texture, textures) << name;
  }
  for (const TextureImage& texture : scene.textures) {
    ASSERT_EQ(texture.rgba.size(),
              4u * static_cast<std::size_t>(texture.width_px) * static_cast<std::size_t>(texture.height_px))
        << name;
  }
}

// Loads one model; returns the message when it is refused. Anything but an InputError fails the test.
std::string check(const std::filesystem::path& model) {
  try {
    expect_sound(load_scene(model), model.string());
    return "";
  } catch (const InputError& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << model << " threw something else: " << error.what();
    return error.what();
  }
}

TEST(SampleModels, EveryKhronosModelLoadsOrIsRefusedForAnExtensionThatItRequires) {
  const auto models = models_in("khronos_sample_assets");
  if (models.empty()) GTEST_SKIP() << "no models in " << data_folder();
  std::set<std::string> refused;
  for (const auto& model : models) {
    const std::string message = check(model);
    if (message.empty()) continue;
    refused.insert(model.parent_path().filename().string() + "/" + model.stem().string());
    EXPECT_TRUE(contains(message, "extensionsRequired")) << message;
  }
  EXPECT_EQ(refused, (std::set<std::string>{"glTF-Draco/Duck", "glTF-Binary/TextureTransformMultiTest"}));
}

TEST(SampleModels, EveryFileOfTheValidatorsCorpusLoadsOrIsAnInputError) {
  const auto models = models_in("gltf_validator_corpus");
  if (models.empty()) GTEST_SKIP() << "no models in " << data_folder();
  int loaded = 0, refused = 0, valid_refused = 0;
  for (const auto& model : models) {
    const std::string message = check(model);
    ++(message.empty() ? loaded : refused);
    std::ifstream stream(model.string() + ".report.json");
    if (!stream || message.empty()) continue;
    const auto report = nlohmann::json::parse(stream);
    valid_refused += report.at("issues").at("numErrors") == 0 ? 1 : 0;
  }
  // The counts of this corpus when the test was written: buffers without data, glTF 2.1 and data URIs of
  // other kinds are valid and yet cannot be shown.
  EXPECT_GE(loaded, 220);
  EXPECT_GE(refused, 100);
  EXPECT_LE(valid_refused, 11);
}

TEST(SampleModels, EveryRegressionModelOfTinygltfLoadsOrIsAnInputError) {
  const auto models = models_in("tinygltf_models");
  if (models.empty()) GTEST_SKIP() << "no models in " << data_folder();
  for (const auto& model : models) {
    const std::string message = check(model);
    const bool bounds = contains(model.string(), "BoundsChecking");
    EXPECT_EQ(bounds || contains(model.string(), "issue-416"), !message.empty()) << model << message;
  }
}

TEST(SampleModels, EveryPositiveModelOfTheAssetGeneratorLoadsAndEveryNegativeOneIsSafe) {
  const auto models = models_in("gltf_asset_generator");
  if (models.empty()) GTEST_SKIP() << "no models in " << data_folder();
  for (const auto& model : models) {
    const std::string message = check(model);
    if (contains(model.string(), "Negative")) continue;
    // These two ask for glTF 2.1 and for an extension that does not exist: a reader must refuse them.
    const bool must_refuse = model.stem() == "Compatibility_04" || model.stem() == "Compatibility_05";
    EXPECT_EQ(message.empty(), !must_refuse) << model << message;
  }
}

TEST(SampleModels, ARoomScanHasItsTrianglesAndStandsOnTheFloor) {
  const auto models = models_in("quest_rooms");
  if (models.empty()) GTEST_SKIP() << "no models in " << data_folder();
  for (const auto& model : models) {
    const Scene scene = load_scene(model);
    EXPECT_GT(triangle_count(scene, true), 3000) << model;
    EXPECT_NEAR(scene_bounds(scene).lower.y, 0, 0.1)
        << model;  // scanned floors are level within a hand's breadth
  }
}

TEST(SampleModels, AnObjFileIsRefusedWithTheFormatsThatAreRead) {
  const auto bunny = data_folder() / "models/scans/stanford-bunny.obj";
  if (!std::filesystem::exists(bunny)) GTEST_SKIP() << "no models in " << data_folder();
  EXPECT_TRUE(contains(check(bunny), ".scene.json, .gltf or .glb"));
}

}  // namespace
}  // namespace herr::test
