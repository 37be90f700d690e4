// Raw grids and meshes made of voxels, and the sparse grid that holds them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scenes/voxels/raw_grid.h"
#include "scenes/voxels/triangle_voxels.h"
#include "scenes/voxels/voxelise_mesh.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

TEST(VoxelGrid, KeepsWhatWasSetInGridsOfAnySize) {
  for (const glm::ivec3 counts :
       {glm::ivec3{1, 1, 1}, glm::ivec3{4, 4, 4}, glm::ivec3{5, 3, 9}, glm::ivec3{17, 1, 6}}) {
    VoxelGrid grid;
    grid.allocate(counts);
    const auto colour = [&](const glm::ivec3& v) {
      return (v.x + v.y + v.z) % 3 == 0
                 ? 0u
                 : 0xff000000u | static_cast<std::uint32_t>(v.x | v.y << 8 | v.z << 16);
    };
    std::int64_t filled = 0;
    for (int pass = 0; pass < 2; ++pass) {
      for (int z = 0; z < counts.z; ++z) {
        for (int y = 0; y < counts.y; ++y) {
          for (int x = 0; x < counts.x; ++x) {
            if (pass == 1) {
              EXPECT_EQ(grid.at({x, y, z}), colour({x, y, z}));
            }
            if (pass == 1 || colour({x, y, z}) == 0) continue;
            grid.set({x, y, z}, colour({x, y, z}));
            ++filled;
          }
        }
      }
    }
    EXPECT_EQ(grid.voxels(), filled);
  }
}

TEST(VoxelGrid, BlocksWithoutVoxelsCostFourBytes) {
  VoxelGrid grid;
  grid.allocate({256, 256, 256});
  grid.set({200, 100, 7}, 0xffffffffu);
  // 64^3 blocks of 4 bytes and one brick of 64 voxels of 4 bytes.
  EXPECT_EQ(grid.bytes(), 64 * 64 * 64 * 4 + 64 * 4);
}

nlohmann::json raw_header() {
  return {{"format_version", 1}, {"counts", {2, 1, 3}}, {"voxel_size_m", 0.5}, {"data", "grid.rgba8"}};
}

