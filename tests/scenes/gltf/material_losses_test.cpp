// What pictures leave out is said with the name of the material or mesh, and nothing is said of what shows as
// it should; broken extensions that a document can do without are passed over.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/gltf/material_losses.h"
#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

// The warnings of a model whose one material is this; `indices` into the corners of a tetrahedron.
std::vector<std::string> warnings_of(json material, const std::vector<std::uint16_t>& indices = {0, 2, 1},
                                     const char* required = nullptr) {
  const TemporaryFolder folder;
  material["name"] = "surface";
  const std::string bytes =
      bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + bytes_of<std::uint16_t>(indices);
  folder.write("body.bin", bytes);
  json document = json::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0}], "meshes": [{"name": "body", "primitives":
[{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
{"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 6}],
"buffers": [{"byteLength": 54, "uri": "body.bin"}]})");
  document["accessors"][1]["count"] = indices.size();
  document["bufferViews"][1]["byteLength"] = 2 * indices.size();
  document["buffers"][0]["byteLength"] = bytes.size();
  document["materials"] = json::array({material});
  if (required != nullptr) document["extensionsRequired"] = {required};
  return load_scene(folder.write("body.gltf", document.dump())).warnings;
}

// Of the tetrahedron with corners at 0 and one metre along each axis: fronts outside, seen from there the
// corners of each triangle run counter-clockwise; and the same turned inside out.
const std::vector<std::uint16_t> kOutwards{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
const std::vector<std::uint16_t> kInwards{0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};

json glass(double roughness, double thickness) {
  return {{"pbrMetallicRoughness", {{"roughnessFactor", roughness}}},
          {"extensions",
           {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
            {"KHR_materials_volume",
             {{"thicknessFactor", thickness},
              {"attenuationDistance", 0.5},
              {"attenuationColor", {0.5, 1, 1}}}}}}};
}

TEST(MaterialLosses, ThinAndRoughGlassIsNamedAndClearBodiesAreNot) {
  EXPECT_TRUE(warnings_of(glass(0, 1), kOutwards).empty());
  const auto thin = warnings_of(glass(0, 0), kOutwards);
  ASSERT_EQ(thin.size(), 1u);
  EXPECT_TRUE(contains(thin[0], "material \"surface\" is glass without thickness"));
  const auto rough = warnings_of(glass(0.5, 1), kOutwards);
  ASSERT_EQ(rough.size(), 1u);
  EXPECT_TRUE(contains(rough[0], "material \"surface\" is rough glass"));
}

// Names are those of the materials, in the order in which meshes show them; the fourth is the last.
TEST(MaterialLosses, OneLineNamesAllMaterialsOfALoss) {
  MaterialLosses losses;
  for (const char* name : {"a", "b", "a", "c", "d", "e", "f"}) {
    GltfMaterial material;
    material.name = name;
    material.sheen_colour = glm::vec3(1.0f);
    losses.add(material, {});
    EXPECT_TRUE(losses.lines().front().starts_with("material \"a\" has sheen"));
  }
  const std::vector<std::string> lines = losses.lines();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].ends_with("; so with \"b\", \"c\", \"d\" and 2 others")) << lines[0];
}

TEST(MaterialLosses, AnOpenBodyThatAbsorbsIsNamed) {
  const auto open = warnings_of(glass(0, 1), {0, 2, 1});
  ASSERT_EQ(open.size(), 1u);
  EXPECT_TRUE(contains(open[0], "mesh \"body\" is not closed"));
}

TEST(MaterialLosses, CoatsAndSheenSayWhatTheyLack) {
  const auto with = [](const char* name, const json& extension) {
    return warnings_of({{"extensions", {{name, extension}}}});
  };
  const auto smooth = with("KHR_materials_clearcoat", {{"clearcoatFactor", 1}});
  EXPECT_EQ(smooth.size(), 2u);
  EXPECT_TRUE(any_contains(smooth, "material \"surface\" has a smooth clear coat"));
  EXPECT_TRUE(any_contains(smooth, "which light between surfaces (probes) leaves out"));
  const auto dull =
      with("KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0.5}});
  EXPECT_EQ(dull.size(), 1u);
  EXPECT_TRUE(any_contains(with("KHR_materials_sheen", {{"sheenColorFactor", {1, 1, 1}}}), "has sheen"));
  EXPECT_TRUE(with("KHR_materials_clearcoat", {{"clearcoatFactor", 0}}).empty());
}

TEST(MaterialLosses, AHullTurnedInsideOutIsNamedUnlessItHasTwoSides) {
  const auto hull = warnings_of(json::object(), kInwards);
  ASSERT_EQ(hull.size(), 1u);
  EXPECT_TRUE(contains(hull[0], "mesh \"body\" is closed and faces inwards"));
  EXPECT_TRUE(warnings_of({{"doubleSided", true}}, kInwards).empty());
  EXPECT_TRUE(warnings_of(json::object(), kOutwards).empty());
}

TEST(MaterialLosses, AnIndexRoundedBelowOneIsOne) {
  const auto of_index = [](double index) {
    return warnings_of({{"extensions", {{"KHR_materials_ior", {{"ior", index}}}}}});
  };
  EXPECT_TRUE(any_contains(of_index(0.99999994), "ior is 0.99999994, out of range; taken as 1"));
  try {
    of_index(0.5);
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "ior is 0.5, between 0 and 1")) << error.what();
  }
}

TEST(MaterialLosses, ABrokenExtensionIsPassedOverUnlessItIsRequired) {
  const std::pair<const char*, json> broken[] = {
      {"KHR_materials_clearcoat", {{"clearcoatFactor", "much"}}},
      {"KHR_materials_sheen", {{"sheenColorFactor", {1, 1}}}},
      {"KHR_materials_anisotropy", {{"anisotropyStrength", json::array()}}},
      {"KHR_materials_volume", {{"thicknessFactor", true}}},
      {"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {1, 1, 1}}}}};
  for (const auto& [name, extension] : broken) {
    const json material = {{"extensions", {{name, extension}}}};
    EXPECT_TRUE(any_contains(warnings_of(material), std::string("the material is shown without ") + name));
    EXPECT_THROW(warnings_of(material, {0, 2, 1}, name), InputError) << name;
  }
}

TEST(MaterialLosses, AVastAttenuationDistanceAbsorbsNothing) {
  json material = glass(0, 1);
  material["extensions"]["KHR_materials_volume"]["attenuationDistance"] = 1e20;
  EXPECT_TRUE(warnings_of(material, kOutwards).empty());
}

}  // namespace
}  // namespace herr::test
