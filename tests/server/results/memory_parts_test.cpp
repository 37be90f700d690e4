// One list of what a run holds: renderer, scene, pictures.
#include "server/results/memory_parts.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

std::int64_t part(const MemoryUse& parts, const std::string& name) {
  for (const MemoryEntry& entry : parts) {
    if (entry.name == name) return entry.bytes;
  }
  ADD_FAILURE() << "no part '" << name << "'";
  return -1;
}

TEST(MemoryParts, ALoadedTextureCountsOnceAsLoadedAndOnceAsTheRendererHasIt) {
  Scene scene;
  test::add(scene, test::floor_quad(5, -1), test::matte({0.5f, 0.4f, 0.3f}));
  scene.lights = {test::light_at({1, 3, -1}, {20, 15, 10})};
  const RenderSettings settings = test::small_settings();
  const auto parts_of = [&](const Scene& of) {
    const Renderer renderer(of, test::small_profile(), settings, false);
    return memory_parts(renderer, of, {11, 22, 33});
  };
  const MemoryUse plain = parts_of(scene);
  scene.textures.push_back({"grey", 64, 64, true, {}, {}, std::vector<std::uint8_t>(64 * 64 * 4, 128)});
  scene.materials[0].base_colour_texture = 0;
  const MemoryUse textured = parts_of(scene);
  EXPECT_EQ(part(textured, "loaded textures") - part(plain, "loaded textures"),
            64 * 64 * 4 + static_cast<std::int64_t>(sizeof(TextureImage)));
  // All levels: 64^2 + 32^2 + ... + 1 texels of four bytes, and what says where they are.
  EXPECT_NEAR(double(part(textured, "textures") - part(plain, "textures")), 5461 * 4, 1024);
  EXPECT_EQ(part(plain, "frame pictures"), 11);
  EXPECT_EQ(part(plain, "camera pictures"), 22);
  EXPECT_EQ(part(plain, "encoder buffers"), 33);
  std::set<std::string> names;
  for (const MemoryEntry& entry : plain) EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
}

TEST(MemoryParts, PicturesAreReplacedInPlace) {
  MemoryUse parts{{"probes", 5}};
  set_pictures({1, 2, 3}, parts);
  set_pictures({10, 20, 30}, parts);
  set_encoder_bytes(300, parts);
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(total_bytes(parts), 5 + 10 + 20 + 300);
}

TEST(MemoryParts, AnImageThatBothEyesSeeCountsOnce) {
  auto image = std::make_shared<CameraImage>();
  image->rgba_half.resize(4 * 640 * 480);
  FrameSample sample;
  EXPECT_EQ(camera_bytes(sample), 0);
  sample.cameras[0].emplace().image = image;
  EXPECT_EQ(camera_bytes(sample), 640 * 480 * 8);
  sample.cameras[1].emplace().image = image;
  EXPECT_EQ(camera_bytes(sample), 640 * 480 * 8);
  sample.cameras[1]->image = std::make_shared<CameraImage>(*image);
  EXPECT_EQ(camera_bytes(sample), 2 * 640 * 480 * 8);
}

}  // namespace
}  // namespace herr
