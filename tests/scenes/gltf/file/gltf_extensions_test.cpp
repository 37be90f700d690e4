// Extensions that say what shows: nodes that are hidden, default looks, and which files are refused by name.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

json hidden(bool visible) {
  return {{"KHR_node_visibility", {{"visible", visible}}}};
}

// Nodes: 0 shows; 1 is hidden, below it 2 and 3, which claim to be visible; a light stands at 3.
TEST(NodeVisibility, AHiddenNodeHidesMeshesAndLightsBelowItWhateverTheySay) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const TemporaryFolder folder;
    json document = triangle_document();
    document[list] = {"KHR_node_visibility", "KHR_lights_punctual"};
    document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    json lit = hidden(true);
    lit["KHR_lights_punctual"] = {{"light", 0}};
    document["nodes"] = {{{"name", "shown"}, {"mesh", 0}, {"extensions", hidden(true)}},
                         {{"name", "hidden"}, {"mesh", 0}, {"children", {2}}, {"extensions", hidden(false)}},
                         {{"name", "below"}, {"mesh", 0}, {"children", {3}}, {"extensions", hidden(true)}},
                         {{"name", "lamp"}, {"extensions", lit}}};
    document["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load_scene(write_model(folder, document));
    ASSERT_EQ(scene.instances.size(), 1u) << list;
    EXPECT_EQ(scene.instances[0].name, "shown");
    EXPECT_TRUE(std::none_of(scene.lights.begin(), scene.lights.end(),
                             [](const AreaLight& light) { return light.name == "lamp"; }));
    EXPECT_FALSE(any_contains(scene.warnings, "KHR_node_visibility"));
  }
}

TEST(NodeVisibility, ThatIsNoTruthValueShowsTheNodeAndIsRefusedWhereItIsRequired) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = 0;
  const Scene scene = load_scene(write_model(folder, document));
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(any_contains(scene.warnings, "KHR_node_visibility.visible is a number; the node is shown"));
  document["extensionsRequired"] = {"KHR_node_visibility"};
  EXPECT_TRUE(contains(error_of(write_model(folder, document)), "KHR_node_visibility.visible"));
}

TEST(Extensions, VariantsMayBeRequiredAndTheDefaultLookShows) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["extensionsRequired"] = {"KHR_materials_variants"};
  document["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "night"}}};
  document["materials"] = {{{"name", "day"}, {"emissiveFactor", {0.25, 0, 0}}},
                           {{"name", "night"}, {"emissiveFactor", {0, 0, 0.5}}}};
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}}};
  const Scene scene = load_scene(write_model(folder, document));
  EXPECT_EQ(scene.materials.at(scene.instances.at(0).material).emission, glm::vec3(0.25f, 0, 0));
  EXPECT_TRUE(any_contains(scene.warnings, "its variants \"night\" are left out"));
}

TEST(Extensions, ThatAreRequiredAndNotReadAreRefusedWithWhatToDo) {
  const std::pair<const char*, const char*> names[] = {
      {"KHR_draco_mesh_compression", "export the model without Draco, or pack it with gltfpack -c"},
      {"KHR_meshopt_compression",
       "its streams are newer than those of EXT_meshopt_compression, which is read"},
      {"KHR_texture_basisu", "export the model with PNG or JPEG textures"},
      {"EXT_odd", "export the model without EXT_odd"}};
  for (const auto& [name, remedy] : names) {
    const TemporaryFolder folder;
    json document = triangle_document();
    document["extensionsRequired"] = {name};
    const std::string message = error_of(write_model(folder, document));
    EXPECT_TRUE(contains(message, std::string("extensionsRequired names ") + name)) << message;
    EXPECT_TRUE(contains(message, remedy)) << message;
  }
}

TEST(Extensions, PartsOfPrimitivesThatNoPictureShowsAreNamed) {
  const TemporaryFolder folder;
  json document = triangle_document();
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["attributes"]["JOINTS_2"] = 0;
  primitive["attributes"]["WEIGHTS_2"] = 0;
  primitive["targets"] = {{{"POSITION", 0}, {"COLOR_0", 0}}};
  const Scene scene = load_scene(write_model(folder, document));
  for (const char* name : {"JOINTS_2", "WEIGHTS_2", "COLOR_0 of morph targets"})
    EXPECT_TRUE(any_contains(scene.warnings, std::string("mesh \"triangle\": ") + name + " is left out"))
        << name;
}

// Files that other readers show without these extensions, whatever stands in them, are shown here too.
TEST(Extensions, OfFurtherLobesAndVolumesTakeNumbersFarOutOfRangeAsTheEnd) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["materials"] = {
      {{"extensions",
        {{"KHR_materials_clearcoat", {{"clearcoatFactor", 3}}},
         {"KHR_materials_transmission", {{"transmissionFactor", 1}}},
         {"KHR_materials_volume",
          {{"thicknessFactor", 1}, {"attenuationColor", {-1, 0.5, 2}}, {"attenuationDistance", 0}}}}}}};
  const Scene scene = load_scene(write_model(folder, document));
  EXPECT_EQ(scene.materials.at(scene.instances.at(0).material).clearcoat.strength, 1.0f);
  EXPECT_TRUE(any_contains(scene.warnings, "and 2 numbers more"));
  EXPECT_TRUE(any_contains(scene.warnings, "attenuationDistance is 0; nothing is taken from light inside"));
}

json spot_document(double inner, double outer) {
  json document = triangle_document();
  document["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}}};
  document["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  document["scenes"][0]["nodes"] = {0, 1};
  return document;
}

// pi/2 rounded to float is 1.57079637050628662109375, above the double pi/2 by 4.4e-8.
TEST(RoundedLights, AConeOfHalfPiAsFloatIsHalfPi) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(folder, spot_document(1.0, 1.5707963705062866)));
  EXPECT_EQ(scene.lights.at(0).outer_cone_rad, 1.5707963267948966);
  EXPECT_EQ(scene.lights.at(0).inner_cone_rad, 1.0);
  EXPECT_TRUE(any_contains(scene.warnings,
                           "outerConeAngle is 1.5707963705062866, out of range; taken as "
                           "1.5707963267948966"));
}

TEST(RoundedLights, EqualConesAreASharpEdgeAndWiderInnerOnesAreRefused) {
  const TemporaryFolder folder;
  for (const double inner : {0.5, 0.50000003}) {
    const Scene scene = load_scene(write_model(folder, spot_document(inner, 0.5)));
    EXPECT_EQ(scene.lights.at(0).inner_cone_rad, 0.5);
    EXPECT_TRUE(any_contains(scene.warnings, "not below outerConeAngle, 0.5"));
  }
  EXPECT_TRUE(contains(error_of(write_model(folder, spot_document(0.501, 0.5))),
                       "innerConeAngle is 0.501, not below outerConeAngle, 0.5"));
}

}  // namespace
}  // namespace herr::test
