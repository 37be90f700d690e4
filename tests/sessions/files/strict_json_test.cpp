#include "sessions/files/strict_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sessions/files/input_error.h"
#include "tests/sessions/recorded_folder.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

using test::error_of;

nlohmann::json parse(std::string_view text, const JsonLimits& limits = {}) {
  return parse_json_text(text, "a.json", 1, limits);
}

TEST(StrictJson, ReadsEveryKindOfValue) {
  const nlohmann::json value = parse(R"({"a": [1, -2, 3.5, true, null, "x"], "b": {"c": {}}, "d": []})");
  EXPECT_EQ(value, nlohmann::json::parse(R"({"a": [1, -2, 3.5, true, null, "x"], "b": {"c": {}}, "d": []})"));
  EXPECT_EQ(parse("\xef\xbb\xbf 7"), 7) << "a byte-order mark is legal";
}

TEST(StrictJson, WhatOtherProgramsWriteIsToldWithWhatToWriteInstead) {
  const struct {
    std::string text, message;
  } cases[] = {
      {"{\"a\": 1,}", "a.json:1: is not JSON: a comma stands before '}'; remove that comma"},
      {"[1,\n2,\n]", "a.json:3: is not JSON: a comma stands before ']'; remove that comma"},
      {"{\"a\": NaN}",
       "a.json:1: is not JSON: it has no NaN; write a finite number such as 0, or leave the field out"},
      {"[1,\nnan]", "a.json:2: is not JSON: it has no nan; write a finite number"},
      {"[-Infinity]", "a.json:1: is not JSON: it has no -Infinity; write a finite number"},
      {"[True]", "a.json:1: is not JSON: it has no True; write true"},
      {"[None]", "a.json:1: is not JSON: it has no None; write null"},
      {"[+1.5]", "a.json:1: is not JSON: it has no number +1.5; write 1.5"},
      {"[-.5]", "a.json:1: is not JSON: it has no number -.5; write -0.5"},
      {"{'a': 1}", "a.json:1: is not JSON: a text stands in ' '; write it in \" \""},
      {"{}\n// done", "a.json:2: is not JSON: it has no comments; remove this one"},
      {"{\"a\": 1 \"b\": 2}", "a.json:1: is not JSON: a comma is missing before \"b\"; write ',' there"},
      {"{\"a\": \"x\"\n\n\"b\": 2}",
       "a.json:3: is not JSON: a comma is missing after line 1; write ',' there"},
      {"[{}\n{}]", "a.json:2: is not JSON: a comma is missing after line 1; write ',' there"},
      {"{\u201ca\u201d: 1}", "a.json:1: is not JSON: it has typographic quotes; write \""},
      {"{\"a\" 1}", "a.json:1: is not JSON: syntax error"},
      {"{\"a\" \"b\"}", "a.json:1: is not JSON: syntax error"},
  };
  for (const auto& [text, message] : cases) EXPECT_INPUT_ERROR(parse(text), message) << text;
}

TEST(StrictJson, RefusesWhatLenientParsersLetPassAndNamesTheLine) {
  const struct {
    std::string text, part;
  } cases[] = {
      {"{\"a\": 1,\n\"b\": 2,\n\"a\": 3}", "a.json:3: key 'a' stands twice"},
      {"{\"x\": {\"a\": 1, \"a\": 1}}", "key 'a' stands twice"},
      {std::string("{}\0garbage", 10), "a.json:1: holds a NUL byte"},
      {std::string("{\n\n\0}", 5), "a.json:3: holds a NUL byte"},
      {"{\"a\":\n1e999}", "a.json:2: "},
      {"{\"a\": NaN}", "a.json:1: is not JSON"},
      {"{\"a\": 1,}", "a.json:1: is not JSON"},
      {"{\"a\": 1}\n{", "a.json:2: is not JSON"},
      {"{\"a\": 1", "is not JSON"},
      {"// comment\n{}", "is not JSON"},
      {"", "is empty"},
      {" \n\t", "is empty"},
      {"\xff\xfe{\0}\0", "UTF-16"},
      {"{\"a\": \"\xff\"}", "is not JSON"},
  };
  for (const auto& [text, part] : cases) EXPECT_INPUT_ERROR(parse(text), part) << text;
}

