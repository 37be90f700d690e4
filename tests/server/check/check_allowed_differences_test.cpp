// What --allow-different lets pass, what it says of it, and what it never lets pass.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "server/check/allowed_differences.h"
#include "server/check/measure/not_comparable.h"

namespace herr {
namespace {

std::string refusal(const std::string& text) {
  try {
    allowed_differences_from(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string not_comparable(const std::vector<FingerprintDifference>& found, const std::string& allowed) {
  try {
    told_differences(found, allowed.empty() ? AllowedDifferences() : allowed_differences_from(allowed), "W");
  } catch (const NotComparable& difference) {
    return difference.what();
  }
  return "";
}

const std::vector<FingerprintDifference> kScene{
    {"--scene", false, "--scene was a, is b"},
    {"b", true, "b was not among the inputs"},
    {"how the scene moves", true, "how the scene moves has changed"},
    {"a", true, "a is no longer among the inputs"}};
const FingerprintDifference kSamples{"--light-samples", false, "--light-samples was 1, is 4"};
const FingerprintDifference kProfile{"the display profile", true, "the display profile has changed"};
const FingerprintDifference kSpan{"--start, --duration, --frames", false, "the span differs"};
const FingerprintDifference kPose{"pose/data.csv", true, "pose/data.csv has changed"};
const FingerprintDifference kIsa{"--isa", false, "--isa was sse4, is avx2"};

TEST(AllowedDifferences, AreListedInAnyOrder) {
  const AllowedDifferences allowed = allowed_differences_from("settings,scene");
  EXPECT_TRUE(allowed.has(DifferentPart::scene));
  EXPECT_TRUE(allowed.has(DifferentPart::settings));
  EXPECT_FALSE(allowed.has(DifferentPart::session));
  EXPECT_TRUE(AllowedDifferences().empty());
}

TEST(AllowedDifferences, RefuseAWordWithTheNearestKnownOne) {
  EXPECT_NE(refusal("scenes").find("did you mean scene?"), std::string::npos) << refusal("scenes");
  EXPECT_NE(refusal("scene,seting").find("did you mean settings?"), std::string::npos)
      << refusal("scene,seting");
  EXPECT_NE(refusal(""), "");
  EXPECT_NE(refusal("scene,"), "");
  EXPECT_NE(refusal("scene,scene").find("named twice"), std::string::npos);
}

TEST(AllowedDifferences, NeverTakeInTheMachine) {
  for (const char* word : {"isa", "threads", "scene,cpu", "machine"}) {
    EXPECT_NE(refusal(word).find("may never differ"), std::string::npos) << word << ": " << refusal(word);
  }
  EXPECT_EQ(not_comparable({kIsa}, "scene,settings,session"), "W: --isa was sse4, is avx2");
  // No flag is offered that would not do.
  EXPECT_EQ(not_comparable({kSamples, kIsa}, ""), "W: --isa was sse4, is avx2");
}

TEST(AllowedDifferences, BelongToOnePartEach) {
  EXPECT_EQ(not_comparable(kScene, "scene"), "");
  EXPECT_NE(not_comparable(kScene, "settings,session"), "");
  EXPECT_EQ(not_comparable({kSamples}, "settings"), "");
  EXPECT_NE(not_comparable({kSamples}, "scene,session"), "");
  EXPECT_EQ(not_comparable({kPose}, "session"), "");
  EXPECT_NE(not_comparable({kPose}, "scene,settings"), "");
}

TEST(AllowedDifferences, OfWhatASessionOrAFlagSaysTakeEither) {
  for (const FingerprintDifference& either : {kProfile, kSpan}) {
    EXPECT_EQ(not_comparable({either}, "settings"), "");
    EXPECT_EQ(not_comparable({either}, "session"), "");
    EXPECT_NE(not_comparable({either}, "scene"), "");
  }
}

TEST(AllowedDifferences, AreToldByPart) {
  std::vector<FingerprintDifference> found{kSamples};
  found.insert(found.end(), kScene.begin(), kScene.end());
  const auto told = told_differences(found, allowed_differences_from("scene,settings"), "W");
  ASSERT_EQ(told.size(), 5u);
  EXPECT_EQ(told[0].part, "scene");
  EXPECT_EQ(told[0].text, "--scene was a, is b");
  EXPECT_EQ(told[4].part, "settings");
  EXPECT_EQ(told[4].text, "--light-samples was 1, is 4");
}

TEST(AllowedDifferences, AreOfferedWithEverythingThatIsNeeded) {
  EXPECT_EQ(not_comparable(kScene, ""),
            "W: --scene was a, is b; --allow-different scene compares all the same");
  std::vector<FingerprintDifference> found = kScene;
  found.push_back(kSamples);
  EXPECT_EQ(not_comparable(found, "scene"),
            "W: --light-samples was 1, is 4; --allow-different scene,settings compares all the same");
}

}  // namespace
}  // namespace herr
