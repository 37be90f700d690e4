// The line that a terminal shows while relations are asked.
#include "server/study/stability/stability_progress.h"

#include <gtest/gtest.h>

#include <string>

namespace herr {
namespace {

// Of 20 marks a tenth for each group that is done: at the fourth of ten three are.
TEST(StabilityProgress, TellsGroupsDoneWhatIsAtHandAndTheTime) {
  EXPECT_EQ(stability_progress_text(4, 10, "light: two lights", 61.6),
            "stability [######--------------]  group 4 of 10  light: two lights  62 s");
  EXPECT_EQ(stability_progress_text(1, 1, "a", 0), "stability [--------------------]  group 1 of 1  a  0 s");
}

TEST(StabilityProgress, CutsLongNamesAndKeepsTheTime) {
  const std::string text = stability_progress_text(1, 10, std::string(300, 'x'), 5);
  EXPECT_EQ(text.size(), 100u);
  EXPECT_TRUE(text.ends_with("x  5 s")) << text;
}

}  // namespace
}  // namespace herr
