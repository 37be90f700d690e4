// Where the tile of each probe stands in a picture of all, and floats that survive the file.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <set>

#include "server/inspect/probes/probe_atlas.h"
#include "server/output/memory_stream.h"

namespace herr {
namespace {

ProbeGrid grid_of(const glm::ivec3& counts) {
  ProbeGrid grid;
  grid.counts = counts;
  return grid;
}

TEST(ProbeAtlasTest, EveryProbeHasATileOfItsOwn) {
  for (const glm::ivec3& counts : {glm::ivec3{1, 1, 1}, glm::ivec3{16, 8, 16}, glm::ivec3{5, 7, 3},
                                   glm::ivec3{1, 1, 9}, glm::ivec3{4000, 1, 2}, glm::ivec3{1, 65536, 1}}) {
    SCOPED_TRACE(testing::Message() << counts.x << " x " << counts.y << " x " << counts.z);
    const AtlasLayout layout = lay_out_probes(grid_of(counts));
    std::set<std::pair<int, int>> taken;
    for (const glm::ivec2& tile : layout.tiles) {
      ASSERT_TRUE(tile.x >= 0 && tile.x < layout.columns && tile.y >= 0 && tile.y < layout.rows);
      ASSERT_TRUE(taken.emplace(tile.x, tile.y).second);
    }
    EXPECT_EQ(taken.size(), static_cast<std::size_t>(counts.x * counts.y * counts.z));
    // No side is longer than OpenEXR and PNG can have, nor than a viewer likes: 900 tiles of 35 pixels.
    EXPECT_LE(std::max(layout.columns, layout.rows) * tile_px(DistanceNodes::kStride), 31500);
  }
}

// 16 layers of 16 x 8: three beside each other make 48 x 48 tiles, nothing is nearer to a square.
TEST(ProbeAtlasTest, LayersStandUprightBesideEachOther) {
  const ProbeGrid grid = grid_of({16, 8, 16});
  const AtlasLayout layout = lay_out_probes(grid);
  EXPECT_EQ(layout.columns, 48);
  EXPECT_EQ(layout.rows, 48);
  const auto tile = [&](int x, int y, int z) {
    return layout.tiles[static_cast<std::size_t>(grid.index({x, y, z}))];
  };
  EXPECT_EQ(tile(0, 7, 0), glm::ivec2(0, 0)) << "the highest row on top";
  EXPECT_EQ(tile(3, 0, 0), glm::ivec2(3, 7));
  EXPECT_EQ(tile(0, 7, 2), glm::ivec2(32, 0)) << "the third layer beside the second";
  EXPECT_EQ(tile(0, 7, 3), glm::ivec2(0, 8)) << "the fourth below the first";
}

TEST(ProbeAtlasTest, FloatsAreTheSameWhenTheyAreRead) {
  FloatPlanes planes;
  planes.width_px = 3;
  planes.height_px = 2;
  planes.channels = {{"deviation", {0.0f, 1e-30f, 2, 3, 4, 5}}, {"distance", {1e30f, -1, 0.1f, 7, 8, 65537}}};
  planes.notes = {{"herr.unit", "m"}};
  std::vector<std::uint8_t> file, again;
  encode_float_exr(planes, file);
  encode_float_exr(planes, again);
  EXPECT_EQ(file, again);
  MemoryInput stream(file);
  Imf::InputFile input(stream, 0);
  EXPECT_EQ(input.header().typedAttribute<Imf::StringAttribute>("herr.unit").value(), "m");
  ASSERT_EQ(input.header().dataWindow().max, Imath::V2i(2, 1));
  for (const auto& [name, values] : planes.channels) {
    ASSERT_EQ(input.header().channels().findChannel(name)->type, Imf::FLOAT);
    std::vector<float> read(6);
    Imf::FrameBuffer buffer;
    buffer.insert(
        name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read.data()), sizeof(float), 3 * sizeof(float)));
    input.setFrameBuffer(buffer);
    input.readPixels(0, 1);
    EXPECT_EQ(read, values) << name;
  }
}

}  // namespace
}  // namespace herr
