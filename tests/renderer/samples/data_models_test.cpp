// Models of other people, rendered small: no NaN, a picture and not one colour. Where HERR_CONTACT_SHEETS
// names a folder, contact sheets to look at are written there, those of the asset generator with its own
// pictures beside ours.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "scenes/load_scene.h"
#include "sessions/files/input_error.h"
#include "tests/paths.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr int kSide = 96;
constexpr double kHalfView_deg = 22.5;
using Picture = std::array<std::array<test::Pixel, kSide>, kSide>;  // linear light

std::filesystem::path models_folder(const std::string& name) {
  const char* folder = std::getenv("HERR_TEST_DATA");
  const std::filesystem::path data = folder != nullptr
                                         ? std::filesystem::path(folder)
                                         : std::filesystem::path(test::source_dir()) / "../shared/data";
  return data / "models" / name;
}

// Rows of sRGB pictures, kSide each.
class ContactSheet {
 public:
  explicit ContactSheet(int columns) : columns_(columns) {}

  void add(const Picture& picture) {
    OIIO::ImageBuf tile(OIIO::ImageSpec(kSide, kSide, 3, OIIO::TypeDesc::FLOAT));
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        float rgb[3];
        for (std::size_t c = 0; c < 3; ++c) {
          const double v =
              std::clamp(picture[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)][c], 0.0, 1.0);
          rgb[c] = static_cast<float>(v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
        }
        tile.setpixel(x, y, rgb, 3);
      }
    }
    tiles_.push_back(std::move(tile));
  }
  // A picture of any size; grey where it cannot be read (an animation, say).
  void add(const std::filesystem::path& file) {
    OIIO::ImageBuf whole(file.string());
    OIIO::ImageBuf tile(OIIO::ImageSpec(kSide, kSide, 3, OIIO::TypeDesc::FLOAT));
    const float grey[3] = {0.5f, 0.5f, 0.5f};
    OIIO::ImageBufAlgo::fill(tile, grey);
    if (whole.read(0, 0, true, OIIO::TypeDesc::FLOAT) && whole.nchannels() >= 3) {
      const int channels[3] = {0, 1, 2};
      const OIIO::ImageBuf rgb = OIIO::ImageBufAlgo::channels(whole, 3, channels);
      tile = OIIO::ImageBufAlgo::resize(rgb, "box", 0, OIIO::ROI(0, kSide, 0, kSide, 0, 1, 0, 3));
    }
    tiles_.push_back(std::move(tile));
  }
  void write(const std::string& name) const {
    const char* folder = std::getenv("HERR_CONTACT_SHEETS");
    if (folder == nullptr || tiles_.empty()) return;
    const int rows = (static_cast<int>(tiles_.size()) + columns_ - 1) / columns_;
    OIIO::ImageBuf sheet(
        OIIO::ImageSpec(columns_ * (kSide + 2), rows * (kSide + 2), 3, OIIO::TypeDesc::FLOAT));
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const int column = static_cast<int>(i) % columns_, row = static_cast<int>(i) / columns_;
      OIIO::ImageBufAlgo::paste(sheet, column * (kSide + 2), row * (kSide + 2), 0, 0, tiles_[i]);
    }
    const std::string file = (std::filesystem::path(folder) / name).string();
    EXPECT_TRUE(sheet.write(file, OIIO::TypeDesc::UINT8)) << sheet.geterror();
  }

 private:
  int columns_;
  std::vector<OIIO::ImageBuf> tiles_;
};

// Half the longest diagonal of what is shown, about its middle.
struct Subject {
  glm::dvec3 middle;
  double radius;
};
Subject subject_of(const Scene& scene) {
  const Bounds bounds = scene_bounds(scene);
  return {0.5 * (bounds.lower + bounds.upper),
          std::max(0.5 * glm::length(bounds.upper - bounds.lower), 1e-6)};
}

// Planar pictures of one scene.
class Camera {
 public:
  Camera(const Scene& scene, double half_view_deg)
      : scene_(scene),
        renderer_(scene, test::single_view(kSide, kSide, half_view_deg, half_view_deg),
                  test::planar_settings(), false) {}

