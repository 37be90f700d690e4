// Models of other people before and after a packer: gltfpack counts in integers, merges nodes and drops what
// it does not know. The picture may move by what the integers round, and by no more.
//
// Bound, for a picture of 96 pixels that the model fills: positions have 14 bits of the model's extent, 96 /
// 2^14 = 0.006 px; texture coordinates 12 bits, 0.02 px for each time a texture repeats; weights of joints 8
// bits, 96 / 2 / 255 = 0.2 px; normals 8 bits, at most sqrt(3) / 2 / 127 = 0.0068 rad = 0.4 degrees, which
// moves a highlight on a ball of half the picture by 48 * 0.0068 = 0.3 px. So everything moves by less than a
// pixel: a pixel is explained if its colour lies between the least and the most of its 3 x 3 neighbours, and
// a few steps. Where the shading is smooth a normal changes a cosine by 0.0068 sin: in sRGB 4.4 steps of 8
// bits where it is 0.05, which is half as bright as what light from all around gives. One step for colours of
// 8 bits, one for rounding.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <optional>

#include "scenes/load_scene.h"
#include "tests/missing_tool.h"
#include "tests/paths.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/scaled_scene.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

constexpr int kSide = 96;
constexpr double kHalfView_deg = 22.5;
constexpr double kSteps = 7;
constexpr double kExplained = 0.99;  // of the pixels: thin lines, and highlights on flat surfaces, go further

std::filesystem::path models_folder() {
  const char* folder = std::getenv("HERR_TEST_DATA");
  const std::filesystem::path data = folder != nullptr
                                         ? std::filesystem::path(folder)
                                         : std::filesystem::path(test::source_dir()) / "../shared/data";
  return data / "models" / "khronos_sample_assets";
}

// One file of each model: the one that names its parts, if there is one.
std::vector<std::filesystem::path> models_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> models;
  for (const auto& model : std::filesystem::directory_iterator(folder)) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(model.path())) {
      const auto extension = entry.path().extension();
      if (extension == ".gltf" || extension == ".glb") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    if (!files.empty()) models.push_back(files.front());
  }
  std::sort(models.begin(), models.end());
  return models;
}

// A sun over the viewer's shoulder; nothing is as dark as what is behind.
void light(Scene& scene) {
  AreaLight sun;
  sun.kind = LightKind::sun;
  sun.direction = glm::normalize(glm::dvec3(-0.2, -1, -1));
  sun.intensity_w_sr = glm::vec3(2.0f);
  scene.lights = {sun};
  scene.ambient = glm::vec3(0.35f);
  scene.environment = glm::vec3(0.08f);
}

RenderedFrame picture_of(const Scene& scene, const glm::dvec3& middle, double radius) {
  const glm::dvec3 eye =
      middle + glm::normalize(glm::dvec3(0.5, 0.4, 1)) * radius / std::sin(glm::radians(kHalfView_deg));
  FrameSample sample = test::sample_from(eye);
  const glm::dmat4 eye_from_world = glm::lookAt(eye, middle, glm::dvec3(0, 1, 0));
  sample.head.world_from_head.orientation = glm::conjugate(glm::quat_cast(glm::dmat3(eye_from_world)));
  return test::render(scene, test::single_view(kSide, kSide, kHalfView_deg, kHalfView_deg),
                      test::planar_settings(), sample);
}

// Between the least and the most of the pixels around it in `original`, and kSteps; `linear`: and this light.
bool explained(const ViewportImage& original, int x, int y, const test::Pixel& pixel, double linear) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    double least = 1, most = 0;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, kSide - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, kSide - 1); ++u) {
        const double light = test::pixel_at(original, u, v)[channel];
        least = std::min(least, light), most = std::max(most, light);
      }
    }
    const double step = test::srgb_step(pixel[channel]);
    if (step < test::srgb_step(least - linear) - kSteps || step > test::srgb_step(most + linear) + kSteps)
      return false;
  }
  return true;
}

double share_explained(const RenderedFrame& original, const RenderedFrame& packed, double linear) {
  int count = 0;
  test::for_each_pixel(packed.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    count += explained(original.viewports[0], x, y, pixel, linear) ? 1 : 0;
  });
  return static_cast<double>(count) / (kSide * kSide);
}

std::string packer() {
  const char* named = std::getenv("HERR_GLTFPACK");
  return named != nullptr ? named : "gltfpack";
}

bool runs(const std::string& line) {
  return std::system((line + " >/dev/null 2>&1").c_str()) == 0;
}

void expect_the_same_pictures(const std::string& options) {
  if (!runs("command -v '" + packer() + "'"))
    HERR_MISSING_TOOL("no gltfpack; apt-get install gltfpack, or set HERR_GLTFPACK");
  if (!std::filesystem::is_directory(models_folder())) GTEST_SKIP() << "no models in " << models_folder();
  int compared = 0;
  for (const auto& file : models_of(models_folder())) {
    SCOPED_TRACE(file.string());
    const TemporaryFolder folder;
    const auto packed_file = folder.path() / "packed.glb";
    // What the packer itself cannot read is none of ours.
    // 0.18 writes the meshes of all scenes into the first, whichever is shown.
    if (file.stem() == "MultipleScenes") continue;
    if (!runs("'" + packer() + "' " + options + " -i '" + file.string() + "' -o '" + packed_file.string() +
              "'"))
      continue;
    Scene original = load_scene(file), packed = load_scene(packed_file);
    light(original), light(packed);
    const Bounds box = scene_bounds(original), other = scene_bounds(packed);
    const double radius = 0.5 * glm::length(box.upper - box.lower);
    const glm::dvec3 middle = 0.5 * (box.lower + box.upper);
    const bool coloured = std::any_of(original.meshes.begin(), original.meshes.end(),
                                      [](const TriangleMesh& mesh) { return !mesh.colours.empty(); });
    const double share = share_explained(picture_of(original, middle, radius),
                                         picture_of(packed, middle, radius), coloured ? 0.6 / 255 : 0.0);
    const double off = std::max(glm::distance(box.lower, other.lower), glm::distance(box.upper, other.upper));
    std::cout << file.filename().string() << ": " << 100 * share << " % explained, box off by "
              << off / radius << "\n";
    // A step of the grid at each corner and axis; joints' weights move what bends by 1 / 255.
    EXPECT_LE(off, radius / 255) << "boxes up to " << box.upper.x << " and " << other.upper.x;
    // 0.22 lets materials share coordinates to which it gives different transforms; there it moves a texture.
    EXPECT_GE(share, file.stem() == "AlphaBlendModeTest" ? 0.985 : kExplained);
    ++compared;
  }
  EXPECT_GE(compared, 45);
}

TEST(PackedModelsTest, LookAsBefore) {
  expect_the_same_pictures("");
}

TEST(PackedModelsTest, LookAsBeforeWhenCompressed) {
  expect_the_same_pictures("-c");
}

}  // namespace
}  // namespace herr
