// Texts that are numbers, and those that only begin with one.
#include "server/text/text_number.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

TEST(TextNumber, IsTheWholeText) {
  EXPECT_EQ(number_in("4"), 4);
  EXPECT_EQ(number_in("0.5"), 0.5);
  EXPECT_EQ(number_in("-2e3"), -2000);
  EXPECT_EQ(number_in("0"), 0);
  for (const char* text : {"", "acuity", "788x384", "4 ", " 4", "nan", "inf", "1e999"})
    EXPECT_FALSE(number_in(text)) << text;
}

}  // namespace
}  // namespace herr