  Picture picture(const glm::dvec3& eye, const glm::dvec3& target) {
    FrameSample sample = test::sample_from(eye);
    const glm::dmat4 eye_from_world = glm::lookAt(eye, target, glm::dvec3(0, 1, 0));
    sample.head.world_from_head.orientation = glm::conjugate(glm::quat_cast(glm::dmat3(eye_from_world)));
    RenderedFrame frame;
    test::render_with(renderer_, scene_, sample, frame);
    test::expect_finite(frame);
    Picture picture;
    test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
      picture[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = pixel;
    });
    return picture;
  }

 private:
  const Scene& scene_;
  Renderer renderer_;
};

Picture picture_of(const Scene& scene, const glm::dvec3& eye, const glm::dvec3& target,
                   double half_view_deg) {
  return Camera(scene, half_view_deg).picture(eye, target);
}

// More than one colour, by more than a step of 8 bits.
bool shows_something(const Picture& picture) {
  for (const auto& row : picture) {
    for (const test::Pixel& pixel : row) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (std::abs(pixel[c] - picture[0][0][c]) > 1.0 / 255) return true;
      }
    }
  }
  return false;
}

// For looking at shapes: a sun over the viewer's shoulder and light all around.
void light_for_looking(Scene& scene, const glm::dvec3& towards) {
  scene.lights.clear();
  AreaLight sun;
  sun.kind = LightKind::sun;
  sun.direction = glm::normalize(towards + glm::dvec3(0.3, -0.6, 0));
  sun.intensity_w_sr = glm::vec3(2.0f);
  scene.lights.push_back(sun);
  scene.ambient = glm::vec3(0.35f);
  scene.environment = glm::vec3(0.08f);
}

// A reference picture of any size, in linear light; none where it cannot be read (an animation, say).
std::optional<Picture> read_picture(const std::filesystem::path& file) {
  OIIO::ImageBuf whole(file.string());
  if (!whole.read(0, 0, true, OIIO::TypeDesc::FLOAT) || whole.nchannels() < 3) return std::nullopt;
  const OIIO::ImageBuf small = OIIO::ImageBufAlgo::resize(whole, "box", 0, OIIO::ROI(0, kSide, 0, kSide));
  Picture picture;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      float rgb[3];
      small.getpixel(x, y, rgb, 3);
      for (std::size_t c = 0; c < 3; ++c) {
        const double v = rgb[c];
        picture[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)][c] =
            v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
      }
    }
  }
  return picture;
}

