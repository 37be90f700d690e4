// Which slots changed since a number, against a slow, obvious record of every change.
#include "scenes/model/slot_changes.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace herr {
namespace {

TEST(SlotChangesTest, TellNothingOfWhatDidNotChange) {
  SlotChanges changes;
  changes.resize(3);
  std::vector<ChangedSlot> out{{7, true}};
  changes.since(0, out);
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(changes.latest(), 0u);
  EXPECT_FALSE(changes.relit_since(0));
}

TEST(SlotChangesTest, GoOnFromANumber) {
  SlotChanges changes(100);
  changes.resize(1);
  changes.note_moved(0);
  EXPECT_EQ(changes.latest(), 101u);
  std::vector<ChangedSlot> out;
  changes.since(100, out);
  EXPECT_EQ(out.size(), 1u);
}

TEST(SlotChangesTest, AgreeWithARecordOfEveryChange) {
  const std::uint32_t seed = 20261128;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  SlotChanges changes;
  std::vector<std::pair<std::uint32_t, bool>> record;  // slot, renewed; change number i + 1; none: relit
  constexpr std::uint32_t kLight = 1000;
  std::uint32_t slots = 1;
  changes.resize(slots);
  for (int step = 0; step < 3000; ++step) {
    if (slots < 40 && random() % 50 == 0) changes.resize(++slots);
    const auto slot = static_cast<std::uint32_t>(random() % slots);
    switch (random() % 5) {
      case 0:
        changes.note_relit();
        record.emplace_back(kLight, false);
        break;
      case 1:
        changes.note_renewed(slot);
        record.emplace_back(slot, true);
        break;
      default:
        changes.note_moved(slot);
        record.emplace_back(slot, false);
    }
    ASSERT_EQ(changes.latest(), record.size());
    const std::size_t seen = record.size() - random() % std::min<std::size_t>(record.size(), 60);
    std::vector<int> expected(slots, 0);  // 1: moved, 2: renewed
    bool relit = false;
    for (std::size_t i = seen; i < record.size(); ++i) {
      if (record[i].first == kLight) {
        relit = true;
      } else {
        expected[record[i].first] = std::max(expected[record[i].first], record[i].second ? 2 : 1);
      }
    }
    std::vector<ChangedSlot> out;
    changes.since(seen, out);
    std::vector<int> told(slots, 0);
    for (std::size_t i = 0; i < out.size(); ++i) {
      ASSERT_TRUE(i == 0 || out[i - 1].slot < out[i].slot) << "ascending, each once";
      told[out[i].slot] = out[i].renewed ? 2 : 1;
    }
    ASSERT_EQ(told, expected) << "step " << step << ", since " << seen;
    ASSERT_EQ(changes.relit_since(seen), relit);
  }
}

}  // namespace
}  // namespace herr
