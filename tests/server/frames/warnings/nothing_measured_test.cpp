// A measurement over frames that show no object is warned of.
#include <gtest/gtest.h>

#include "server/frames/warnings/picture_warnings.h"

namespace herr {
namespace {

TEST(NothingMeasured, IsWarnedOfWhereNoSampleMetAnObject) {
  EXPECT_EQ(nothing_measured_warning(1), "");
  EXPECT_EQ(nothing_measured_warning(0.5), "");
  EXPECT_EQ(nothing_measured_warning(0).find("no virtual object was in view in any frame that was measured"),
            0u);
}

}  // namespace
}  // namespace herr
