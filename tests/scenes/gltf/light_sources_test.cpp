// Lights of scene documents and glTF files (KHR_lights_punctual), glass (KHR_materials_transmission, _ior),
// and pictures of the environment.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

json document_with_light(const json& light) {
  return {{"format_version", 1}, {"name", "lit"}, {"lights", json::array({light})}};
}

TEST(LightSources, ADocumentsSpotAndSunAreReadWithUnitDirectionsAndRadians) {
  const TemporaryFolder folder;
  const auto spot =
      load_scene(folder.write("spot.scene.json", document_with_light({{"kind", "spot"},
                                                                      {"centre", {1, 2, 3}},
                                                                      {"intensity_w_sr", {4, 5, 6}},
                                                                      {"direction", {0, -3, 4}},
                                                                      {"inner_cone_deg", 15},
                                                                      {"outer_cone_deg", 30},
                                                                      {"range_m", 7}})
                                                     .dump()))
          .lights.at(0);
  EXPECT_EQ(spot.kind, LightKind::spot);
  EXPECT_EQ(spot.direction, glm::dvec3(0, -0.6, 0.8));
  EXPECT_NEAR(spot.inner_cone_rad, 0.2617993877991494, 1e-15);
  EXPECT_NEAR(spot.outer_cone_rad, 0.5235987755982988, 1e-15);
  EXPECT_EQ(spot.range_m, 7);
  const auto sun =
      load_scene(folder.write("sun.scene.json", document_with_light({{"kind", "sun"},
                                                                     {"irradiance_w_m2", {1, 2, 3}},
                                                                     {"direction", {0, -2, 0}}})
                                                    .dump()))
          .lights.at(0);
  EXPECT_EQ(sun.kind, LightKind::sun);
  EXPECT_EQ(sun.direction, glm::dvec3(0, -1, 0));
  EXPECT_EQ(sun.intensity_w_sr, glm::vec3(1, 2, 3));
}

TEST(LightSources, WhatMeansNothingForAKindOfLightIsRefusedByName) {
  const TemporaryFolder folder;
  const json box{{"centre", {0, 0, 0}}, {"intensity_w_sr", {1, 1, 1}}};
  const json spot{
      {"kind", "spot"}, {"centre", {0, 0, 0}}, {"intensity_w_sr", {1, 1, 1}}, {"direction", {0, -1, 0}}};
  const json sun{{"kind", "sun"}, {"irradiance_w_m2", {1, 1, 1}}, {"direction", {0, -1, 0}}};
  struct Case {
    json light;
    const char *field, *problem;
  };
  const auto with = [](json light, const char* key, const json& value) {
    light[key] = value;
    return light;
  };
  for (const Case& c : {Case{with(box, "kind", "lamp"), "kind", "lamp"},
                        Case{with(box, "direction", {0, -1, 0}), "direction", "means nothing"},
                        Case{with(spot, "size", {1, 1, 1}), "size", "means nothing"},
                        Case{with(sun, "centre", {1, 1, 1}), "centre", "means nothing"},
                        Case{with(sun, "range_m", 3), "range_m", "means nothing"},
                        Case{with(sun, "direction", {0, 0, 0}), "direction", "is 0"},
                        Case{with(spot, "inner_cone_deg", 60), "inner_cone_deg", "not below"},
                        Case{with(spot, "outer_cone_deg", 91), "outer_cone_deg", "90"}}) {
    const std::string error = error_of(folder.write("bad.scene.json", document_with_light(c.light).dump()));
    EXPECT_TRUE(contains(error, c.field) && contains(error, c.problem)) << c.light.dump() << ": " << error;
  }
}

json document_with_gltf_light(const json& light) {
  json document = triangle_document();
  document["extensionsUsed"] = {"KHR_lights_punctual"};
  document["extensions"]["KHR_lights_punctual"]["lights"] = json::array({light});
  // A node turned by 90 degrees about x (-Z becomes +Y... of the parent: (0, 1, 0)), under one that is moved
  // and twice as large.
  document["nodes"] = json::parse(R"([
    {"name": "node", "mesh": 0, "scale": [2, 2, 2], "translation": [1, 2, 3], "children": [1]},
    {"name": "lamp", "translation": [0, 1, 0], "rotation": [0.70710678118, 0, 0, 0.70710678118],
     "extensions": {"KHR_lights_punctual": {"light": 0}}}])");
  return document;
}

