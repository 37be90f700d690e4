// What the clock of a recording did, told from its stamps alone.
#include "sessions/import/stamps/stamp_survey.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

// Stamps in ns, one a row, from line 2 on, as behind a header; all in line 1 where `one_line` says so.
class StampRows : public RowSource {
 public:
  explicit StampRows(const std::vector<TimeNs>& stamps, bool one_line = false)
      : RowSource("stamps.csv", '.'), one_line_(one_line) {
    for (const TimeNs stamp : stamps) texts_.push_back(std::to_string(stamp));
    fields_.resize(1);
    line_ = 1;
  }
  bool has(const ColumnRef&) const override { return true; }
  std::size_t place(const ColumnRef&) override { return 0; }
  bool next() override {
    if (row_ == texts_.size()) return false;
    line_ += one_line_ ? 0 : 1;
    fields_[0] = texts_[row_++];
    return true;
  }

 private:
  bool one_line_;
  std::vector<std::string> texts_;
  std::size_t row_ = 0;
};

StampSurvey survey_of(const std::vector<TimeNs>& stamps, std::size_t sort_rows = 0, bool one_line = false) {
  StampRows rows(stamps, one_line);
  TimeColumns columns;
  columns.column = {"t", 0};
  columns.unit = TimeUnit::ns;
  TimeReader time(rows, columns);
  return survey_stamps(rows, time, sort_rows);
}

constexpr TimeNs kMs = 1'000'000, kS = 1'000'000'000;
constexpr TimeNs kStep = 11 * kMs;

// `count` stamps from `first` on, a step apart.
std::vector<TimeNs> steady(TimeNs first, int count, TimeNs step = kStep) {
  std::vector<TimeNs> stamps;
  for (int i = 0; i < count; ++i) stamps.push_back(first + i * step);
  return stamps;
}

