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
#include <set>

#include "sessions/input_error.h"
#include "tests/paths.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr int kSide = 96;
constexpr double kHalfView_deg = 22.5;

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

  void add(const std::array<std::array<test::Pixel, kSide>, kSide>& picture) {
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

// One planar picture by a camera at `eye` that looks at `target`.
std::array<std::array<test::Pixel, kSide>, kSide> picture_of(const Scene& scene, const glm::dvec3& eye,
                                                             const glm::dvec3& target, double half_view_deg) {
  FrameSample sample = test::sample_from(eye);
  const glm::dmat4 eye_from_world = glm::lookAt(eye, target, glm::dvec3(0, 1, 0));
  sample.head.world_from_head.orientation = glm::conjugate(glm::quat_cast(glm::dmat3(eye_from_world)));
  const RenderedFrame frame = test::render(
      scene, test::single_view(kSide, kSide, half_view_deg, half_view_deg), test::planar_settings(), sample);
  test::expect_finite(frame);
  std::array<std::array<test::Pixel, kSide>, kSide> picture;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    picture[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = pixel;
  });
  return picture;
}

// More than one colour, by more than a step of 8 bits.
bool shows_something(const std::array<std::array<test::Pixel, kSide>, kSide>& picture) {
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

TEST(DataModels, EveryPositiveModelOfTheAssetGeneratorShowsAPicture) {
  const auto folder = models_folder("gltf_asset_generator/Positive");
  std::ifstream stream(folder / "Manifest.json");
  if (!stream) GTEST_SKIP() << "no models in " << folder;
  ContactSheet sheet(12);
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
      const auto picture = picture_of(scene, eye, subject.middle, kHalfView_deg);
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
      }
    }
  }
  sheet.write("gltf_asset_generator.png");
}

}  // namespace
}  // namespace herr
