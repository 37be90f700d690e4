// What materials hold beyond metallic-roughness: clear coat, sheen, stretched highlights, bodies that absorb,
// occlusion, mirrors of index 0, and files of before metallic-roughness.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/gltf/material_builder.h"
#include "scenes/load_scene.h"
#include "scenes/model/material_override.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

void write_pixel(const std::filesystem::path& file, const std::array<std::uint8_t, 4>& rgba) {
  const auto writer = OIIO::ImageOutput::create(file.string());
  OIIO::ImageSpec spec(1, 1, 4, OIIO::TypeDesc::UINT8);
  spec["oiio:UnassociatedAlpha"] = 1;
  if (!writer || !writer->open(file.string(), spec) ||
      !writer->write_image(OIIO::TypeDesc::UINT8, rgba.data()) || !writer->close()) {
    throw std::runtime_error("cannot write " + file.string());
  }
}

// The triangle with this material, coordinates, and textures 0 and 1 of one pixel each.
class MaterialFile {
 public:
  explicit MaterialFile(const json& material, bool with_coordinates = true) : document_(triangle_document()) {
    write_pixel(folder_.path() / "0.png", {255, 51, 102, 204});
    write_pixel(folder_.path() / "1.png", {128, 128, 255, 255});
    json& primitive = document_["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    if (with_coordinates) {
      folder_.write("uv.bin", bytes_of<float>({0, 0, 1, 0, 0, 1}));
      document_["buffers"].push_back({{"byteLength", 24}, {"uri", "uv.bin"}});
      document_["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 24}});
      document_["accessors"].push_back(
          {{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
      primitive["attributes"]["TEXCOORD_0"] = 2;
    }
    document_["images"] = json::array({{{"uri", "0.png"}}, {{"uri", "1.png"}}});
    document_["textures"] = json::array({{{"source", 0}}, {{"source", 1}}});
    document_["materials"] = json::array({material});
  }

  Scene load() const { return load_scene(write_model(folder_, document_)); }
  Material material() const { return load().materials.at(0); }
  std::string error() const { return error_of(write_model(folder_, document_)); }

 private:
  TemporaryFolder folder_;
  json document_;
};

json with_extension(const char* name, const json& extension) {
  return {{"extensions", {{name, extension}}}};
}

json texture(int index) {
  return {{"index", index}};
}

TEST(GltfMaterials, AnEmptyExtensionAddsNothing) {
  // The defaults of each extension: strengths of 0, no attenuation.
  for (const char* name : {"KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy",
                           "KHR_materials_volume", "KHR_materials_specular"}) {
    const Material m = MaterialFile(with_extension(name, json::object())).material();
    EXPECT_FALSE(has_further_lobes(m)) << name;
    EXPECT_EQ(m.attenuation.distance_m, std::numeric_limits<float>::infinity());
    EXPECT_EQ(m.refractive_index, 1.5f);
    EXPECT_EQ(m.occlusion_texture.texture, -1);
  }
}

TEST(GltfMaterials, AClearCoatHasFactorsTexturesAndANormalOfItsOwn) {
  json coat = {{"clearcoatFactor", 0.5},
               {"clearcoatRoughnessFactor", 0.25},
               {"clearcoatTexture", texture(0)},
               {"clearcoatRoughnessTexture", texture(1)},
               {"clearcoatNormalTexture", {{"index", 1}, {"scale", -2}}}};
  const MaterialFile file(with_extension("KHR_materials_clearcoat", coat));
  const Scene scene = file.load();
  const Clearcoat& read = scene.materials.at(0).clearcoat;
  EXPECT_EQ(read.strength, 0.5f);
  EXPECT_EQ(read.roughness, 0.25f);
  EXPECT_EQ(read.normal_scale, -2.0f);
  ASSERT_GE(read.strength_texture.texture, 0);
  EXPECT_FALSE(scene.textures.at(static_cast<std::size_t>(read.strength_texture.texture)).srgb);
  EXPECT_EQ(read.roughness_texture.texture, read.normal_texture.texture) << "one picture, read alike";
  EXPECT_EQ(scene.meshes.at(0).tangents.size(), 3u) << "for the coat's normals";

  coat["clearcoatFactor"] = 0;
  const Scene without = MaterialFile(with_extension("KHR_materials_clearcoat", coat)).load();
  EXPECT_TRUE(without.textures.empty()) << "a coat of no strength reads none";
  EXPECT_TRUE(without.meshes.at(0).tangents.empty());
}

TEST(GltfMaterials, SheenHasAColourInSrgbAndARoughnessInAlpha) {
  const Scene scene =
      MaterialFile(with_extension("KHR_materials_sheen", {{"sheenColorFactor", {0.25, 0.5, 1}},
                                                          {"sheenRoughnessFactor", 0.75},
                                                          {"sheenColorTexture", texture(0)},
                                                          {"sheenRoughnessTexture", texture(0)}}))
          .load();
  const Sheen& sheen = scene.materials.at(0).sheen;
  EXPECT_EQ(sheen.colour, glm::vec3(0.25f, 0.5f, 1));
  EXPECT_EQ(sheen.roughness, 0.75f);
  EXPECT_TRUE(scene.textures.at(static_cast<std::size_t>(sheen.colour_texture.texture)).srgb);
  EXPECT_FALSE(scene.textures.at(static_cast<std::size_t>(sheen.roughness_texture.texture)).srgb);
}

TEST(GltfMaterials, AStretchedHighlightFollowsTangentsThatAreMadeWhereTheFileHasNone) {
  const json stretched =
      with_extension("KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.5}});
  const Scene scene = MaterialFile(stretched).load();
  EXPECT_EQ(scene.materials.at(0).anisotropy.strength, 0.5f);
  EXPECT_EQ(scene.materials.at(0).anisotropy.rotation_rad, 1.5f);
  // u grows along x.
  ASSERT_EQ(scene.meshes.at(0).tangents.size(), 3u);
  EXPECT_NEAR(scene.meshes.at(0).tangents[0].x, 1.0, 1e-6);
  EXPECT_TRUE(scene.warnings.empty());

  const Scene bare = MaterialFile(stretched, false).load();
  EXPECT_TRUE(bare.meshes.at(0).tangents.empty());
  EXPECT_TRUE(any_contains(bare.warnings, "neither tangents nor texture coordinates"));
}

TEST(GltfMaterials, ABodyAbsorbsWhereTheFileGivesItAThickness) {
  json volume = {
      {"thicknessFactor", 0.1}, {"attenuationDistance", 0.25}, {"attenuationColor", {0.5, 0.75, 1}}};
  const Material body = MaterialFile(with_extension("KHR_materials_volume", volume)).material();
  EXPECT_EQ(body.attenuation.distance_m, 0.25f);
  EXPECT_EQ(body.attenuation.colour, glm::vec3(0.5f, 0.75f, 1));
  // KHR_materials_volume: thickness 0 is a thin wall, with no medium inside.
  volume["thicknessFactor"] = 0;
  const Material wall = MaterialFile(with_extension("KHR_materials_volume", volume)).material();
  EXPECT_EQ(wall.attenuation.distance_m, std::numeric_limits<float>::infinity());
  // A file with a distance of 0, which the extension forbids, loaded before the extension was read.
  volume["thicknessFactor"] = 0.1;
  volume["attenuationDistance"] = 0;
  const Scene clear = MaterialFile(with_extension("KHR_materials_volume", volume)).load();
  EXPECT_EQ(clear.materials.at(0).attenuation.distance_m, std::numeric_limits<float>::infinity());
  EXPECT_TRUE(any_contains(clear.warnings, "KHR_materials_volume.attenuationDistance is 0"));
}

TEST(GltfMaterials, OcclusionHasATextureOfLinearValuesAndAStrength) {
  const Scene scene = MaterialFile(json{{"occlusionTexture", {{"index", 0}, {"strength", 0.5}}}}).load();
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.occlusion_strength, 0.5f);
  ASSERT_EQ(m.occlusion_texture.texture, 0);
  EXPECT_FALSE(scene.textures.at(0).srgb);
  EXPECT_TRUE(
      MaterialFile(json{{"occlusionTexture", {{"index", 0}, {"strength", 0}}}}).load().textures.empty());
  const Scene strong = MaterialFile(json{{"occlusionTexture", {{"index", 0}, {"strength", 2}}}}).load();
  EXPECT_EQ(strong.materials.at(0).occlusion_strength, 1.0f) << "it was passed over before";
  EXPECT_TRUE(any_contains(strong.warnings, "strength"));
}

TEST(GltfMaterials, IndexZeroIsAMirrorThatNothingPasses) {
  json material = with_extension("KHR_materials_ior", {{"ior", 0}});
  material["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 0}};
  const Material mirror = MaterialFile(material).material();
  EXPECT_EQ(mirror.refractive_index, 0.0f);
  EXPECT_TRUE(may_mirror(mirror)) << "F0 is 1, and the surface is smooth";
  material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
  const Scene clear = MaterialFile(material).load();
  EXPECT_EQ(clear.materials.at(0).transmission, 0.0f);
  EXPECT_TRUE(any_contains(clear.warnings, "index 0"));
}

TEST(GltfMaterials, SpecularGlossinessStandsInWhereItIsAllThereIs) {
  json material =
      with_extension("KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.5, 0.25, 1, 0.75}},
                                                             {"specularFactor", {0.25, 0.5, 0.125}},
                                                             {"glossinessFactor", 0.75}});
  material["alphaMode"] = "BLEND";
  const Material m = MaterialFile(material).material();
  EXPECT_EQ(m.base_colour, glm::vec3(0.5f, 0.25f, 1));
  EXPECT_EQ(m.alpha, 0.75f);
  EXPECT_EQ(m.metallic, 0.0f);
  EXPECT_EQ(m.roughness, 0.25f);
  // F0 = F0 of index 0 (1) x colour x strength.
  EXPECT_EQ(m.refractive_index, 0.0f);
  EXPECT_EQ(m.specular_colour, glm::vec3(0.25f, 0.5f, 0.125f));
  EXPECT_EQ(m.specular, 1.0f);

  material["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 0, 0, 1}}, {"roughnessFactor", 0.5}};
  const Material newer = MaterialFile(material).material();
  EXPECT_EQ(newer.base_colour, glm::vec3(1, 0, 0));
  EXPECT_EQ(newer.roughness, 0.5f);
  EXPECT_EQ(newer.refractive_index, 1.5f);
}

TEST(GltfMaterials, TexturesOfSpecularGlossinessBecomeColourAndRoughness) {
  const Scene scene = MaterialFile(with_extension("KHR_materials_pbrSpecularGlossiness",
                                                  {{"diffuseTexture", texture(1)},
                                                   {"glossinessFactor", 0.5},
                                                   {"specularGlossinessTexture", texture(0)}}))
                          .load();
  const Material& m = scene.materials.at(0);
  EXPECT_TRUE(scene.textures.at(static_cast<std::size_t>(m.base_colour_texture)).srgb);
  const TextureImage& specular =
      scene.textures.at(static_cast<std::size_t>(m.specular_colour_texture.texture));
  EXPECT_TRUE(specular.srgb);
  EXPECT_EQ(specular.rgba[1], 51);
  const TextureImage& rough = scene.textures.at(static_cast<std::size_t>(m.metallic_roughness_texture));
  EXPECT_FALSE(rough.srgb);
  // Alpha is 204 of 255: glossiness 0.5 x 0.8 = 0.4, roughness 0.6 = 153 of 255.
  EXPECT_EQ(rough.rgba[1], 153);
  EXPECT_EQ(m.roughness, 1.0f);
}

TEST(GltfMaterials, FactorsThatAnExporterRoundedAndEmissionOfOldFilesAreClampedWithAWarning) {
  const Scene rounded =
      MaterialFile(json{{"pbrMetallicRoughness", {{"baseColorFactor", {1.0000001192092896, 1, 1, 1}}}}})
          .load();
  EXPECT_EQ(rounded.materials.at(0).base_colour, glm::vec3(1.0f));
  EXPECT_TRUE(any_contains(rounded.warnings, "baseColorFactor"));
  const Scene bright = MaterialFile(json{{"emissiveFactor", {2.5, 0.5, 0}}}).load();
  EXPECT_EQ(bright.materials.at(0).emission, glm::vec3(1, 0.5f, 0));
  EXPECT_TRUE(any_contains(bright.warnings, "emissiveFactor"));
  EXPECT_TRUE(contains(MaterialFile(json{{"pbrMetallicRoughness", {{"metallicFactor", 1.5}}}}).error(),
                       "metallicFactor"));
}

TEST(GltfMaterials, OverridesDrawTheNumberThatTheyGive) {
  const Material unlit = MaterialFile(with_extension("KHR_materials_unlit", json::object())).material();
  MaterialOverride glow;
  glow.emission = glm::vec3(2, 1, 0);
  const Material lamp = glow.apply(unlit);
  EXPECT_FALSE(lamp.unlit) << "or its base colour would still be what is seen";
  EXPECT_EQ(lamp.emission, glm::vec3(2, 1, 0));
  EXPECT_EQ(lamp.base_colour, glm::vec3(0));
  EXPECT_EQ(lamp.specular, 0.0f);

  MaterialOverride polish;
  polish.roughness = 0.0f;
  polish.metallic = 1.0f;
  EXPECT_FALSE(may_mirror(polish.apply(unlit))) << "an unlit surface reflects nothing";
  Material rough = MaterialFile(json{{"pbrMetallicRoughness", {{"roughnessFactor", 1}}}}).material();
  EXPECT_FALSE(may_mirror(rough));
  EXPECT_TRUE(may_mirror(polish.apply(rough)));
  polish.mirror = 0.0f;
  EXPECT_FALSE(may_mirror(polish.apply(rough))) << "a factor that is written is what is drawn";
}

}  // namespace
}  // namespace herr::test