std::vector<TimeNs> operator+(std::vector<TimeNs> a, const std::vector<TimeNs>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// "FIRST-LAST key" of each entry, by lines.
std::string left_out(const StampSurvey& survey) {
  std::string text;
  for (const LeftOutRows& rows : survey.left_out)
    text += (text.empty() ? "" : ", ") + std::to_string(rows.first.line) + "-" +
            std::to_string(rows.last.line) + " " +
            std::string(row_fate_texts()[static_cast<std::size_t>(rows.fate)].key);
  return text;
}

std::string remarks(const StampSurvey& survey) {
  std::string text;
  for (const std::string& remark : survey.remarks) text += (text.empty() ? "" : "\n") + remark;
  return text;
}

TEST(StampSurvey, OfASteadyClockSaysNothing) {
  const StampSurvey survey = survey_of(steady(5 * kS, 3000));
  EXPECT_EQ(left_out(survey), "");
  EXPECT_EQ(remarks(survey), "");
  EXPECT_EQ(survey.rows, 3000);
  EXPECT_EQ(survey.usual_step_ns, 11e6);
  EXPECT_EQ(survey.first_ns, 5 * kS);
  EXPECT_EQ(survey.last_ns, 5 * kS + 2999 * kStep);
  EXPECT_EQ(survey.thin_below_ns, 0);
  EXPECT_FALSE(survey.all_equal);
}

// 60 rows in lines 2 to 61, the same stamps again in lines 62 to 121. Of two runs of 60 the earlier stays.
TEST(StampSurvey, NamesAClockThatStartsAgain) {
  const StampSurvey survey = survey_of(steady(kS / 2, 60) + steady(kS / 2, 60));
  EXPECT_EQ(left_out(survey), "62-121 other_clock");
  EXPECT_EQ(remarks(survey), "60 of 120 rows lie before the newest stamp: the clock was reset at line 62");
}

TEST(StampSurvey, KeepsTheLongerPartWhereverTheClockIsReset) {
  const StampSurvey late = survey_of(steady(kS, 80) + steady(kS, 40));
  EXPECT_EQ(left_out(late), "82-121 other_clock");
  EXPECT_EQ(remarks(late), "40 of 120 rows lie before the newest stamp: the clock was reset at line 82");
  const StampSurvey early = survey_of(steady(kS, 40) + steady(kS, 80));
  EXPECT_EQ(left_out(early), "2-41 other_clock");
  EXPECT_EQ(
      remarks(early),
      "40 of 120 rows lie before line 42, where the clock was reset and a longer recording begins: they "
      "were left out");
  EXPECT_EQ(early.last_ns, kS + 79 * kStep);
}

// Neither recording is continued with the other's rows, though each has hitches and the second lasts longer.
TEST(StampSurvey, DoesNotSewTwoRecordingsTogether) {
  const auto first = steady(0, 100) + steady(1200 * kMs, 300);
  const auto second = steady(0, 350) + steady(5 * kS, 150);
  EXPECT_EQ(left_out(survey_of(first + second)), "2-401 other_clock");
}

TEST(StampSurvey, LeavesOutOneWildStampAndNotTheRest) {
  for (const TimeNs off : {2147483 * kS, 5 * kS, 100 * kMs, -100 * kMs, -900 * kMs, -5 * kS})
    for (const int row : {1, 10, 500, 1500}) {
      SCOPED_TRACE(std::to_string(off) + " ns in row " + std::to_string(row));
      auto stamps = steady(10 * kS, 2000);
      stamps[static_cast<std::size_t>(row)] += off;
      const StampSurvey survey = survey_of(stamps);
      const std::string line = std::to_string(row + 2);
      // A row that comes at most 64 steps late is disorder, not a wild clock.
      const std::string fate = off < 0 && off > -64 * kStep ? "backward_stamp" : "wild_stamp";
      EXPECT_EQ(left_out(survey), line + "-" + line + " " + fate);
      EXPECT_EQ(survey.last_ns, 10 * kS + 1999 * kStep);
    }
}

TEST(StampSurvey, LeavesOutAWildFirstOrLastStamp) {
  const auto good = steady(1000 * kS, 100);
  EXPECT_EQ(left_out(survey_of(steady(0, 1) + good)), "2-2 wild_stamp");
  EXPECT_EQ(left_out(survey_of(steady(2147483 * kS, 1) + good)), "2-2 wild_stamp");
  EXPECT_EQ(left_out(survey_of(steady(1005 * kS, 1) + good)), "2-2 wild_stamp");
  EXPECT_EQ(left_out(survey_of(good + steady(0, 1))), "102-102 wild_stamp");
  const StampSurvey survey = survey_of(good + steady(2147483 * kS, 1));
  EXPECT_EQ(left_out(survey), "102-102 wild_stamp");
  EXPECT_EQ(survey.first_ns, 1000 * kS);
  EXPECT_EQ(survey.last_ns, 1000 * kS + 99 * kStep);
  EXPECT_EQ(remarks(survey), "");
}

TEST(StampSurvey, LeavesOutSeveralWildStampsInARow) {
  const auto before = steady(10 * kS, 10), after = steady(10 * kS + 12 * kStep, 80);
  for (const auto& wild : {std::vector<TimeNs>{2147483 * kS, 2147483 * kS + kStep},
                           {500 * kS, 90 * kS},
                           {90 * kS, 500 * kS},
                           {kS, 500 * kS},
                           {0, 3 * kS},
                           {3 * kS, 0},
                           {0, 0}}) {
    SCOPED_TRACE(std::to_string(wild[0]) + ", " + std::to_string(wild[1]));
    const StampSurvey survey = survey_of(before + wild + after);
    std::int64_t rows = 0;
    for (const LeftOutRows& part : survey.left_out) {
      EXPECT_EQ(part.fate, RowFate::wild_stamp);
      rows += part.last.line - part.first.line + 1;
    }
    EXPECT_EQ(rows, 2);
    ASSERT_FALSE(survey.left_out.empty());
    EXPECT_EQ(survey.left_out.front().first.line, 12);
    EXPECT_EQ(survey.left_out.back().last.line, 13);
  }
}

// Ten rows of another clock, then the old one goes on.
TEST(StampSurvey, LeavesOutAClockThatJumpsAndComesBack) {
  for (const TimeNs off : {500 * kS, 5 * kS, -5 * kS}) {
    auto stamps = steady(10 * kS, 300);
    for (std::size_t i = 100; i < 110; ++i) stamps[i] += off;
    EXPECT_EQ(left_out(survey_of(stamps)), "102-111 wild_stamp") << off;
  }
}

TEST(StampSurvey, KeepsHitchesAndPauses) {
  EXPECT_EQ(
      left_out(survey_of(steady(0, 2) + steady(333 * kMs, 50) + steady(2 * kS, 1) + steady(3 * kS, 70))), "");
  // 20 s are more than 1000 steps of 11 ms, but less than a minute.
  const StampSurvey short_pause = survey_of(steady(0, 50) + steady(20 * kS, 50));
  EXPECT_EQ(left_out(short_pause) + remarks(short_pause), "");
  // The first part ends at 49 * 11 ms = 0.539 s.
  const StampSurvey pause = survey_of(steady(0, 50) + steady(70'539 * kMs, 50));
  EXPECT_EQ(left_out(pause), "");
  EXPECT_EQ(remarks(pause), "the recording pauses for 70 s at line 52: two recordings in one file?");
  const StampSurvey two = survey_of(steady(0, 50) + steady(70'539 * kMs, 50) + steady(200 * kS, 50));
  EXPECT_EQ(remarks(two),
            "the recording pauses for 70 s at line 52: two recordings in one file? (and 1 more such pauses)");
}

TEST(StampSurvey, KeepsALogThatIsSlowerThanItsPauseLimits) {
  EXPECT_EQ(left_out(survey_of(steady(0, 40, 30 * kS))), "");
  auto swapped = steady(0, 40, 30 * kS);
  std::swap(swapped[20], swapped[21]);
  EXPECT_EQ(left_out(survey_of(swapped)), "");
}

TEST(StampSurvey, LeavesSmallDisorderToTheImport) {
  auto stamps = steady(0, 240);
  for (std::size_t i = 10; i < 240; i += 30) std::swap(stamps[i], stamps[i + 1]);
  EXPECT_EQ(left_out(survey_of(stamps)), "");
  // One row ten rows late: within a window of 16 rows, beyond one of 4 steps.
  auto late = steady(0, 240);
  const TimeNs moved = late[100];
  late.erase(late.begin() + 100);
  late.insert(late.begin() + 110, moved);
  EXPECT_EQ(left_out(survey_of(late, 16)), "");
  EXPECT_EQ(left_out(survey_of(late)), "112-112 backward_stamp");
}

// Pairs 0.091 ms apart every 33.333333 ms: from the first of a pair to the first of the next.
std::vector<TimeNs> groups(int count, int cameras) {
  std::vector<TimeNs> stamps;
  for (int i = 0; i < count; ++i)
    for (int camera = 0; camera < cameras; ++camera)
      stamps.push_back(60'000 * kS + i * TimeNs{33'333'333} + camera * TimeNs{91'000});
  return stamps;
}

TEST(StampSurvey, FindsCamerasThatShareATable) {
  for (const int count : {40, 4000})
    for (const int cameras : {2, 3, 4}) {
      SCOPED_TRACE(std::to_string(count) + " times " + std::to_string(cameras));
      const StampSurvey survey = survey_of(groups(count, cameras));
      EXPECT_EQ(left_out(survey), "");
      EXPECT_GT(survey.thin_below_ns, 3 * 91'000);
      EXPECT_LT(survey.thin_below_ns, 33'000'000);
      EXPECT_EQ(survey.usual_step_ns, 33'333'333.0 - (cameras - 1) * 91'000.0);
      EXPECT_EQ(remarks(survey), "poses at the stamps of " + std::to_string(cameras) +
                                     " cameras in one table: of stamps 0.091 ms apart the first was kept");
    }
}

TEST(StampSurvey, TakesNeitherJitterNorBurstsForCameras) {
  std::mt19937 random(3);
  std::exponential_distribution<double> wait(1e-7);  // 10 ms on average, one step in ten below 1 ms
  std::vector<TimeNs> jitter{0};
  while (jitter.size() < 3000) jitter.push_back(jitter.back() + 1 + static_cast<TimeNs>(wait(random)));
  EXPECT_EQ(survey_of(jitter).thin_below_ns, 0);
  EXPECT_EQ(left_out(survey_of(jitter)), "");
  EXPECT_EQ(survey_of(groups(300, 10)).thin_below_ns, 0) << "ten rows at once";
  EXPECT_EQ(left_out(survey_of(groups(300, 10))), "");
  EXPECT_EQ(survey_of(groups(400, 2) + steady(60'100 * kS, 4000)).thin_below_ns, 0)
      << "pairs in the first tenth of the file only";
}

TEST(StampSurvey, NamesEqualStamps) {
  EXPECT_TRUE(survey_of(std::vector<TimeNs>(60, 1'627'531'000 * kS)).all_equal);
  EXPECT_FALSE(survey_of({5, 5}).all_equal);
  // As a float, 1.6e9 s moves in steps of 128 s: 30 rows have one stamp, 30 the next. 58 repeat the row
  // before.
  const StampSurvey survey =
      survey_of(std::vector<TimeNs>(30, 1'627'531'008 * kS) + std::vector<TimeNs>(30, 1'627'531'136 * kS));
  EXPECT_FALSE(survey.all_equal);
  EXPECT_EQ(
      remarks(survey),
      "58 of 60 rows have the stamp of the row before (1627531008 s in line 3), and distinct stamps are "
      "128 s apart: written in single precision, or by a clock that is slower than the log?");
  auto few = steady(0, 100);
  few[50] = few[49];
  EXPECT_EQ(remarks(survey_of(few)), "");
}

// Blocks of four rows anywhere: 5000 jumps.
TEST(StampSurvey, KeepsWhatGrowsWhereStampsJumpAllTheTime) {
  std::mt19937 random(4);
  std::uniform_int_distribution<TimeNs> anywhere(0, 1000 * kS);
  std::vector<TimeNs> stamps;
  for (int i = 0; i < 5000; ++i) stamps = stamps + steady(anywhere(random), 4);
  const StampSurvey survey = survey_of(stamps);
  EXPECT_EQ(left_out(survey), "");
  EXPECT_EQ(remarks(survey).rfind("the stamps jump more than 1000 times", 0), 0u) << remarks(survey);
}

// Every other row comes two rows late: 0, 3, 2, 5, 4, 7 ... half of the rows go backwards.
TEST(StampSurvey, NamesRowsInAnotherOrder) {
  std::vector<TimeNs> stamps{0};
  for (int i = 1; i < 101; ++i) stamps.push_back((i % 2 == 1 ? i + 2 : i) * kStep);
  EXPECT_EQ(remarks(survey_of(stamps)),
            "50 of 101 rows go backwards: are they in another order than that of time?");
}

// 2000 hitches of 20 steps, one after every ten rows: no more runs than one at the end.
TEST(StampSurvey, KeepsALogOfManyHitches) {
  std::vector<TimeNs> stamps;
  for (int i = 0; i < 2000; ++i) stamps = stamps + steady(i * 30 * kStep, 10);
  const StampSurvey survey = survey_of(stamps);
  EXPECT_EQ(left_out(survey) + remarks(survey), "");
}

TEST(StampSurvey, CountsRowsOfOneLongLine) {
  auto stamps = steady(10 * kS, 90);
  stamps[10] = 2147483 * kS;
  const StampSurvey survey = survey_of(stamps, 0, true);
  ASSERT_EQ(survey.left_out.size(), 1u);
  EXPECT_EQ(survey.left_out[0].first.nth, 10);
  EXPECT_EQ(survey.left_out[0].last.nth, survey.left_out[0].first.nth);
}

TEST(StampSurvey, OfNoRowsIsEmpty) {
  EXPECT_EQ(survey_of({}).rows, 0);
  EXPECT_EQ(left_out(survey_of({7})) + remarks(survey_of({7})), "");
}

}  // namespace
}  // namespace herr
