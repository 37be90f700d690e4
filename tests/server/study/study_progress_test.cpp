// The line that tells what a study is at.
#include "server/study/study_progress.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

TEST(StudyProgress, TellsShareSettingAndTime) {
  EXPECT_EQ(study_progress_text(50, 200, "polar 788x768, N = 1, frame 2", 492.9, 1200),
            "study [#####---------------]  50/200  polar 788x768, N = 1, frame 2  8:12 of at most 20:00");
  EXPECT_EQ(study_progress_text(0, 0, "reference: hard light", 5, 90),
            "study [--------------------]  reference: hard light  0:05 of at most 1:30");
  // More than was expected: combinations come late.
  EXPECT_EQ(study_progress_text(201, 200, "x", 0, 60),
            "study [####################]  201/200  x  0:00 of at most 1:00");
}

TEST(StudyProgress, CutsLongNamesAndKeepsTheTime) {
  const std::string text = study_progress_text(1, 2, std::string(500, 'x'), 61, 3600);
  EXPECT_EQ(text.size(), 100u);
  EXPECT_TRUE(text.ends_with("xxx  1:01 of at most 60:00"));
  EXPECT_EQ(study_progress_text(1, 2, "a\033[2Jb", 0, 60).find('\033'), std::string::npos);
}

}  // namespace
}  // namespace herr
