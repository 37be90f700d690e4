// Extensions that are not read: who uses them and what a picture lacks.
#include "scenes/gltf/format/extension_losses.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace herr::test {
namespace {

using nlohmann::json;
using Lines = std::vector<std::string>;

TEST(ExtensionLosses, NameTheMaterialsAndWhatTheyAreShownWithout) {
  const json thin{{"KHR_materials_iridescence", {{"iridescenceFactor", 1}}}};
  const json document{
      {"materials", {{{"name", "soap"}, {"extensions", thin}}, {{"name", "plain"}}, {{"extensions", thin}}}}};
  EXPECT_EQ(extension_losses(document, {"KHR_materials_iridescence"}),
            (Lines{"extension KHR_materials_iridescence is not read: material \"soap\", materials[2]: shown "
                   "without the colours of thin films"}));
}

TEST(ExtensionLosses, OfManyPlacesNameThreeAndCountTheOthers) {
  json document{{"nodes", json::array()}};
  for (int i = 0; i < 5; ++i) document["nodes"].push_back({{"extensions", {{"EXT_odd", json::object()}}}});
  EXPECT_EQ(extension_losses(document, {}),
            (Lines{"extension EXT_odd is not read: nodes[0], nodes[1], nodes[2] and 2 more: it is not known; "
                   "what it adds is left out"}));
}

TEST(ExtensionLosses, OfTexturesDependOnThePictureBesideThem) {
  const json webp{{"EXT_texture_webp", {{"source", 1}}}};
  const json document{
      {"textures",
       {{{"name", "a"}, {"source", 0}, {"extensions", webp}}, {{"name", "b"}, {"extensions", webp}}}}};
  EXPECT_EQ(
      extension_losses(document, {}),
      (Lines{"extension EXT_texture_webp is not read: texture \"a\": the PNG or JPEG beside its picture is "
             "shown",
             "extension EXT_texture_webp is not read: texture \"b\": the texture is left out"}));
}

TEST(ExtensionLosses, AreSoughtWithinExtensionsThatAreReadAndNotWithinOthers) {
  const json odd{{"EXT_odd", json::object()}};
  const json document{
      {"extensions", {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}, {"extensions", odd}}}}}}}},
      {"extras", {{"extensions", odd}}},
      {"materials",
       {{{"name", "m"},
         {"extensions", {{"EXT_outer", {{"extensions", {{"EXT_inner", json::object()}}}}}}}}}}};
  const Lines lines = extension_losses(document, {});
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].rfind("extension EXT_odd is not read: the file: ", 0), 0u) << lines[0];
  EXPECT_EQ(lines[1].rfind("extension EXT_outer is not read: material \"m\": ", 0), 0u) << lines[1];
}

TEST(ExtensionLosses, AreNamedThoughNothingUsesThemAndNotForWhatIsRead) {
  EXPECT_EQ(extension_losses(json::object(),
                             {"KHR_materials_sheen", "KHR_mesh_quantization", "KHR_xmp", "EXT_odd"}),
            (Lines{"extension EXT_odd is not read: it is not known; what it adds is left out",
                   "extension KHR_xmp is not read: nothing in the file uses it"}));
}

TEST(ExtensionLosses, SayWhichVariantsAreLeftOut) {
  const json document{
      {"extensions", {{"KHR_materials_variants", {{"variants", {{{"name", "red"}}, {{"name", "blue"}}}}}}}}};
  EXPECT_EQ(extension_losses(document, {"KHR_materials_variants"}),
            (Lines{"its variants \"red\", \"blue\" are left out: shown in its default look"}));
}

}  // namespace
}  // namespace herr::test
