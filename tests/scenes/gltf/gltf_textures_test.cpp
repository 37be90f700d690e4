// Materials and textures of glTF files: factors, colour spaces, channels, wrap modes,
// and images that are wrong.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "scenes/load_scene.h"
#include "sessions/files/input_error.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

// Writes a picture; 1 ... 4 channels of 8 bits.
void write_picture(const std::filesystem::path& file, int width, int height, int channels,
                   const std::vector<std::uint8_t>& values) {
  const auto writer = OIIO::ImageOutput::create(file.string());
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
  spec["oiio:UnassociatedAlpha"] = 1;  // the values are stored as they stand
  if (!writer || !writer->open(file.string(), spec) ||
      !writer->write_image(OIIO::TypeDesc::UINT8, values.data()) || !writer->close()) {
    throw std::runtime_error("cannot write " + file.string());
  }
}

// A triangle with coordinates and a material whose base colour texture is image 0.
json textured_document() {
  json document = triangle_document();
  document["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 24}});
  document["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_0"] = 2;
  primitive["material"] = 0;
  document["materials"] =
      json::array({{{"name", "paint"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  document["textures"] = json::array({{{"source", 0}, {"sampler", 0}}});
  document["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33648}}});
  document["images"] = json::array({{{"uri", "a%20picture.png"}}});
  return document;
}

TEST(GltfTextures, ChannelsOfEveryNumberBecomeRgbaWithoutMultiplyingAlphaIn) {
  const std::vector<std::pair<std::vector<std::uint8_t>, std::vector<std::uint8_t>>> cases{
      {{10, 200}, {10, 10, 10, 255, 200, 200, 200, 255}},
      {{10, 0, 200, 128}, {10, 10, 10, 0, 200, 200, 200, 128}},
      {{1, 2, 3, 4, 5, 6}, {1, 2, 3, 255, 4, 5, 6, 255}},
      {{255, 2, 3, 0, 250, 5, 6, 7}, {255, 2, 3, 0, 250, 5, 6, 7}}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const TemporaryFolder folder;
    const auto file = write_model(folder, textured_document());
    write_picture(folder.path() / "a picture.png", 2, 1, static_cast<int>(i) + 1, cases[i].first);
    const Scene scene = load_scene(file);
    ASSERT_EQ(scene.textures.size(), 1u) << i;
    EXPECT_EQ(scene.textures[0].rgba, cases[i].second) << i;
    EXPECT_TRUE(scene.textures[0].srgb);
    EXPECT_EQ(scene.textures[0].wrap_u, TextureWrap::clamp);
    EXPECT_EQ(scene.textures[0].wrap_v, TextureWrap::mirror);
    EXPECT_EQ(scene.meshes.at(0).uvs.size(), 3u);
    EXPECT_EQ(scene.materials.at(scene.instances.at(0).material).base_colour_texture, 0);
  }
}

TEST(GltfTextures, AnImageUsedForColourAndForRoughnessIsTwoTextures) {
  const TemporaryFolder folder;
  json document = textured_document();
  document["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
  const auto file = write_model(folder, document);
  // G = 0 and B = 255: a smooth metal, which mirrors.
  write_picture(folder.path() / "a picture.png", 1, 1, 3, {7, 0, 255});
  const Scene scene = load_scene(file);
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_TRUE(scene.textures[0].srgb);
  EXPECT_FALSE(scene.textures[1].srgb);
  EXPECT_EQ(scene.materials.at(0).metallic_roughness_texture, 1);
  EXPECT_EQ(scene.materials.at(0).smoothest_texel, 0.0f);
  EXPECT_TRUE(may_mirror(scene.materials.at(0)));
}

TEST(GltfTextures, WithoutPixelsASceneHasTheSameSizesMirrorsAndRefusals) {
  for (const char* name : {"a picture.png", "a picture.jpg"}) {
    const TemporaryFolder folder;
    json document = textured_document();
    document["images"][0]["uri"] = name;
    document["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
    const auto file = write_model(folder, document);
    write_picture(folder.path() / name, 3, 2, 3,
                  {7, 0, 255, 7, 0, 255, 7, 0, 255, 7, 0, 255, 7, 0, 255, 7, 0, 255});
    const Scene whole = load_scene(file), described = load_scene(file, TexturePixels::left_out);
    ASSERT_EQ(described.textures.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(described.textures[i].width_px, 3);
      EXPECT_EQ(described.textures[i].height_px, 2);
      EXPECT_EQ(whole.textures[i].rgba.size(), 24u);
      EXPECT_TRUE(described.textures[i].rgba.empty());
    }
    EXPECT_EQ(described.materials.at(0).smoothest_texel, whole.materials.at(0).smoothest_texel);
    EXPECT_EQ(may_mirror(described.materials.at(0)), may_mirror(whole.materials.at(0)));
    std::filesystem::resize_file(folder.path() / name, 40);
    for (const TexturePixels pixels : {TexturePixels::decoded, TexturePixels::left_out})
      EXPECT_THROW((void)load_scene(file, pixels), InputError) << name;
  }
}

TEST(GltfTextures, WithoutCoordinatesTheTextureIsLeftOutWithAWarning) {
  const TemporaryFolder folder;
  json document = textured_document();
  document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  const auto file = write_model(folder, document);
  folder.write("a picture.png", "no picture at all");  // nothing asks for its pixels
  const Scene scene = load_scene(file);
  EXPECT_EQ(scene.materials.at(0).base_colour_texture, -1);
  EXPECT_TRUE(scene.textures.empty());
  EXPECT_TRUE(scene.meshes.at(0).uvs.empty());
  EXPECT_TRUE(any_contains(scene.warnings, "no texture coordinates"));
}

TEST(GltfTextures, NormalisedCoordinatesReachOne) {
  const TemporaryFolder folder;
  json document = textured_document();
  folder.write("uv.bin", bytes_of<std::uint16_t>({0, 65535, 65535, 0, 0, 0}));
  document["buffers"].push_back({{"byteLength", 12}, {"uri", "uv.bin"}});
  document["bufferViews"][2] = {{"buffer", 1}, {"byteLength", 12}};
  document["accessors"][2]["componentType"] = 5123;
  document["accessors"][2]["normalized"] = true;
  const auto file = write_model(folder, document);
  write_picture(folder.path() / "a picture.png", 1, 1, 3, {1, 2, 3});
  const Scene scene = load_scene(file);
  EXPECT_EQ(scene.meshes.at(0).uvs.at(0), glm::vec2(0, 1));
  EXPECT_EQ(scene.meshes.at(0).uvs.at(1), glm::vec2(1, 0));
}

// CRC-32 of PNG chunks, bit by bit (polynomial 0xEDB88320).
std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = ~0u;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
          static_cast<char>(value)};
}

// A PNG that declares a size and then holds an empty data chunk.
std::string png_header(std::uint32_t width, std::uint32_t height) {
  const std::string header =
      "IHDR" + big_endian(width) + big_endian(height) + std::string("\x08\x06\x00\x00\x00", 5);
  const std::string data = "IDAT";
  return "\x89PNG\r\n\x1a\n" + big_endian(13) + header + big_endian(crc_of(header)) + big_endian(0) + data +
         big_endian(crc_of(data));
}

TEST(GltfTextures, WrongImagesAreInputErrorsThatNameTheModel) {
  const TemporaryFolder folder;
  const auto file = write_model(folder, textured_document());
  const auto message = [&](const std::string& content) {
    folder.write("a picture.png", content);
    return error_of(file);
  };
  EXPECT_TRUE(contains(error_of(file), "a picture.png")) << error_of(file);
  EXPECT_TRUE(contains(message(""), "is empty"));
  EXPECT_TRUE(contains(message("GIF89a and so on"), "neither PNG nor JPEG"));
  EXPECT_TRUE(contains(message(png_header(65535, 65535)), "too big"));
  EXPECT_TRUE(contains(message(png_header(16000, 16000)), "too big"));
  EXPECT_TRUE(contains(message(png_header(64, 64)), "cannot be decoded"));
  EXPECT_TRUE(contains(message("\xff\xd8\xff\xe0garbage"), "cannot be decoded"));

  // Noise does not compress, so that half of the file is half of the rows.
  std::vector<std::uint8_t> noise(64 * 64 * 3);
  std::uint32_t state = 1;
  for (auto& value : noise) value = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  write_picture(folder.path() / "a picture.png", 64, 64, 3, noise);
  std::ifstream stream(folder.path() / "a picture.png", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_EQ(error_of(file), "");
  EXPECT_TRUE(contains(message(whole.substr(0, whole.size() / 2)), "cut off"));
}

TEST(GltfTextures, AJpegIsRead) {
  const TemporaryFolder folder;
  const auto file = write_model(folder, textured_document());
  write_picture(folder.path() / "picture.jpg", 8, 8, 3, std::vector<std::uint8_t>(192, 128));
  // The content decides, not the name.
  std::filesystem::rename(folder.path() / "picture.jpg", folder.path() / "a picture.png");
  const Scene scene = load_scene(file);
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].width_px, 8);
  // A constant grey survives the cosine transform; the coefficient is quantised in steps of at
  // most 16 / 8 grey levels.
  EXPECT_NEAR(scene.textures[0].rgba[0], 128, 2);
}

TEST(GltfTextures, FactorsEmissionAndUnlitArrive) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["materials"] = json::array(
      {{{"emissiveFactor", {1, 0.5, 0}},
        {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {0.25, 0.5, 0.75, 1}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.125}}}}});
  document["extensionsRequired"] = {"KHR_materials_emissive_strength"};
  const Material lit = load_scene(write_model(folder, document)).materials.at(0);
  EXPECT_EQ(lit.base_colour, glm::vec3(0.25f, 0.5f, 0.75f));
  EXPECT_EQ(lit.metallic, 0.5f);
  EXPECT_EQ(lit.roughness, 0.125f);
  EXPECT_EQ(lit.emission, glm::vec3(4, 2, 0));

  document["materials"][0]["extensions"] = {{"KHR_materials_unlit", json::object()}};
  const Material unlit = load_scene(write_model(folder, document)).materials.at(0);
  EXPECT_TRUE(unlit.unlit);
  EXPECT_EQ(unlit.base_colour, glm::vec3(0.25f, 0.5f, 0.75f));
  EXPECT_EQ(unlit.emission, glm::vec3(0)) << "its colour is all that it shows";
  EXPECT_FALSE(may_mirror(unlit));
}

}  // namespace
}  // namespace herr::test