TEST(LightSources, AGltfsLightStandsWhereItsNodePutsItAndShinesAlongMinusZ) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(
      folder, document_with_gltf_light({{"type", "spot"},
                                        {"color", {1, 0.5, 0}},
                                        {"intensity", 8},
                                        {"range", 5},
                                        {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}})));
  // The file's own light alone: no second one is put above it.
  ASSERT_EQ(scene.lights.size(), 1u);
  const AreaLight& light = scene.lights[0];
  EXPECT_EQ(light.kind, LightKind::spot);
  EXPECT_EQ(light.name, "lamp");
  EXPECT_EQ(light.centre, glm::dvec3(1, 4, 3));  // 1, 2, 3 + 2 * (0, 1, 0)
  EXPECT_NEAR(glm::length(light.direction - glm::dvec3(0, 1, 0)), 0, 1e-9);
  EXPECT_EQ(light.intensity_w_sr, glm::vec3(8, 4, 0));
  EXPECT_EQ(light.range_m, 5);  // a range does not scale with its node
  EXPECT_EQ(light.inner_cone_rad, 0.1);
  EXPECT_EQ(light.outer_cone_rad, 0.2);
  EXPECT_FALSE(any_contains(scene.warnings, "KHR_lights_punctual"));
}

TEST(LightSources, AGltfsLightsMoveWithTheEntryOfADocument) {
  const TemporaryFolder folder;
  write_model(folder, document_with_gltf_light({{"type", "point"}}));
  const Scene scene = load_scene(folder.write(
      "lit.scene.json",
      R"({"format_version": 1, "name": "lit", "gltf": [{"file": "model.gltf", "translation": [10, 0, 0]},
                            {"file": "model.gltf", "translation": [20, 0, 0]}]})"));
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].centre, glm::dvec3(11, 4, 3));
  EXPECT_EQ(scene.lights[1].centre, glm::dvec3(21, 4, 3));
  EXPECT_EQ(scene.lights[0].kind, LightKind::box);
}

TEST(LightSources, ALightIsVirtualWhereTheDocumentOrTheEntryOfItsFileSaysSo) {
  const TemporaryFolder folder;
  write_model(folder, document_with_gltf_light({{"type", "point"}}));
  const Scene scene = load_scene(folder.write("lit.scene.json", R"({"format_version": 1, "name": "lit",
    "lights": [{"name": "neon", "centre": [0, 1, 0], "intensity_w_sr": [0, 9, 0], "virtual": true},
               {"name": "lamp", "centre": [0, 3, 0], "intensity_w_sr": [9, 9, 9]}],
    "gltf": [{"file": "model.gltf", "virtual_lights": true}, {"file": "model.gltf"}]})"));
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_TRUE(scene.lights[0].is_virtual);
  EXPECT_FALSE(scene.lights[1].is_virtual);
  EXPECT_TRUE(scene.lights[2].is_virtual);
  EXPECT_FALSE(scene.lights[3].is_virtual);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_TRUE(contains(
      error_of(folder.write(
          "bad.scene.json",
          document_with_light({{"centre", {0, 0, 0}}, {"intensity_w_sr", {1, 1, 1}}, {"vitrual", true}})
              .dump())),
      "virtual"));
}

TEST(LightSources, AFileWithoutLightsHasNoneThatCouldBeVirtual) {
  const TemporaryFolder folder;
  write_model(folder, triangle_document());
  const Scene scene = load_scene(folder.write("lit.scene.json", R"({"format_version": 1, "name": "lit",
    "gltf": [{"file": "model.gltf", "virtual_lights": true}]})"));
  EXPECT_TRUE(any_contains(scene.warnings, "virtual_lights means nothing"));
}

TEST(LightSources, VirtualLightAloneOverARealSurfaceIsAWarningThatSaysWhatTheFeedCountsAs) {
  const TemporaryFolder folder;
  const auto warnings = [&](const json& lights, double ambient) {
    const json document{{"format_version", 1},
                        {"name", "lit"},
                        {"ambient", {ambient, ambient, ambient}},
                        {"catchers", json::array({{{"box", {{"min", {-1, -1, -1}}, {"max", {1, 0, 1}}}}}})},
                        {"lights", lights}};
    return load_scene(folder.write("lit.scene.json", document.dump())).warnings;
  };
  const json lamp{{"centre", {0, 2, 0}}, {"intensity_w_sr", {1, 1, 1}}};
  json neon = lamp;
  neon["virtual"] = true;
  EXPECT_TRUE(warnings(json::array({lamp, neon}), 0).empty());
  EXPECT_TRUE(any_contains(warnings(json::array({neon, neon}), 0), "by the catchers' stated colours"));
  EXPECT_TRUE(any_contains(warnings(json::array({neon}), 0.1), "counts as lit by ambient alone"));
}

TEST(LightSources, AnUnknownTypeOfLightInAGltfDoesNotShineAndIsToldOf) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(folder, document_with_gltf_light({{"type", "area"}})));
  EXPECT_TRUE(any_contains(scene.warnings, "\"area\""));
  EXPECT_EQ(scene.lights.at(0).intensity_w_sr, glm::vec3(0.0f));
}

