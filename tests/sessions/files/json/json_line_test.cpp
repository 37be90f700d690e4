// Lines counted by hand.
#include "sessions/files/json/json_line.h"

#include <gtest/gtest.h>

#include <string>

namespace herr {
namespace {

constexpr const char* kText =
    "\n"                              // 1
    "{\n"                             // 2
    "  \"a\": 1, \"b\":\n"            // 3
    "    [2,\n"                       // 4
    "     {\"c\": [3,\n"              // 5
    "       4, {\"d\": \"}\\n{\",\n"  // 6
    "            \"dd\": true}]}\n"   // 7
    "    ],\n"                        // 8
    "  \"bb\": {\"c\": null}\n"       // 9
    "}\n";

TEST(JsonLine, IsThatOfAKeyOrAnElement) {
  EXPECT_EQ(json_line(kText, ""), 2);
  EXPECT_EQ(json_line(kText, "a"), 3);
  EXPECT_EQ(json_line(kText, "b"), 3);
  EXPECT_EQ(json_line(kText, "b[0]"), 4);
  EXPECT_EQ(json_line(kText, "b[1]"), 5);
  EXPECT_EQ(json_line(kText, "b[1].c"), 5);
  EXPECT_EQ(json_line(kText, "b[1].c[1]"), 6);
  EXPECT_EQ(json_line(kText, "b[1].c[2].d"), 6);
  EXPECT_EQ(json_line(kText, "b[1].c[2].dd"), 7);
  EXPECT_EQ(json_line(kText, "bb"), 9);
  EXPECT_EQ(json_line(kText, "bb.c"), 9);
}

TEST(JsonLine, OfWhatIsMissingIsThatOfWhatIsAroundIt) {
  EXPECT_EQ(json_line(kText, "e"), 2);
  EXPECT_EQ(json_line(kText, "b[1].e"), 5);
  EXPECT_EQ(json_line(kText, "b[1].c[2].d.e"), 6);
  EXPECT_EQ(json_line(kText, "b[11]"), 3) << "no element 1";
}

TEST(JsonLine, IsUnknownOfWhatIsNotOneValueOfJson) {
  EXPECT_EQ(json_line("", "a"), 0);
  EXPECT_EQ(json_line("{\"a\": 1", "a"), 0);
  EXPECT_EQ(json_line("{\"a\": 1}\n{\"a\": 2}\n", "a"), 0);
  EXPECT_EQ(json_line(std::string(100, '[') + std::string(100, ']'), "a"), 0);
}

}  // namespace
}  // namespace herr