std::string raw_error(const nlohmann::json& header, std::size_t bytes = 24) {
  const TemporaryFolder folder;
  folder.write("grid.rgba8", std::string(bytes, 'x'));
  Scene scene;
  try {
    append_raw_grid(folder.write("grid.voxels.json", header.dump()), scene);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(RawGrid, RunsAlongXThenYThenZ) {
  std::vector<std::uint32_t> values;
  for (std::uint32_t i = 0; i < 6; ++i) values.push_back(i == 4 ? 0x00ffffffu : 0x80000000u | i);
  const TemporaryFolder folder;
  folder.write("grid.rgba8", bytes_of(values));
  Scene scene;
  const RawGrid raw = append_raw_grid(folder.write("grid.voxels.json", raw_header().dump()), scene);
  const VoxelGrid& grid = scene.voxel_grids[raw.grid];
  EXPECT_EQ(raw.voxel_size_m, 0.5);
  EXPECT_EQ(grid.at({1, 0, 0}), 0x80000001u);
  EXPECT_EQ(grid.at({1, 0, 2}), 0x80000005u);
  EXPECT_EQ(grid.at({0, 0, 2}), 0u) << "without coverage there is no voxel, whatever its colour";
  EXPECT_EQ(grid.voxels(), 5);
}

TEST(RawGrid, EachFaultNamesItsField) {
  const auto with = [](const char* key, const nlohmann::json& value) {
    nlohmann::json header = raw_header();
    header[key] = value;
    return header;
  };
  EXPECT_EQ(raw_error(raw_header()), "");
  EXPECT_TRUE(contains(raw_error(raw_header(), 23), "names a file of 23 bytes, where the counts ask for 24"));
  EXPECT_TRUE(contains(raw_error(raw_header(), 25), "names a file of 25 bytes"));
  EXPECT_TRUE(contains(raw_error(raw_header(), 0), "is empty"));
  EXPECT_TRUE(contains(raw_error(with("counts", {0, 1, 3})), "counts"));
  EXPECT_TRUE(contains(raw_error(with("counts", {2, 1, 1025})), "counts"));
  EXPECT_TRUE(contains(raw_error(with("counts", {2, 1, 2.5})), "three whole numbers"));
  EXPECT_TRUE(contains(raw_error(with("counts", {1024, 1024, 1024})), "more than 268435456 voxels"));
  EXPECT_TRUE(contains(raw_error(with("voxel_size_m", 0)), "voxel_size_m"));
  EXPECT_TRUE(contains(raw_error(with("voxel_size_m", -1)), "voxel_size_m"));
  EXPECT_TRUE(contains(raw_error(with("voxel_size_m", 1e-30)), "voxel_size_m"));
  EXPECT_TRUE(contains(raw_error(with("data", "../grid.rgba8")), "outside the folder"));
  EXPECT_TRUE(contains(raw_error(with("data", "absent.rgba8")), "cannot be opened"));
  EXPECT_TRUE(contains(raw_error(with("format_version", 2)), "format_version"));
  EXPECT_TRUE(contains(raw_error(with("count", {1, 1, 1})), "count"));
}

// Does any point of the triangle lie in the voxel? By clipping it with the six faces, in double.
bool clipped_touches(const TriangleCorners& triangle, const glm::ivec3& voxel) {
  std::vector<glm::dvec3> polygon(triangle.begin(), triangle.end());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const double limit = sign > 0 ? voxel[axis] : -(voxel[axis] + 1.0);
      std::vector<glm::dvec3> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = sign * a[axis] - limit, db = sign * b[axis] - limit;
        if (da >= 0) kept.push_back(a);
        if ((da < 0) != (db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
      }
      polygon = kept;
      if (polygon.empty()) return false;
    }
  }
  return true;
}

TEST(TriangleVoxels, AreThoseThatClippingFinds) {
  std::mt19937 random(7);
  SCOPED_TRACE("seed 7");
  std::uniform_real_distribution<double> place(-1.0, 9.0), small(-1.5, 1.5);
  const glm::ivec3 counts{8, 7, 6};
  for (int round = 0; round < 300; ++round) {
    const glm::dvec3 a{place(random), place(random), place(random)};
    TriangleCorners triangle{a, a, a};
    for (std::size_t i = 1; i < 3; ++i) {
      triangle[i] = round % 2 == 0 ? glm::dvec3{place(random), place(random), place(random)}
                                   : a + glm::dvec3{small(random), small(random), small(random)};
    }
    std::vector<int> found(8 * 7 * 6);
    for_each_touched(triangle, counts, [&](const glm::ivec3& v) {
      ++found[static_cast<std::size_t>(v.x + 8 * (v.y + 7 * v.z))];
    });
    for (int z = 0; z < counts.z; ++z) {
      for (int y = 0; y < counts.y; ++y) {
        for (int x = 0; x < counts.x; ++x) {
          ASSERT_EQ(found[static_cast<std::size_t>(x + 8 * (y + 7 * z))],
                    clipped_touches(triangle, {x, y, z}) ? 1 : 0)
              << "round " << round << ", voxel " << x << ", " << y << ", " << z;
        }
      }
    }
  }
}

TEST(VoxelisedMesh, ATriangleInItsPlaneFillsOneLayer) {
  // (0,0,0) (1,0,0) (0,1,0) at 8 voxels a metre. Voxel (x, y) is touched where x + y <= 8, its lower corner
  // lying on or below the long side: rows of 8, 8, 7, 6, 5, 4, 3, 2 voxels, cut to the 8 x 8 x 1 grid.
  const TemporaryFolder folder;
  Scene scene;
  const VoxelisedMesh made = append_voxelised_mesh(write_model(folder, triangle_document()), 8, scene);
  const VoxelGrid& grid = scene.voxel_grids[made.grid];
  EXPECT_EQ(grid.counts, glm::ivec3(8, 8, 1));
  EXPECT_EQ(grid.voxels(), 8 + 8 + 7 + 6 + 5 + 4 + 3 + 2);
  EXPECT_DOUBLE_EQ(made.gltf_from_grid[0].x, 0.125);
  // White by default: glTF's base colour factor is 1.
  EXPECT_EQ(grid.at({0, 0, 0}), 0xffffffffu);
}

TEST(VoxelisedMesh, AColourIsWrittenAsSrgb) {
  // Linear 0.5 is sRGB 188 of 255, 0.1 is 89.
  nlohmann::json document = triangle_document();
  document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.1, 1.0, 1.0}}}}}};
  document["meshes"][0]["primitives"][0]["material"] = 0;
  const TemporaryFolder folder;
  Scene scene;
  const VoxelisedMesh made = append_voxelised_mesh(write_model(folder, document), 4, scene);
  EXPECT_EQ(scene.voxel_grids[made.grid].at({1, 1, 0}), 0xff000000u | 255u << 16 | 89u << 8 | 188u);
}

}  // namespace
}  // namespace herr::test
