// MagicaVoxel files of other people: each loads, places every model that it shows, and is
// cut off safely anywhere.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>

#include "scenes/load_scene.h"
#include "scenes/voxels/load_vox.h"
#include "scenes/voxels/vox_graph.h"
#include "sessions/files/input_file.h"
#include "tests/paths.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

std::vector<std::filesystem::path> vox_files() {
  const char* folder = std::getenv("HERR_TEST_DATA");
  const auto root = (folder ? std::filesystem::path(folder)
                            : std::filesystem::path(test::source_dir()) / "../shared/data") /
                    "models/vox";
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(root)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".vox") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(SampleVoxels, EveryFileLoadsWithVoxelsInEveryGrid) {
  const auto files = vox_files();
  if (files.empty()) GTEST_SKIP() << "no .vox files: set HERR_TEST_DATA";
  for (const auto& file : files) {
    const Scene scene = load_scene(file);
    EXPECT_FALSE(scene.instances.empty()) << file;
    std::int64_t voxels = 0, bytes = 0;
    for (const VoxelGrid& grid : scene.voxel_grids) {
      EXPECT_GT(grid.voxels(), 0) << file;
      voxels += grid.voxels(), bytes += grid.bytes();
    }
    std::cout << file.filename() << ": " << scene.instances.size() << " instances, "
              << scene.voxel_grids.size() << " grids, " << voxels << " voxels, " << bytes << " bytes\n";
    for (const std::string& warning : scene.warnings) std::cout << "  " << warning << "\n";
  }
}

TEST(SampleVoxels, CutOffOrDamagedTheyAreRefusedOrRead) {
  const auto files = vox_files();
  if (files.empty()) GTEST_SKIP() << "no .vox files: set HERR_TEST_DATA";
  std::mt19937 random(13);
  SCOPED_TRACE("seed 13");
  for (const auto& file : files) {
    const std::string whole = read_whole_file(file, 1 << 28);
    for (int round = 0; round < 50; ++round) {
      std::string bytes = whole;
      if (round % 2 == 0) bytes.resize(random() % bytes.size());
      for (int i = 0; i < 3 && !bytes.empty(); ++i)
        bytes[random() % std::min<std::size_t>(bytes.size(), 4096)] = static_cast<char>(random());
      try {
        placed_models(parse_vox(bytes, file), file);
      } catch (const InputError& error) {
        EXPECT_TRUE(contains(error.what(), file.filename().string()));
      }
    }
  }
}

}  // namespace
}  // namespace herr::test
