// The example of the README of scenes/document is a document that loads, and its lamp is as bright as the
// rule beside it says.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <string_view>

#include "scenes/load_scene.h"
#include "tests/paths.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

// The fenced block that holds `words`.
std::string block_with(const std::string& text, const std::string& words) {
  constexpr std::string_view kOpen = "```json\n", kClose = "```";
  const std::size_t inside = text.find(words);
  if (inside == std::string::npos) return {};
  const std::size_t begin = text.rfind(kOpen, inside) + kOpen.size();
  return text.substr(begin, text.find(kClose, begin) - begin);
}

TEST(ReadmeExample, AModelOnAFloorBesideAWallLoadsAndIsSeen) {
  std::ifstream readme(source_dir() + "/scenes/document/README.md");
  const std::string text{std::istreambuf_iterator<char>(readme), {}};
  const std::string document = block_with(text, "\"model-on-a-floor\"");
  ASSERT_FALSE(document.empty());
  const TemporaryFolder folder;
  folder.write("model.gltf", triangle_document().dump());
  folder.write("triangle.bin", triangle_bytes());
  const Scene scene = load_scene(folder.write("example.scene.json", document));
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.instances.size(), 3u) << "floor, wall and the model's triangle";
  EXPECT_TRUE(std::none_of(scene.instances.begin(), scene.instances.end(),
                           [](const Instance& instance) { return instance.catcher; }));
  // Radiance of white at the floor below: L = E / pi with E = I / d^2, d = 2 m. 12.6 is pi * 4 to three
  // digits.
  ASSERT_EQ(scene.lights.size(), 1u);
  const double d = scene.lights[0].centre.y;
  EXPECT_EQ(d, 2);
  EXPECT_NEAR(scene.lights[0].intensity_w_sr.x / (std::numbers::pi * d * d), 1, 0.005);
}

}  // namespace
}  // namespace herr::test
