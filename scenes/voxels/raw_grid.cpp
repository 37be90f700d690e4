#include "scenes/voxels/raw_grid.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "scenes/voxels/voxel_limits.h"
#include "sessions/files/contained_folder.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

glm::ivec3 counts_of(const JsonObject& header) {
  const std::vector<double> numbers = header.numbers("counts", 3, 1, kMostVoxelsAlong);
  glm::ivec3 counts{0};
  double voxels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double number = numbers[static_cast<std::size_t>(axis)];
    counts[axis] = static_cast<int>(number);
    if (number != counts[axis]) {
      header.fail("counts", "is not three whole numbers", "write for example [64, 32, 64]");
    }
    voxels *= number;
  }
  if (voxels > static_cast<double>(kMaxRawVoxels)) {
    header.fail("counts", "makes more than 268435456 voxels", "split the grid");
  }
  return counts;
}

void fill(const std::vector<unsigned char>& rgba, VoxelGrid& grid) {
  std::size_t at = 0;
  for (int z = 0; z < grid.counts.z; ++z) {
    for (int y = 0; y < grid.counts.y; ++y) {
      for (int x = 0; x < grid.counts.x; ++x, at += 4) {
        if (rgba[at + 3] == 0) continue;
        grid.set({x, y, z}, static_cast<std::uint32_t>(rgba[at]) |
                                static_cast<std::uint32_t>(rgba[at + 1]) << 8 |
                                static_cast<std::uint32_t>(rgba[at + 2]) << 16 |
                                static_cast<std::uint32_t>(rgba[at + 3]) << 24);
      }
    }
  }
}

}  // namespace

RawGrid append_raw_grid(const std::filesystem::path& header, Scene& scene) {
  const JsonDocument document(header);
  const JsonObject root = document.root();
  root.allow_only({"format_version", "counts", "voxel_size_m", "data"});
  root.require_version(1);
  const glm::ivec3 counts = counts_of(root);
  RawGrid made;
  made.voxel_size_m = root.number("voxel_size_m", kMinVoxel_m, kMaxVoxel_m);
  const std::string name = root.text("data");

  const std::size_t bytes = std::size_t{4} * static_cast<std::size_t>(counts.x) *
                            static_cast<std::size_t>(counts.y) * static_cast<std::size_t>(counts.z);
  const std::vector<unsigned char> rgba =
      read_named_file(header, name, static_cast<std::int64_t>(kMaxRawVoxels) * 4);
  if (rgba.size() != bytes) {
    root.fail("data",
              "names a file of " + std::to_string(rgba.size()) + " bytes, where the counts ask for " +
                  std::to_string(bytes),
              "write 4 bytes (R, G, B, coverage) for each voxel");
  }
  VoxelGrid grid;
  grid.name = header.stem().stem().string();
  grid.allocate(counts);
  fill(rgba, grid);
  made.grid = static_cast<std::uint32_t>(scene.voxel_grids.size());
  scene.files.push_back(header);
  scene.files.push_back((header.parent_path() / name).lexically_normal());
  if (grid.bricks.empty())
    scene.warnings.push_back(printable(header.string()) + ": shows nothing: no voxel has coverage");
  scene.voxel_grids.push_back(std::move(grid));
  return made;
}

}  // namespace herr