// How two pictures of one model under different lights agree: the outline, as what both show over what either
// shows before its own background, and how far the chromaticities of what both show lie apart (a mean over
// channels that sum up to 1).
struct Likeness {
  double outline = 0, hue = 0;
};
bool differs(const test::Pixel& p, const test::Pixel& q) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (std::abs(std::sqrt(std::max(p[c], 0.0)) - std::sqrt(std::max(q[c], 0.0))) > 0.04) return true;
  }
  return false;
}
Likeness likeness(const Picture& ours, const Picture& theirs, const Picture& their_background) {
  int both = 0, either = 0, hues = 0;
  double distance = 0;
  for (std::size_t y = 0; y < kSide; ++y) {
    for (std::size_t x = 0; x < kSide; ++x) {
      const test::Pixel &p = ours[y][x], &q = theirs[y][x];
      const bool in_ours = differs(p, ours[0][0]), in_theirs = differs(q, their_background[y][x]);
      either += in_ours || in_theirs ? 1 : 0;
      if (!in_ours || !in_theirs) continue;
      ++both;
      const double sum_p = p[0] + p[1] + p[2], sum_q = q[0] + q[1] + q[2];
      if (sum_p < 0.02 || sum_q < 0.02) continue;  // black has no hue
      ++hues;
      for (std::size_t c = 0; c < 3; ++c) distance += std::abs(p[c] / sum_p - q[c] / sum_q) / 3;
    }
  }
  return {either > 0 ? static_cast<double>(both) / either : 1, hues > 0 ? distance / hues : 0};
}

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const auto extension = entry.path().extension();
    if (extension == ".gltf" || extension == ".glb") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(DataModels, EveryKhronosModelShowsAPicture) {
  const auto folder = models_folder("khronos_sample_assets");
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no models in " << folder;
  ContactSheet sheet(10);
  std::set<std::string> refused;
  int shown = 0;
  for (const auto& file : gltf_files(folder)) {
    SCOPED_TRACE(file.string());
    Scene scene;
    try {
      scene = load_scene(file);
    } catch (const InputError& error) {
      refused.insert(error.what());
      continue;
    }
    const Subject subject = subject_of(scene);
    const glm::dvec3 from = glm::normalize(glm::dvec3(0.25, 0.2, 1));
    const double distance = subject.radius / std::sin(kHalfView_deg / kDegreesPerRadian);
    light_for_looking(scene, -from);
    const auto picture = picture_of(scene, subject.middle + distance * from, subject.middle, kHalfView_deg);
    EXPECT_TRUE(shows_something(picture));
    sheet.add(picture);
    std::cout << shown++ << " " << file.stem().string() << "\n";
  }
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_NE(refused.begin()->find("KHR_draco_mesh_compression"), std::string::npos) << *refused.begin();
  sheet.write("khronos_sample_assets.png");
}