TEST(StrictJson, BoundsDepthCountAndSize) {
  JsonLimits limits;
  limits.max_depth = 3;
  EXPECT_EQ(error_of([&] { parse("[[[]]]", limits); }), "no error");
  EXPECT_INPUT_ERROR(parse("[[[[]]]]", limits), "nested deeper than 3");
  limits.max_values = 4;  // the array and three numbers
  EXPECT_EQ(error_of([&] { parse("[1,2,3]", limits); }), "no error");
  EXPECT_INPUT_ERROR(parse("[1,2,3,4]", limits), "more than 4 values");
  limits.max_bytes = 5;
  EXPECT_INPUT_ERROR(parse("[1,2,3]", limits), "more than 5 bytes");
}

TEST(StrictJson, SurvivesNestingThatWouldOverflowAStack) {
  EXPECT_INPUT_ERROR(parse(std::string(10'000'000, '[')), "nested deeper than 64");
}

TEST(StrictJson, CountsLinesFromTheLineOfItsText) {
  EXPECT_INPUT_ERROR(parse_json_text("{\"a\" 1}", "e.jsonl", 41), "e.jsonl:41: ");
}

class Fields : public testing::Test {
 protected:
  nlohmann::json document = parse(R"({"num": 2.5, "int": 7, "huge": 4294967297, "wide": 18446744073709551615,
      "past": 18446744073709551616, "real": 1.0, "exp": 1e3, "flag": true, "text": "hi", "nul": "a\u0000b",
      "vec": [1, 2, 3], "short": [1, 2], "mixed": [1, "2", 3], "object": {"inner": {"deep": 1}}, "list": [{"x": 1}, 2]})");
  JsonObject root{document, "f.json", ""};
};

TEST_F(Fields, AreReadWithinTheirRange) {
  EXPECT_EQ(root.number("num", 0, 3), 2.5);
  EXPECT_EQ(root.number("int", 0, 10), 7);
  EXPECT_EQ(root.integer("huge", 0, INT64_MAX), 4294967297);
  EXPECT_EQ(root.number_or("absent", 0, 1, 0.5), 0.5);
  EXPECT_EQ(root.integer_or("absent", 0, 1, 9), 9);
  EXPECT_TRUE(root.boolean_or("flag", false));
  EXPECT_EQ(root.text("text"), "hi");
  EXPECT_EQ(root.text_or("absent", "x"), "x");
  EXPECT_EQ(root.vec3("vec", 0, 9), glm::dvec3(1, 2, 3));
  EXPECT_EQ(root.object("object").object("inner").integer("deep", 0, 1), 1);
  EXPECT_TRUE(root.objects("absent").empty());
}

TEST_F(Fields, AreRefusedWithTheirPath) {
  EXPECT_INPUT_ERROR(root.number("num", 0, 2), "field num is 2.5, out of range");
  EXPECT_INPUT_ERROR(root.number("text", 0, 2), "field text is a text, not a number");
  // 2^32 + 1 is 1 when it is cut to 32 bits.
  EXPECT_INPUT_ERROR(root.integer("huge", 0, INT32_MAX), "field huge is 4294967297, out of range");
  EXPECT_INPUT_ERROR(root.integer("wide", 0, INT64_MAX), "field wide is 18446744073709551615, out of range");
  EXPECT_INPUT_ERROR(root.integer("past", 0, INT64_MAX), "not a whole number");
  EXPECT_INPUT_ERROR(root.integer("real", 0, 2), "not a whole number");
  EXPECT_INPUT_ERROR(root.integer("exp", 0, 2000), "not a whole number");
  EXPECT_INPUT_ERROR(root.text("nul"), "NUL character");
  EXPECT_INPUT_ERROR(root.text("int"), "field int is a number, not a text");
  EXPECT_INPUT_ERROR(root.boolean_or("int", true), "write true or false");
  EXPECT_INPUT_ERROR(root.vec3("short", 0, 9), "field short has 2 elements");
  EXPECT_INPUT_ERROR(root.vec3("mixed", 0, 9), "field mixed[1] is a text");
  EXPECT_INPUT_ERROR(root.text("absent"), "field absent is missing");
  EXPECT_INPUT_ERROR(root.objects("list"), "field list[1] is a number, not an object");
  EXPECT_INPUT_ERROR(root.object("object").object("inner").number("deep", 2, 3),
                     "field object.inner.deep is 1");
}

