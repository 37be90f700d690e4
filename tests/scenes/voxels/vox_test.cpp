// MagicaVoxel files: what is read, where it stands, and what each fault says.
#include <gtest/gtest.h>

#include <functional>

#include "scenes/voxels/load_vox.h"
#include "scenes/voxels/vox_graph.h"
#include "tests/scenes/voxels/vox_files.h"

namespace herr::test {
namespace {

struct Loaded {
  Scene scene;
  std::vector<Instance> instances;
};

Loaded load(const std::string& bytes) {
  const TemporaryFolder folder;
  Loaded loaded;
  loaded.instances = append_vox(folder.write("model.vox", bytes), loaded.scene);
  return loaded;
}

// The message of the InputError; "" when the file is sound.
std::string vox_error(const std::string& bytes) {
  try {
    const VoxFile vox = parse_vox(bytes, "model.vox");
    placed_models(vox, "model.vox");
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

// Where the middle of a voxel stands, y up.
glm::dvec3 middle(const Instance& instance, const glm::ivec3& voxel) {
  return instance.world_from_object * glm::dvec4(glm::dvec3(voxel) + 0.5, 1.0);
}

void expect_place(const glm::dvec3& place, const glm::dvec3& expected) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_DOUBLE_EQ(place[axis], expected[axis]) << "axis " << axis;
}

TEST(Vox, ReadsVoxelsInTheColoursOfTheDefaultPalette) {
  // Index 1 is white, 2 is (ff, ff, cc), 216 the first dark red (ee, 0, 0), 255 the
  // darkest grey (11, 11, 11).
  const Loaded vox =
      load(vox_bytes(vox_model(3, 4, 5, {{0, 0, 0, 1}, {2, 3, 4, 2}, {1, 0, 4, 216}, {1, 1, 1, 255}})));
  ASSERT_EQ(vox.instances.size(), 1u);
  const VoxelGrid& grid = vox.scene.voxel_grids[vox.instances[0].grid];
  EXPECT_EQ(grid.counts, glm::ivec3(3, 4, 5));
  EXPECT_EQ(grid.voxels(), 4);
  EXPECT_EQ(grid.at({0, 0, 0}), 0xffffffffu);
  EXPECT_EQ(grid.at({2, 3, 4}), 0xffccffffu);
  EXPECT_EQ(grid.at({1, 0, 4}), 0xff0000eeu);
  EXPECT_EQ(grid.at({1, 1, 1}), 0xff111111u);
  EXPECT_EQ(grid.at({1, 2, 3}), 0u);
}

TEST(Vox, PaletteEntryZeroIsTheColourOfIndexOne) {
  std::string colours;
  for (int i = 0; i < 256; ++i) colours += int32(0x01000000 | i);
  const Loaded vox =
      load(vox_bytes(vox_model(1, 1, 2, {{0, 0, 0, 1}, {0, 0, 1, 255}}) + vox_chunk("RGBA", colours)));
  // Its alpha is not used: both are opaque.
  EXPECT_EQ(vox.scene.voxel_grids[0].at({0, 0, 0}), 0xff000000u);
  EXPECT_EQ(vox.scene.voxel_grids[0].at({0, 0, 1}), 0xff0000feu);
}

TEST(Vox, StandsOnTheGroundWithoutASceneGraph) {
  // Size 4 x 6 x 8: the corner lies at (-2, -3, 0) with z up. Voxel (1, 2, 3) has its middle at (-0.5,
  // -0.5, 3.5), which is (-0.5, 3.5, 0.5) with y up.
  const Loaded vox = load(vox_bytes(vox_model(4, 6, 8, {{1, 2, 3, 1}})));
  expect_place(middle(vox.instances[0], {1, 2, 3}), {-0.5, 3.5, 0.5});
}

TEST(Vox, TransformsTurnAboutTheMiddleVoxelAndMove) {
  // Size 3: the pivot is the corner of voxel (1, 1, 1). Rotation 0b0010001 = 17: the first row takes column 1
  // (bits 0-1 = 1) with a minus (bit 4), the second column 0: (x, y) -> (-y, x), a quarter turn. The middle
  // of voxel (2, 1, 0) is (1.5, 0.5, -0.5) from the pivot, turned (-0.5, 1.5, -0.5), moved by (10, 20, 30):
  // (9.5, 21.5, 29.5); with y up (9.5, 29.5, -21.5).
  const std::string graph = vox_transform(0, 1, {}) + vox_group(1, {2}) +
                            vox_transform(2, 3, {{"_r", "17"}, {"_t", "10 20 30"}}, {{"_name", "arm"}}) +
                            vox_shape(3, 0);
  const Loaded vox = load(vox_bytes(vox_model(3, 3, 3, {{2, 1, 0, 1}}) + graph, 200));
  ASSERT_EQ(vox.instances.size(), 1u);
  EXPECT_EQ(vox.instances[0].name, "arm");
  expect_place(middle(vox.instances[0], {2, 1, 0}), {9.5, 29.5, -21.5});
}

TEST(Vox, TransformsMultiplyFromTheRootDown) {
  // The outer quarter turn (17) maps the inner translation (5, 0, 0) to (0, 5, 0). The model of one
  // voxel has its pivot at its corner: middle (0.5, 0.5, 0.5) -> turned (-0.5, 0.5, 0.5) + (0, 5, 0);
  // with y up (-0.5, 0.5, -5.5).
  const std::string graph = vox_transform(0, 1, {{"_r", "17"}}) + vox_group(1, {2}) +
                            vox_transform(2, 3, {{"_t", "5 0 0"}}) + vox_shape(3, 0);
  const Loaded vox = load(vox_bytes(vox_model(1, 1, 1, {{0, 0, 0, 1}}) + graph, 200));
  expect_place(middle(vox.instances[0], {0, 0, 0}), {-0.5, 0.5, -5.5});
}

TEST(Vox, HiddenNodesAndLayersAreLeftOutWithAWarning) {
  const std::string graph =
      vox_transform(0, 1, {}) + vox_group(1, {2, 4, 6}) + vox_transform(2, 3, {}, {{"_hidden", "1"}}) +
      vox_shape(3, 0) + vox_transform(4, 5, {}, {}, 7) + vox_shape(5, 0) + vox_transform(6, 8, {}, {}, 0) +
      vox_shape(8, 0) + vox_chunk("LAYR", int32(7) + vox_dictionary({{"_hidden", "1"}}) + int32(-1)) +
      vox_chunk("LAYR", int32(0) + vox_dictionary({}) + int32(-1));
  const Loaded vox = load(vox_bytes(vox_model(1, 1, 1, {{0, 0, 0, 1}}) + graph, 200));
  EXPECT_EQ(vox.instances.size(), 1u);
  EXPECT_TRUE(any_contains(vox.scene.warnings, "2 hidden models"));
}

TEST(Vox, OneModelInSeveralPlacesIsOneGrid) {
  const std::string graph = vox_transform(0, 1, {}) + vox_group(1, {2, 4}) +
                            vox_transform(2, 3, {{"_t", "5 0 0"}}) + vox_shape(3, 0) +
                            vox_transform(4, 5, {{"_t", "-5 0 0"}}) + vox_shape(5, 0);
  const Loaded vox = load(vox_bytes(vox_model(1, 1, 1, {{0, 0, 0, 1}}) + graph, 200));
  ASSERT_EQ(vox.instances.size(), 2u);
  EXPECT_EQ(vox.instances[0].grid, vox.instances[1].grid);
  EXPECT_EQ(vox.scene.voxel_grids.size(), 1u);
}

TEST(Vox, GlassCoversByWhatItDoesNotLetThrough) {
  // trans 0.75 leaves a coverage of 1.5 + 254 * 0.25 = 65, cut to a whole number. Metal
  // stays opaque and is named.
  const std::string materials =
      vox_chunk("MATL", int32(1) + vox_dictionary({{"_type", "_glass"}, {"_trans", "0.75"}})) +
      vox_chunk("MATL", int32(2) + vox_dictionary({{"_type", "_metal"}, {"_rough", "0.1"}}));
  const Loaded vox = load(vox_bytes(vox_model(2, 1, 1, {{0, 0, 0, 1}, {1, 0, 0, 2}}) + materials));
  EXPECT_EQ(vox.scene.voxel_grids[0].at({0, 0, 0}) >> 24, 65u);
  EXPECT_EQ(vox.scene.voxel_grids[0].at({1, 0, 0}) >> 24, 255u);
  EXPECT_TRUE(any_contains(vox.scene.warnings, "1 material is drawn as matte"));
}

TEST(Vox, AFileWithoutVoxelsShowsNothingWithAWarning) {
  const Loaded vox = load(vox_bytes(vox_model(4, 4, 4, {})));
  EXPECT_TRUE(vox.instances.empty());
  EXPECT_TRUE(any_contains(vox.scene.warnings, "shows nothing"));
}

struct Fault {
  const char* name;
  std::string bytes;
  const char* expected;
};

TEST(Vox, EachFaultNamesItsByteAndWhatIsWrong) {
  const std::string model = vox_model(1, 1, 1, {{0, 0, 0, 1}});
  const std::string node0 = vox_transform(0, 1, {});
  const std::vector<Fault> faults{
      {"empty file", "", "the signature needs 4 bytes where 0 are left"},
      {"another format", "RIFF" + vox_bytes(model).substr(4), "does not begin with \"VOX \""},
      {"unknown version", vox_bytes(model, 201), "the version is 201"},
      {"no MAIN", "VOX " + int32(150) + vox_chunk("SIZE", ""), "no MAIN chunk"},
      {"MAIN longer than the file", vox_bytes(model) + "x", "MAIN holds"},
      {"MAIN of negative length", "VOX " + int32(150) + "MAIN" + int32(-1) + int32(0),
       "length of MAIN is -1"},
      {"chunk longer than the file", vox_bytes("NOTE" + int32(1 << 30) + int32(0)),
       "a chunk needs 1073741824 bytes"},
      {"chunk of negative length", vox_bytes("NOTE" + int32(-4) + int32(0)), "negative length"},
      {"no model", vox_bytes(""), "no model"},
      {"side of 0", vox_bytes(vox_model(0, 1, 1, {})), "side of SIZE is 0"},
      {"side of 257", vox_bytes(vox_model(1, 257, 1, {})), "side of SIZE is 257"},
      {"negative side", vox_bytes(vox_model(1, 1, -1, {})), "side of SIZE is -1"},
      {"voxels without a size", vox_bytes(vox_chunk("XYZI", int32(0))), "XYZI has no SIZE"},
      {"size without voxels", vox_bytes(vox_chunk("SIZE", int32(1) + int32(1) + int32(1))),
       "SIZE has no XYZI"},
      {"voxel outside", vox_bytes(vox_model(2, 2, 2, {{0, 0, 0, 1}, {0, 2, 0, 1}})),
       "a voxel lies at (0, 2, 0)"},
      {"more voxels than bytes",
       vox_bytes(vox_chunk("SIZE", int32(1) + int32(1) + int32(1)) + vox_chunk("XYZI", int32(2000000000))),
       "the number of voxels is 2000000000"},
      {"bytes behind the voxels",
       vox_bytes(vox_chunk("SIZE", int32(1) + int32(1) + int32(1)) + vox_chunk("XYZI", int32(0) + "abcd")),
       "XYZI holds 4 bytes for 0 voxels"},
      {"short palette", vox_bytes(model + vox_chunk("RGBA", int32(1))),
       "a colour of the palette needs 4 bytes"},
      {"dictionary without end", vox_bytes(model + vox_chunk("MATL", int32(1) + int32(1 << 30))),
       "the number of entries of a dictionary is 1073741824"},
      {"node twice", vox_bytes(model + node0 + node0), "node 0 is there twice"},
      {"child that does not exist", vox_bytes(model + node0), "names node 1, which does not exist"},
      {"model that does not exist", vox_bytes(model + node0 + vox_shape(1, 1)), "names model 1 of 1"},
      {"negative model", vox_bytes(model + node0 + vox_shape(1, -1)), "names model -1 of 1"},
      {"cycle", vox_bytes(model + node0 + vox_group(1, {0})), "a node is its own ancestor"},
      {"node that is its own child", vox_bytes(model + vox_group(0, {0})), "a node is its own ancestor"},
      {"cycle behind a shared group",
       vox_bytes(model + vox_group(0, {1, 1, 2}) + vox_group(1, {3}) + vox_group(2, {1, 4}) +
                 vox_shape(3, 0) + vox_group(4, {2})),
       "a node is its own ancestor"},
      {"rotation that is none", vox_bytes(model + vox_transform(0, 1, {{"_r", "0"}}) + vox_shape(1, 0)),
       "rotation \"0\""},
      {"rotation with a third column",
       vox_bytes(model + vox_transform(0, 1, {{"_r", "3"}}) + vox_shape(1, 0)), "rotation \"3\""},
      {"rotation that is no number", vox_bytes(model + vox_transform(0, 1, {{"_r", "4x"}}) + vox_shape(1, 0)),
       "rotation \"4x\""},
      {"translation of two numbers",
       vox_bytes(model + vox_transform(0, 1, {{"_t", "1 2"}}) + vox_shape(1, 0)), "translation \"1 2\""},
      {"translation beyond the limit",
       vox_bytes(model + vox_transform(0, 1, {{"_t", "0 0 2000000"}}) + vox_shape(1, 0)), "translation"},
      {"transform without a frame",
       vox_bytes(model + vox_chunk("nTRN", int32(0) + int32(0) + int32(1) + int32(-1) + int32(0) + int32(0))),
       "no frame"},
  };
  for (const Fault& fault : faults) {
    const std::string message = vox_error(fault.bytes);
    EXPECT_TRUE(contains(message, fault.expected)) << fault.name << ": \"" << message << "\"";
    EXPECT_EQ(message.find('\n'), std::string::npos) << fault.name;
  }
}

TEST(Vox, GroupsNestedBeyondTheLimitAreRefused) {
  std::string graph;
  for (int i = 0; i < 100; ++i) graph += vox_group(i, {i + 1});
  const std::string message =
      vox_error(vox_bytes(vox_model(1, 1, 1, {{0, 0, 0, 1}}) + graph + vox_shape(100, 0)));
  EXPECT_TRUE(contains(message, "deeper than 64 nodes")) << message;
}

TEST(Vox, AFileCutOffAtAnyByteIsRefused) {
  const std::string whole =
      vox_bytes(vox_model(2, 3, 2, {{0, 0, 0, 1}, {1, 2, 1, 9}}) + vox_transform(0, 1, {{"_t", "1 2 3"}}) +
                    vox_group(1, {2}) + vox_transform(2, 3, {{"_r", "4"}}, {{"_name", "n"}}) +
                    vox_shape(3, 0) + vox_chunk("MATL", int32(1) + vox_dictionary({{"_type", "_glass"}})),
                200);
  EXPECT_EQ(vox_error(whole), "");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(vox_error(whole.substr(0, length)), "") << "cut off after " << length << " bytes";
  }
}

TEST(Vox, ByteFlipsAreReadOrRefused) {
  // Every byte of a small file set to four values: no crash, no hang, no other exception.
  const std::string whole =
      vox_bytes(vox_model(2, 3, 2, {{0, 0, 0, 1}, {1, 2, 1, 9}}) +
                    vox_transform(0, 1, {{"_t", "1 2 3"}, {"_r", "4"}}) + vox_shape(1, 0),
                200);
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char value : {'\0', '\x01', '\x7f', '\xff'}) {
      std::string bytes = whole;
      bytes[at] = value;
      refused += vox_error(bytes).empty() ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace herr::test
