// The lines that `herr study --hz` gives to be pasted.
#include <gtest/gtest.h>

#include "server/study/rate/rate_subject.h"

namespace herr {
namespace {

// 1000 / 90 ms, to a hundredth: what the answer says of the period, too.
TEST(RateLines, HaveATargetThatOneCanRead) {
  StudyOptions options;
  options.session = "walk";
  options.hz = 90;
  EXPECT_EQ(command_line_of(options, {394, 384, 1, 0.5}),
            "herr replay walk --profile-scale 0.5 --polar 788x384 --light-samples 1 --clock realtime "
            "--target-ms 11.11 --format none --contact-sheet none");
  EXPECT_EQ(study_line_of(options, {{"probes", "off"}}), "herr study walk --hz 90 --no-probes");
}

}  // namespace
}  // namespace herr