TEST(DataModels, EveryPositiveModelOfTheAssetGeneratorLooksLikeItsReference) {
  const auto folder = models_folder("gltf_asset_generator/Positive");
  std::ifstream stream(folder / "Manifest.json");
  if (!stream) GTEST_SKIP() << "no models in " << folder;
  // The room around their models alone: the one picture in which nothing is left of the model.
  const auto background =
      read_picture(folder / "Material_AlphaMask/Figures/SampleImages/Material_AlphaMask_03.png");
  ASSERT_TRUE(background);
  constexpr double kTheirHalfView_deg = 0.4 * kDegreesPerRadian;
  ContactSheet sheet(12);
  int compared = 0;
  for (const auto& group : nlohmann::json::parse(stream)) {
    const auto group_folder = folder / group.at("folder").get<std::string>();
    for (const auto& model : group.at("models")) {
      const auto file = group_folder / model.at("fileName").get<std::string>();
      if (!std::filesystem::exists(file)) continue;  // the folder holds a part of the collection
      SCOPED_TRACE(file.string());
      Scene scene;
      try {
        scene = load_scene(file);
      } catch (const InputError&) {
        EXPECT_FALSE(model.at("loadable").get<bool>());
        continue;
      }
      const auto& at = model.at("camera").at("translation");
      const glm::dvec3 eye(at.at(0), at.at(1), at.at(2));
      const Subject subject = subject_of(scene);
      light_for_looking(scene, glm::normalize(subject.middle - eye));
      const auto picture = picture_of(scene, eye, subject.middle, kTheirHalfView_deg);
      // Skinned ones are seen edge-on until their joints turn them; of one mask the cutoff lies above 1.
      const std::string name = model.at("fileName");
      const bool skinned = name.rfind("Animation_Skin", 0) == 0 || name == "Instancing_07.gltf" ||
                           name == "Instancing_08.gltf" || name == "Instancing_09.gltf";
      const bool gone = name == "Material_AlphaMask_03.gltf";
      if (gone) {
        EXPECT_FALSE(shows_something(picture));
      }
      if (triangle_count(scene, true) > 0 && !skinned && !gone) {
        EXPECT_TRUE(shows_something(picture));
      }
      sheet.add(picture);
      const auto reference = model.value("sampleImageName", "");
      if (reference.empty()) {
        sheet.add(picture);
      } else {
        sheet.add(group_folder / reference);
        const auto theirs = read_picture(group_folder / reference);
        if (!theirs || triangle_count(scene, true) == 0) continue;  // points and lines have no area
        const Likeness like = likeness(picture, *theirs, *background);
        // Pixels on outlines differ: of thin letters before holes an eighth of what is seen at 96 pixels.
        EXPECT_GE(like.outline, 0.85) << name;
        // Their room's light against our white: 0.053 at most. Where a material has an older model beside
        // metallic-roughness, theirs shows the older one.
        const bool shows_older = name.find("Material_Mixed") != std::string::npos;
        if (!shows_older) {
          EXPECT_LE(like.hue, 0.08) << name;
        }
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 40);
  sheet.write("gltf_asset_generator.png");
}

// Of the brightness of two pictures, over all pixels.
double correlation(const Picture& a, const Picture& b) {
  double n = 0, sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (std::size_t y = 0; y < kSide; ++y) {
    for (std::size_t x = 0; x < kSide; ++x) {
      const double p = a[y][x][0] + a[y][x][1] + a[y][x][2], q = b[y][x][0] + b[y][x][1] + b[y][x][2];
      n += 1, sum_a += p, sum_b += q, sum_aa += p * p, sum_bb += q * q, sum_ab += p * q;
    }
  }
  const double spread = (n * sum_aa - sum_a * sum_a) * (n * sum_bb - sum_b * sum_b);
  return spread > 0 ? (n * sum_ab - sum_a * sum_b) / std::sqrt(spread) : 0;
}

// Two models of tiles, each with a ball as a shape beside flat tiles that show it by a normal texture, turned
// by a fifth of a turn from row to row; the second has its coordinates mirrored as well.
TEST(DataModels, NormalTexturesLookLikeTheShapesThatTheyStandFor) {
  if (!std::filesystem::exists(models_folder("khronos_sample_assets"))) GTEST_SKIP() << "needs the models";
  struct Tiles {
    const char* model;
    double shape_x;
    std::vector<double> textured_x;
  };
  const Tiles kinds[] = {{"NormalTangentTest", -0.96, {-0.64}},
                         {"NormalTangentTest", -0.16, {0.16}},
                         {"NormalTangentMirrorTest", -1.275, {-0.955, -0.629, -0.291}}};
  for (const Tiles& tiles : kinds) {
    const std::string name = tiles.model;
    Scene scene = load_scene(models_folder("khronos_sample_assets") / name / "glTF-Binary" / (name + ".glb"));
    // Highlights wider than a pixel: narrower ones are widened by the curvature of the shape, which a texture
    // on a flat tile does not tell.
    for (Material& material : scene.materials) {
      material.metallic_roughness_texture = -1;
      material.roughness = 0.35f;
    }
    // The tile that is least like its shape, lit from the left and from above so that
    // no ball shadows its tile.
    const auto least_likeness = [&] {
      double least = 1;
      for (const glm::dvec3& towards : {glm::dvec3(0.3, 0, -1), glm::dvec3(0, -0.3, -1)}) {
        light_for_looking(scene, towards);
        scene.lights[0].direction = glm::normalize(towards);
        Camera camera(scene, kDegreesPerRadian * std::atan(0.13 / 3.5));
        const auto tile = [&](double x, double y) { return camera.picture({x, y, 3.5}, {x, y, 0}); };
        for (const double y : {0.8, 0.4, 0.0, -0.4, -0.8}) {
          const Picture shape = tile(tiles.shape_x, y);
          for (const double x : tiles.textured_x) least = std::min(least, correlation(shape, tile(x, y)));
        }
      }
      return least;
    };
    const double least = least_likeness();
    for (TriangleMesh& mesh : scene.meshes) {
      for (glm::vec4& tangent : mesh.tangents) tangent.w = -tangent.w;
    }
    const double mirrored = least_likeness();
    std::cout << name << " at " << tiles.shape_x << ": correlation of the worst tile " << least
              << ", with mirrored tangents " << mirrored << "\n";
    EXPECT_GT(least, 0.9);
    EXPECT_LT(mirrored, 0.75) << "or the measure tells nothing";
  }
}

}  // namespace
}  // namespace herr