// The double after 1 is 1 + 2^-52; pi/2 as a float is 1.57079637..., as a double 1.5707963267948966.
TEST(RangesInMessages, HaveEnoughDigitsToTellANumberFromTheEndThatItPasses) {
  const nlohmann::json document = parse(R"({"next": 1.0000000000000002, "cone": 1.5707963705062866})");
  const JsonObject root(document, "f.json", "");
  EXPECT_INPUT_ERROR(root.number("next", 0, 1),
                     "field next is 1.0000000000000002, out of range; write a "
                     "number from 0 to 1");
  EXPECT_INPUT_ERROR(root.number("cone", 0.001, 1.5707963267948966),
                     "is 1.5707963705062866, out of range; write a number from 0.001 to 1.5707963267948966");
}

TEST(RangesInMessages, OfAnIndexIntoAnEmptyListSayThatThereIsNothing) {
  const nlohmann::json document = parse(R"({"mesh": 0, "wrong": "x"})");
  const JsonObject root(document, "f.json", "");
  EXPECT_INPUT_ERROR(
      root.integer("mesh", 0, -1),
      "field mesh is 0, and there is none that it could name; remove it, or add what it names");
  EXPECT_INPUT_ERROR(root.integer("wrong", 0, -1), "remove it");
}

TEST(UnitQuaternion, IsReadAsWrittenAndOtherwiseToldWithItsOrder) {
  const nlohmann::json document =
      parse(R"({"unit": [0, 0.7071068, 0, 0.7071068], "degrees": [0, 90, 0, 1], "short": [0, 90, 0]})");
  const JsonObject root(document, "f.json", "");
  EXPECT_EQ(root.unit_quaternion("unit"), (std::array{0.0, 0.7071068, 0.0, 0.7071068}));
  // sqrt(90^2 + 1^2) = 90.00556
  EXPECT_INPUT_ERROR(root.unit_quaternion("degrees"),
                     "f.json: field degrees is [0, 90, 0, 1], not of unit length but 90.0056, as if degrees "
                     "stood in it; write a unit quaternion x, y, z, w: [0, 0, 0, 1] is no turn");
  EXPECT_INPUT_ERROR(root.unit_quaternion("short"), "field short has 3 elements; write a unit quaternion");
}

TEST(LinesOfFields, StandInErrorsOfFilesAndOfLines) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.json", "{\n  \"a\": {\n    \"b\": [1,\n      \"x\"]}\n}\n");
  const JsonDocument document(file);
  const JsonObject inner = document.root().object("a");
  EXPECT_INPUT_ERROR(inner.numbers("b", 2, 0, 9), "a.json:4: field a.b[1] is a text");
  EXPECT_INPUT_ERROR(inner.text("c"), "a.json:2: field a.c is missing");
  EXPECT_INPUT_ERROR(document.root().require_version(3),
                     "a.json:1: field format_version is missing; add \"format_version\": 3");
  const JsonDocument line(R"({"t_ns": "x"})", "events.jsonl", 7);
  EXPECT_INPUT_ERROR(line.root().integer("t_ns", 0, 9), "events.jsonl:7: field t_ns is a text");
}

TEST(UnknownKey, IsNamedWithItsNearestKnownKey) {
  const nlohmann::json document = parse(R"({"display_profle": 1})");
  const JsonObject root(document, "f.json", "outer");
  EXPECT_INPUT_ERROR(root.allow_only({"name", "display_profile"}),
                     "f.json: field outer.display_profle is not known; did you mean 'display_profile'?");
  EXPECT_NO_THROW(root.allow_only({"display_profle"}));
}

TEST(InputErrorText, IsOneLineAndSafeToPrint) {
  const InputError error("a\nb.csv", 3, "bad \x1b[31m byte \xff", "fix");
  EXPECT_STREQ(error.what(), "a\\x0ab.csv:3: bad \\x1b[31m byte \\xff; fix");
  EXPECT_EQ(printable("caf\xc3\xa9"), "caf\xc3\xa9") << "well-formed UTF-8 stays";
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b") << "C1 controls move a terminal's cursor";
  EXPECT_EQ(printable("\xc0\x80\xed\xa0\x80"), "\\xc0\\x80\\xed\\xa0\\x80") << "overlong and surrogate";
  EXPECT_LE(printable(std::string(5000, '\xff')).size(), 200u);
  EXPECT_EQ(printable(std::string(200, 'x')), std::string(200, 'x'));
  EXPECT_EQ(printable(std::string(201, 'x')), std::string(197, 'x') + "...");
}

}  // namespace
}  // namespace herr
