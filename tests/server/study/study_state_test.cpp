// What a study that goes on reads is what the one before wrote.
#include "server/study/study_state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sessions/files/input_error.h"
#include "tests/server/small_session.h"
#include "tests/server/study/report/study_records.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

class StudyStateTest : public ::testing::Test {
 protected:
  StudyState again(const StudyState& state) const {
    write_state(file(), state);
    return read_state(file());
  }
  std::filesystem::path file() const { return folder_.path() / "study.state.json"; }

 private:
  TemporaryFolder folder_;
};

StudyState full_state() {
  StudyState state;
  state.subject = "herr 1; session \"a\"\n; --threads 2";
  state.settings = {"default, N = 1", "polar 788x384, N = 64"};
  state.frames = 3;
  state.minutes = 2.5;
  state.dropped = {"combinations"};
  StudySetting pair;
  pair.name = pair.value = "--filter bicubic --polar 788x384";
  pair.knob = "combination";
  pair.changes = {{"filter", "bicubic"}, {"polar", "788x384"}};
  pair.own = OwnReference::pixels;
  pair.model = {{"probes", "on"}};
  state.combinations = {pair, pair};
  (*state.combinations)[1].own = OwnReference::none;
  StudyReference reference{"hard light", "pixels", 12, 77, test::error_table(0.1), true, 1.5};
  reference.error.value[2].fill(std::nan(""));
  state.references = {{9'000'000'000, reference}, {7, reference}};
  return state;
}

TEST_F(StudyStateTest, IsReadAsItWasWritten) {
  const StudyState state = full_state(), read = again(state);
  EXPECT_EQ(read.subject, state.subject);
  EXPECT_EQ(read.settings, state.settings);
  EXPECT_EQ(read.frames, 3u);
  EXPECT_EQ(read.minutes, 2.5);
  EXPECT_EQ(read.dropped, state.dropped);
  ASSERT_TRUE(read.combinations);
  ASSERT_EQ(read.combinations->size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const StudySetting &one = (*read.combinations)[i], &other = (*state.combinations)[i];
    EXPECT_EQ(one.name, other.name);
    EXPECT_EQ(one.value, other.value);
    EXPECT_EQ(one.knob, other.knob);
    EXPECT_EQ(one.changes, other.changes);
    EXPECT_EQ(one.model, other.model);
    EXPECT_EQ(one.own, other.own);
  }
  ASSERT_EQ(read.references.size(), 2u);
  EXPECT_EQ(read.references[0].first, 9'000'000'000);
  EXPECT_EQ(read.references[1].first, 7);
  const StudyReference &one = read.references[0].second, &other = state.references[0].second;
  EXPECT_EQ(one.name, other.name);
  EXPECT_EQ(one.settings, other.settings);
  EXPECT_EQ(one.passes, 12);
  EXPECT_EQ(one.most_passes, 77);
  EXPECT_TRUE(one.goal_met);
  EXPECT_EQ(one.seconds, 1.5);
  for (std::size_t band = 0; band < kBands; ++band) {
    for (std::size_t metric = 0; metric < kMetrics; ++metric) {
      const double a = one.error.value[band][metric], b = other.error.value[band][metric];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << band << " " << metric;
    }
  }
}

TEST_F(StudyStateTest, WhatIsNotDecidedYetStaysSo) {
  StudyState state;
  state.subject = "a";
  const StudyState read = again(state);
  EXPECT_FALSE(read.settings || read.combinations);
  EXPECT_TRUE(read.references.empty() && read.dropped.empty());
  state.settings.emplace(), state.combinations.emplace();  // decided: none
  const StudyState none = again(state);
  EXPECT_TRUE(none.settings && none.settings->empty());
  EXPECT_TRUE(none.combinations && none.combinations->empty());
}

TEST_F(StudyStateTest, DamagedFilesAreRefused) {
  write_state(file(), full_state());
  std::ifstream in(file());
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const auto& [found, damaged] : {std::pair<std::string, std::string>{"\"version\":1", "\"version\":2"},
                                       {"[\"combinations\"]", "[4]"},
                                       {"\"filter\",", ""},
                                       {"[9000000000,7]", "[7]"},
                                       {"[9000000000,7]", "[7,7.5]"},
                                       {"\"frames\":3", "\"frames\":-3"},
                                       {"\"minutes\":2.5", "\"minutes\":-2.5"}}) {
    std::string changed = text;
    const std::size_t at = changed.find(found);
    ASSERT_NE(at, std::string::npos) << found;
    changed.replace(at, found.size(), damaged);
    write_text(file(), changed);
    EXPECT_THROW(read_state(file()), InputError) << damaged;
  }
  write_text(file(), text.substr(0, text.size() / 2));
  EXPECT_THROW(read_state(file()), InputError);
}

}  // namespace
}  // namespace herr
