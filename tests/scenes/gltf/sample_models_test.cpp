// Models of other people, hundreds of them broken on purpose: each loads whole or is refused with one line.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iostream>
#include <set>

#include "scenes/load_scene.h"
#include "scenes/model/material_textures.h"
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

// Every texture exists, and the mesh has the coordinates that it reads.
void expect_sound(const Material& material, const TriangleMesh& mesh, std::size_t textures,
                  const std::string& name) {
  const TextureSlot base{material.base_colour_texture, material.base_colour_uv_set},
      rough{material.metallic_roughness_texture, material.metallic_roughness_uv_set};
  for (const TextureSlot& slot :
       {base, rough, material.emission_texture, material.normal_texture, material.specular_texture,
        material.specular_colour_texture, material.transmission_texture}) {
    if (slot.texture < 0) continue;
    ASSERT_LT(static_cast<std::size_t>(slot.texture), textures) << name;
    ASSERT_FALSE(mesh.uvs.empty()) << name;
    ASSERT_LE(static_cast<std::size_t>(slot.uv_set), mesh.more_uvs.size()) << name;
  }
  ASSERT_EQ(mesh.tangents.size(), follows_tangents(material) ? mesh.positions.size() : 0) << name;
}

// What scene.h promises about every scene that load_scene returns.
void expect_sound(const Scene& scene, const std::string& name) {
  for (const TriangleMesh& mesh : scene.meshes) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << name;
    ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size()) << name;
    ASSERT_TRUE(mesh.colours.empty() || mesh.colours.size() == mesh.positions.size()) << name;
    for (const auto& uvs : mesh.more_uvs) ASSERT_EQ(uvs.size(), mesh.positions.size()) << name;
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) ASSERT_LT(vertex, mesh.positions.size()) << name;
    }
    for (const glm::vec3& position : mesh.positions)
      ASSERT_TRUE(std::isfinite(glm::dot(position, position))) << name;
    // A unit vector rounded to float has a length within 1e-7 * sqrt(3) of 1.
    for (const glm::vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1.0, 5e-7) << name;
    for (const glm::vec4& tangent : mesh.tangents) {
      ASSERT_NEAR(glm::length(glm::vec3(tangent)), 1.0, 5e-7) << name;
      ASSERT_EQ(std::abs(tangent.w), 1.0f) << name;
    }
  }
  for (const Instance& instance : scene.instances) {
    ASSERT_LT(instance.mesh, scene.meshes.size()) << name;
    ASSERT_LT(instance.material, scene.materials.size()) << name;
    expect_sound(scene.materials[instance.material], scene.meshes[instance.mesh], scene.textures.size(),
                 name);
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
  EXPECT_EQ(refused, (std::set<std::string>{"glTF-Draco/Duck"}));
}

// What the corpus expects of a file: its number of errors, and whether one of them is a reference that leads
// out of bounds, to nothing, or in a circle.
struct Expectation {
  int errors = 0;
  bool bad_reference = false;
};

Expectation expectation_of(const std::filesystem::path& model) {
  static const std::set<std::string> kBadReferences{"UNRESOLVED_REFERENCE",
                                                    "NODE_LOOP",
                                                    "NODE_PARENT_OVERRIDE",
                                                    "SCENE_NON_ROOT_NODE",
                                                    "ACCESSOR_TOO_LONG",
                                                    "ACCESSOR_INDEX_OOB",
                                                    "BUFFER_VIEW_TOO_LONG",
                                                    "BUFFER_MISSING_GLB_DATA",
                                                    "IO_ERROR"};
  std::ifstream stream(model.string() + ".report.json");
  Expectation expected;
  const auto report = nlohmann::json::parse(stream);
  expected.errors = report.at("issues").at("numErrors");
  for (const auto& message : report.at("issues").at("messages")) {
    const bool error = message.at("severity") == 0;
    expected.bad_reference |= error && kBadReferences.count(message.at("code")) != 0;
  }
  return expected;
}

TEST(SampleModels, EveryFileOfTheValidatorsCorpusLoadsOrIsAnInputError) {
  const auto models = models_in("gltf_validator_corpus");
  if (models.empty()) GTEST_SKIP() << "no models in " << data_folder();
  EXPECT_EQ(models.size(), 372u);
  // Without errors, and yet not what a renderer of glTF 2.0 files can show.
  const std::set<std::string> out_of_scope{
      "accessor/unknown_type.gltf",            // an accessor of the type "NotaVEC3"
      "asset/min_version_valid.gltf",          // asks for glTF 2.1
      "accessor/valid.gltf",                   // buffers without data, as are
      "buffer/custom_property.gltf",           // this,
      "buffer/valid_placeholder.glb",          // this,
      "json/integer_written_as_float.gltf",    // this,
      "root/named_objects.gltf",               // this
      "root/unused_objects.gltf",              // and this
      "animation/valid.gltf",                  // times without data: all keys at 0 s
      "skin/ignored_animated_transform.gltf",  // likewise
      "mesh/valid.gltf",                       // indices without data
      "buffer/data_uri.glb",                   // data that are not base64
      "buffer/non_relative_uri.gltf"};         // a buffer on a web server
  int loaded = 0, refused = 0;
  for (const auto& model : models) {
    const std::string message = check(model);
    ++(message.empty() ? loaded : refused);
    const Expectation expected = expectation_of(model);
    const std::string name = model.parent_path().filename().string() + "/" + model.filename().string();
    const bool in_scope = message.empty() || out_of_scope.count(name) == 0;
    if (expected.errors == 0 && in_scope) {
      EXPECT_EQ(message, "") << model;
    }
    if (expected.bad_reference) {
      EXPECT_NE(message, "") << model;
    }
  }
  std::cout << loaded << " files loaded, " << refused << " were refused\n";
}

TEST(SampleModels, EveryRegressionModelOfTinygltfLoadsOrIsAnInputError) {
  const auto models = models_in("tinygltf_models");
  if (models.empty()) GTEST_SKIP() << "no models in " << data_folder();
  for (const auto& model : models) {
    const std::string message = check(model);
    const bool bounds = contains(model.string(), "BoundsChecking");
    // The matrices of this skin are no numbers of a skin: one is 1.2e18.
    const bool garbage = contains(model.string(), "unassigned-skeleton");
    EXPECT_EQ(bounds || garbage || contains(model.string(), "issue-416"), !message.empty())
        << model << message;
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
  EXPECT_TRUE(contains(check(bunny), ".scene.json, .gltf, .glb or .vox"));
}

}  // namespace
}  // namespace herr::test
