// Groups of relations are asked in order; one that throws, a signal and a wrong name have each their end.
#include "server/study/stability/stability_run.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>

#include "server/process/exit_code.h"
#include "server/study/relations/relation_case.h"
#include "server/study/stability/stability_folder.h"
#include "tests/server/study/stability/report/stability_records.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

void measure_two(const RelationCase&, RelationLog& log) {
  for (const char* name : {"first", "second"}) log.measured(test::result_of(name, 0, 1).relation, 0);
}
void measure_and_throw(const RelationCase&, RelationLog& log) {
  log.measured(test::result_of("before", 0, 1).relation, 0);
  throw std::runtime_error("it broke");
}
void measure_without_memory(const RelationCase&, RelationLog&) {
  throw std::bad_alloc();
}
// As a relation may that expects some.
void measure_and_swallow(const RelationCase&, RelationLog& log) {
  for (const char* name : {"first", "second"}) {
    try {
      log.measured(test::result_of(name, 0, 1).relation, 0);
    } catch (const std::exception&) {
    }
  }
}

struct Asked {
  std::optional<std::vector<RelationResult>> results;
  std::string heard;
};

// Asks to stop once `most` relations were told.
Asked ask(const std::vector<RelationGroup>& groups, int most = 1000) {
  Asked asked;
  int told = 0;
  const StabilityEars ears{[&](const RelationGroup& group) { asked.heard += std::string(group.name) + "("; },
                           [&](const RelationResult& result) {
                             asked.heard += result.relation.name + ")";
                             ++told;
                           }};
  RelationCase nothing;
  asked.results = measure_groups(groups, nothing, ears, [&] { return told >= most; });
  return asked;
}

TEST(StabilityRun, AsksGroupsInOrderAndTellsEachResult) {
  const Asked asked = ask({{"a", "", measure_two}, {"b", "", measure_two}});
  ASSERT_TRUE(asked.results);
  EXPECT_EQ(asked.results->size(), 4u);
  EXPECT_EQ(asked.results->at(2).group, "b");
  EXPECT_EQ(asked.heard, "a(first)second)b(first)second)");
}

TEST(StabilityRun, AGroupThatThrowsIsARelationThatFailsAndTheNextGoesOn) {
  const Asked asked = ask({{"a", "", measure_and_throw}, {"b", "", measure_two}});
  ASSERT_TRUE(asked.results);
  ASSERT_EQ(asked.results->size(), 4u);
  const RelationResult& broken = asked.results->at(1);
  EXPECT_EQ(broken.group, "a");
  EXPECT_FALSE(broken.holds());
  EXPECT_TRUE(broken.counts());
  EXPECT_NE(broken.where.find("it broke"), std::string::npos);
  EXPECT_TRUE(asked.results->at(3).holds());
}

TEST(StabilityRun, WhatAnotherTryMayMendIsNoFaultOfARelation) {
  EXPECT_THROW(ask({{"a", "", measure_without_memory}}), std::bad_alloc);
}

TEST(StabilityRun, StopsAfterTheRelationAtHand) {
  for (const auto measure : {measure_two, measure_and_swallow}) {
    const Asked asked = ask({{"a", "", measure}, {"b", "", measure}}, 1);
    EXPECT_FALSE(asked.results);
    EXPECT_EQ(asked.heard, "a(first)");
  }
}

TEST(StabilityRun, TakesGroupsByNameInTheirOwnOrder) {
  const std::vector<RelationGroup> some = wanted_groups({"light", "place", "light"});
  ASSERT_EQ(some.size(), 2u);
  EXPECT_STREQ(some[0].name, "place");
  EXPECT_STREQ(some[1].name, "light");
  EXPECT_EQ(wanted_groups({}).size(), relation_groups().size());
  try {
    wanted_groups({"place", "ligth"});
    ADD_FAILURE() << "taken";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "--only: 'ligth' is no group of relations; did you mean 'light'?");
  }
}

TEST(StabilityFolder, KeepsAnEarlierReportUnlessToldAndOtherFilesAlways) {
  const TemporaryFolder root;
  const auto put = [&](const char* name) { std::ofstream(root.path() / name) << "earlier"; };
  const auto prepare = [&](bool overwrite) { (void)StabilityFolder(root.path()).prepare(overwrite); };
  put("letter.txt");
  for (const bool overwrite : {false, true}) EXPECT_THROW(prepare(overwrite), UsageError);
  put("stability.json"), put("stability.html.tmp.4711");
  EXPECT_THROW(prepare(false), UsageError);
  EXPECT_TRUE(std::filesystem::exists(root.path() / "stability.json"));
  prepare(true);
  EXPECT_EQ(root.names(), std::vector<std::string>{"letter.txt"});
  const FolderLock lock = StabilityFolder(root.path() / "new").prepare(false);
  EXPECT_THROW((void)StabilityFolder(root.path() / "new").prepare(true), TemporaryError);
}

}  // namespace
}  // namespace herr
