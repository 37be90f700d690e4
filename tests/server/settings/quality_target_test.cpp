// Targets as numbers and words.
#include "server/settings/quality_target.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

// 1000 / 90, / 72, / 60 and / 2 Hz.
TEST(QualityTarget, IsToldToAHundredth) {
  EXPECT_EQ(target_text(1000.0 / 90), "11.11");
  EXPECT_EQ(target_text(1000.0 / 72), "13.89");
  EXPECT_EQ(target_text(1000.0 / 60), "16.67");
  EXPECT_EQ(target_text(500), "500");
  EXPECT_EQ(target_text(12.5), "12.5");
}

}  // namespace
}  // namespace herr
