#include "sessions/files/nearest_name.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace herr {
namespace {

using Names = std::vector<std::string>;

TEST(NearestName, IsTheOneThatFewLettersTellApart) {
  EXPECT_EQ(nearest_name("vergance", {"name", "vergence_m", "scene"}), "vergence_m");
  EXPECT_EQ(nearest_name("nmae", {"scene", "name"}), "name") << "two letters that changed places count once";
  EXPECT_EQ(nearest_name("x", {}), "");
}

TEST(NearestName, ABeginningCountsBeforeAnyDistance) {
  const Names flags{"--quality", "--density-overlay", "--light-samples", "--duration"};
  EXPECT_EQ(nearest_name("--density", flags), "--density-overlay");
  EXPECT_EQ(nearest_name("--light", flags), "--light-samples");
  EXPECT_EQ(nearest_name("rotation", {"animation", "rotation_xyzw"}), "rotation_xyzw");
}

TEST(NearestName, IsNoneWhereMoreThanAThirdOfTheLettersDiffer) {
  EXPECT_EQ(nearest_name("high", {"hard", "soft"}), "");
  EXPECT_EQ(nearest_name("help", {"check", "replay"}), "");
  EXPECT_EQ(nearest_name("--vergence", {"--licence", "--variant"}), "");
  EXPECT_EQ(nearest_name("position", {"direction", "centre"}), "");
  EXPECT_EQ(nearest_name("xy", {"ab"}), "");
}

TEST(KeyRemedy, KnowsTheNamesOfOtherPrograms) {
  const Names material{"base_colour", "metallic", "roughness", "mirror"};
  const Names light{"name", "kind", "centre", "direction", "intensity_w_sr"};
  const Names entry{"file", "translation", "rotation_xyzw", "animation"};
  EXPECT_EQ(key_remedy("color", material), "did you mean 'base_colour'?");
  EXPECT_EQ(key_remedy("color", light),
            "did you mean 'intensity_w_sr' (watts per steradian, red, green, blue)?");
  EXPECT_EQ(key_remedy("rotation", entry), "did you mean 'rotation_xyzw' (a quaternion x, y, z, w)?");
  EXPECT_EQ(key_remedy("position", light), "did you mean 'centre' (metres)?");
  EXPECT_EQ(key_remedy("position", entry), "did you mean 'translation' (metres)?");
}

TEST(KeyRemedy, ListsWhatIsKnownWhereNothingIsNear) {
  EXPECT_EQ(key_remedy("zzz", {"min", "max"}), "known here: min, max");
  EXPECT_EQ(key_remedy("mox", {"min", "max"}), "did you mean 'max'?");
  EXPECT_EQ(key_remedy("zzz", {}), "remove it");
}

}  // namespace
}  // namespace herr