TEST(LightSources, WrongLightsOfAGltfAreRefused) {
  const TemporaryFolder folder;
  for (const json& light :
       {json{{"type", "point"}, {"intensity", -1}}, json{{"type", "spot"}},
        json{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.4}}}},
        json{{"type", "point"}, {"color", {1, 1}}}}) {
    const std::string error = error_of(write_model(folder, document_with_gltf_light(light)));
    // tinygltf itself refuses a spot without its cone.
    EXPECT_TRUE(contains(error, "lights[0]") || contains(error, "Spot light")) << light.dump() << error;
  }
  json dangling = document_with_gltf_light({{"type", "point"}});
  dangling["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 1;
  EXPECT_TRUE(contains(error_of(write_model(folder, dangling)), "light"))
      << "index of a light that is not there";
}

json glass_document(const json& transmission, const json& ior) {
  json document = triangle_document();
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["materials"] = json::array(
      {{{"name", "glass"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0}}}}});
  json& extensions = document["materials"][0]["extensions"];
  extensions["KHR_materials_transmission"]["transmissionFactor"] = transmission;
  extensions["KHR_materials_ior"]["ior"] = ior;
  document["extensionsRequired"] = {"KHR_materials_transmission", "KHR_materials_ior"};
  return document;
}

TEST(LightSources, GlassOfAGltfIsTransparentAndMirrors) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(folder, glass_document(0.75, 1.33)));
  const Material& glass = scene.materials.at(scene.instances.at(0).material);
  EXPECT_EQ(glass.transmission, 0.75f);
  EXPECT_EQ(glass.refractive_index, 1.33f);
  EXPECT_TRUE(may_mirror(glass)) << "smooth: the clear share of it mirrors, by Fresnel";
  EXPECT_TRUE(contains(error_of(write_model(folder, glass_document(1.5, 1.33))), "transmissionFactor"));
  EXPECT_TRUE(contains(error_of(write_model(folder, glass_document(1, 0.5))), "ior"));
}

// A float picture by OpenImageIO: .hdr or .exr.
void write_picture(const std::filesystem::path& file, int width, int height, const std::vector<float>& rgb) {
  const auto writer = OIIO::ImageOutput::create(file.string());
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", std::string("zip"));
  if (!writer || !writer->open(file.string(), spec) ||
      !writer->write_image(OIIO::TypeDesc::FLOAT, rgb.data()) || !writer->close()) {
    throw std::runtime_error("cannot write " + file.string());
  }
}

std::string environment_document(const std::string& file, const std::string& more = "") {
  return R"({"format_version": 1, "name": "outside", "environment_map": {"file": ")" + file + "\"" + more +
         "}}";
}

TEST(LightSources, AnEnvironmentPictureIsReadScaledAndTurned) {
  const TemporaryFolder folder;
  // Values that RGBE and half hold exactly.
  const std::vector<float> rgb{1, 2, 4, 0.5f, 0.25f, 8, 16, 0, 1, 1, 1, 1};
  for (const char* name : {"sky.hdr", "sky.exr"}) {
    write_picture(folder.path() / name, 2, 2, rgb);
    const Scene scene = load_scene(
        folder.write("s.scene.json", environment_document(name, R"(, "scale": 2, "turn_deg": 30)")));
    ASSERT_EQ(scene.environment_map.width_px, 2) << name;
    ASSERT_EQ(scene.environment_map.rgba.size(), 16u);
    EXPECT_EQ(scene.environment_map.turn_deg, 30);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(scene.environment_map.rgba[4 * i + c], 2 * rgb[3 * i + c]) << name;
    }
    EXPECT_EQ(scene.files.back().filename(), name);
  }
}

TEST(LightSources, ADamagedEnvironmentPictureIsRefusedWithItsName) {
  const TemporaryFolder folder;
  write_picture(folder.path() / "whole.hdr", 64, 32, std::vector<float>(3 * 64 * 32, 0.7f));
  std::ifstream stream(folder.path() / "whole.hdr", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  const std::string document = environment_document("cut.hdr");
  for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 40) {
    folder.write("cut.hdr", bytes.substr(0, length));
    const std::string error = error_of(folder.write("s.scene.json", document));
    EXPECT_TRUE(contains(error, "cut.hdr")) << "cut at " << length << " of " << bytes.size() << ": " << error;
  }
  EXPECT_TRUE(contains(error_of(folder.write("s.scene.json", environment_document("../sky.hdr"))), "file"));
  EXPECT_TRUE(
      contains(error_of(folder.write("s.scene.json", environment_document("none.hdr"))), "does not exist"));
  EXPECT_TRUE(contains(error_of(folder.write("both.scene.json",
                                             R"({"format_version": 1, "name": "b", "environment": [1, 1, 1],
                                                "environment_map": {"file": "cut.hdr"}})")),
                       "environment_map"));
}

TEST(LightSources, AnEnvironmentThatClaimsABillionPixelsIsRefusedBeforeMemoryIsTaken) {
  const TemporaryFolder folder;
  folder.write("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 80000\n");
  EXPECT_TRUE(
      contains(error_of(folder.write("s.scene.json", environment_document("huge.hdr"))), "80000 x 40000"));
}

}  // namespace
}  // namespace herr::test
