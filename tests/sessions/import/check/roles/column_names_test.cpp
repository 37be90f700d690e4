#include "sessions/import/check/roles/column_names.h"

#include <gtest/gtest.h>

#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using Words = std::vector<std::string>;

TEST(ColumnNames, AreCutAtSignsAndCapitals) {
  EXPECT_EQ(words_of("HMDRotation.x").words, (Words{"hmd", "rotation", "x"}));
  EXPECT_EQ(words_of("gaze_direct_L.x").words, (Words{"gaze", "direct", "l", "x"}));
  EXPECT_EQ(words_of("HeadX").words, (Words{"head", "x"}));
}

TEST(ColumnNames, TellTheirUnit) {
  EXPECT_EQ(words_of("timestamp [ns]").unit, "ns");
  EXPECT_EQ(words_of("time_ms").unit, "ms");
  EXPECT_EQ(words_of("Pitch (deg)").unit, "deg");
  EXPECT_EQ(words_of("x [m]").unit, "m");
  EXPECT_EQ(words_of("s").unit, "");  // a name of one letter is no unit
}

TEST(ColumnNames, ThatDifferInOneLetterBelongTogether) {
  const test::RecordedFolder folder;
  folder.write("a.csv",
               "time,head_pos_x,head_pos_y,head_pos_z,qx,qy,qz,qw\n0,1,2,3,0,0,0,1\n1,1,2,3,0,0,0,1\n");
  const auto table = sniff_table(folder / "a.csv");
  ASSERT_TRUE(table);
  const auto groups = letter_groups(*table);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].xyz, (std::array<std::size_t, 3>{1, 2, 3}));
  EXPECT_FALSE(groups[0].w);
  EXPECT_EQ(groups[1].w, 7u);
}

TEST(ColumnNames, OfHandsAndEyesAreNotTheHeads) {
  EXPECT_GT(head_score(words_of("hmd_pos")), head_score(words_of("pos")));
  EXPECT_LT(head_score(words_of("left_hand_pos")), 0);
  EXPECT_LT(head_score(words_of("gaze_dir")), 0);
}

}  // namespace
}  // namespace herr
