// Numbers a hair outside their range: taken as its end with a warning; further out they are refused.
#include "scenes/gltf/format/rounded_number.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sessions/files/input_error.h"

namespace herr::test {
namespace {

using nlohmann::json;

JsonObject object_of(const json& document) {
  return {document, "m.gltf", "materials[0]"};
}

// 1e-4 of the end 1 is 0.9999 ... 1.0001, of the end pi/2 it is 1.5e-4, of the end 0 of a range of width 1e9
// it is 1e-4 and not 1e5.
TEST(RoundedNumber, IsTakenAsTheEndOfItsRangeWithin1e4OfIt) {
  const json document{{"one", 1.0000001192092896}, {"cone", 1.5707963705062866}, {"zero", -0.00009}};
  const JsonObject object = object_of(document);
  RoundedNumbers rounded;
  EXPECT_EQ(rounded.number_or(object, "one", 0, 1, 0.5), 1.0);
  EXPECT_EQ(rounded.number_or(object, "cone", 0.001, 1.5707963267948966, 1), 1.5707963267948966);
  EXPECT_EQ(rounded.number_or(object, "zero", 0, 1e9, 1), 0.0);
  EXPECT_EQ(rounded.number_or(object, "absent", 0, 1, 0.5), 0.5);
  std::vector<std::string> warnings;
  rounded.warn(warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "field materials[0].one is 1.0000001192092896, out of range; taken as 1, and 2 numbers more");
}

TEST(RoundedNumber, FurtherOutIsRefused) {
  const json document{{"one", 1.00011}, {"zero", -0.00011}, {"light", -1.0}};
  const JsonObject object = object_of(document);
  RoundedNumbers rounded;
  EXPECT_THROW(rounded.number_or(object, "one", 0, 1, 0.5), InputError);
  EXPECT_THROW(rounded.number_or(object, "zero", 0, 1, 0.5), InputError);
  EXPECT_THROW(rounded.number_or(object, "light", 0, 1e9, 0.5), InputError);
  EXPECT_THROW(rounded.number_or(object, "light", 0, 1, 0.5, OutOfRange::clamped_above), InputError);
}

TEST(RoundedNumber, IsItsOwnEndWhereOlderFilesMayBeFarAbove) {
  const json document{{"emissiveFactor", {2.5, 0.5, -1e-7}}};
  const JsonObject object = object_of(document);
  RoundedNumbers rounded;
  EXPECT_THROW(rounded.vec3_or(object, "emissiveFactor", 0, 1, glm::dvec3(0)), InputError);
  EXPECT_EQ(rounded.vec3_or(object, "emissiveFactor", 0, 1, glm::dvec3(0), OutOfRange::clamped_above),
            glm::dvec3(1, 0.5, 0));
  std::vector<std::string> warnings;
  rounded.warn(warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "field materials[0].emissiveFactor[0] is 2.5, out of range; taken as 1, and 1 number more");
}

TEST(RoundedNumber, IsItsEndOnEitherSideWhereOtherReadersReadNothing) {
  const json document{{"low", -0.5}, {"high", 7}};
  const JsonObject object = object_of(document);
  RoundedNumbers rounded;
  EXPECT_EQ(rounded.number_or(object, "low", 0, 1, 0.5, OutOfRange::clamped), 0.0);
  EXPECT_EQ(rounded.number_or(object, "high", 0, 1, 0.5, OutOfRange::clamped), 1.0);
  std::vector<std::string> warnings;
  rounded.warn(warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "field materials[0].low is -0.5, out of range; taken as 0, and 1 number more");
}

TEST(RoundedNumber, InItsRangeIsNotSpokenOf) {
  const json document{{"a", 0}, {"b", {0, 0.5, 1}}};
  const JsonObject object = object_of(document);
  RoundedNumbers rounded;
  EXPECT_EQ(rounded.number_or(object, "a", 0, 1, 0.5), 0.0);
  EXPECT_EQ(rounded.numbers(object, "b", 3, 0, 1), (std::vector<double>{0, 0.5, 1}));
  std::vector<std::string> warnings;
  rounded.warn(warnings);
  EXPECT_TRUE(warnings.empty());
}

}  // namespace
}  // namespace herr::test
