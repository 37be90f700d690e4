// Quaternions written w, x, y, z are told; those that are not stay quiet.
#include <gtest/gtest.h>

#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

std::vector<std::string> warnings_of(const std::string& rotation, const std::string& more = "") {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "a.scene.json",
      R"({"format_version": 1, "name": "a", "shapes": [{"name": "crate", "box": {"centre": [0, 0, -2],
          "half_extents": [1, 1, 1], "rotation_xyzw": )" +
          rotation + "}}]" + more + "}");
  return load_scene(file).warnings;
}

// By hand: (w, x, y, z) = (1, 0, 0, 0) turns by nothing, (0.7071, 0, 0.7071, 0) by 90 degrees about y; read
// as x, y, z, w both have w = 0, which is half a turn.
TEST(WrittenOrder, AQuaternionThatLooksWFirstIsToldWithWhatToWrite) {
  const std::vector<std::string> still = warnings_of("[1, 0, 0, 0]");
  ASSERT_EQ(still.size(), 1u);
  EXPECT_TRUE(
      contains(still[0],
               "a.scene.json:2: field shapes[0].box.rotation_xyzw is [1, 0, 0, 0], which looks w-first; "
               "here w is last: write [0, 0, 0, 1], or where half a turn is meant [-1, 0, 0, 0]"))
      << still[0];
  const std::vector<std::string> turned = warnings_of("[0.70711, 0, 0.70711, 0]");
  ASSERT_EQ(turned.size(), 1u);
  EXPECT_TRUE(contains(turned[0],
                       "write [0, 0.70711, 0, 0.70711], or where half a turn is meant [-0.70711, 0, "
                       "-0.70711, 0]"))
      << turned[0];
}

TEST(WrittenOrder, WLastAndHalfTurnsThatSaySoAreQuiet) {
  for (const char* rotation :
       {"[0, 0, 0, 1]", "[0, 1, 0, 0]", "[-1, 0, 0, 0]", "[0.7071068, 0, 0, 0.7071068]",
        "[0, 0.7071068, 0, 0.7071068]", "[0.6, 0.8, 0, 0]"})
    EXPECT_EQ(warnings_of(rotation).size(), 0u) << rotation;
}

TEST(WrittenOrder, EveryPlaceOfADocumentIsLookedAtAndToldOnce) {
  const std::vector<std::string> warnings =
      warnings_of("[1, 0, 0, 0]", R"(, "world_from_session": {"orientation_xyzw": [1, 0, 0, 0]})");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "field world_from_session.orientation_xyzw (and 1 more) is"))
      << warnings[0];
}

}  // namespace
}  // namespace herr::test
