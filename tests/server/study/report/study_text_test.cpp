// The report for a terminal: what stands first, how wide lines are, and that nothing unprintable gets out.
#include "server/study/report/study_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "server/study/report/figure_text.h"
#include "server/study/report/report_table.h"
#include "tests/server/study/report/study_records.h"

namespace herr {
namespace {

// Characters, not bytes.
std::size_t columns(const std::string& line) {
  return static_cast<std::size_t>(std::count_if(
      line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

TEST(StudyText, LinesHaveAtMost118Columns) {
  for (const StudyRecord& record :
       {test::rich_record(), test::minimal_record(), test::hostile_record(), StudyRecord{}}) {
    std::istringstream lines(study_text(record));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(columns(line), 118u) << line;
  }
}

TEST(StudyText, MissedAimsComeFirstAndWarningsLast) {
  const std::string text = study_text(test::rich_record());
  const char* order[] = {"MISSED: N = 64",    "met: uniform", "Recommendation", "Pareto front",
                         "\nlight-samples\n", "\nFits",       "\nReferences",   "\nDropped",
                         "\nLeft out",        "\nRemarks",    "\nWarnings"};
  std::size_t last = 0;
  for (const char* part : order) {
    const std::size_t at = text.find(part);
    ASSERT_NE(at, std::string::npos) << part;
    EXPECT_GT(at, last) << part;
    last = at;
  }
}

TEST(StudyText, BeginsWithWhatIsTooLittleForAdvice) {
  StudyRecord record = test::minimal_record();
  record.no_advice = "2 of 94 settings measured: no recommendation; give --minutes 7 or more";
  const std::string text = study_text(record);
  EXPECT_EQ(text.find(record.no_advice + "\n"), 0u) << text;
  EXPECT_EQ(text.find("Recommendation"), std::string::npos) << text;
}

// Before the first recommendation, once; without any there is nothing that it holds for.
TEST(StudyText, WhatHoldsForAllAdviceStandsAboveIt) {
  StudyRecord record = test::rich_record();
  const std::string text = study_text(record);
  EXPECT_NE(text.find("\nRecommendation\n  " + record.advice_note + "\n  " + record.advice[0].sentence),
            std::string::npos)
      << text;
  record.advice.clear();
  EXPECT_EQ(study_text(record).find(record.advice_note), std::string::npos);
}

TEST(StudyText, SaysOnceBelowTheSettingsWhyTheirTimesCanContradict) {
  const std::string text = study_text(test::rich_record());
  const std::size_t at = text.find("Times: ms is the median");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(text.find("Times: ms is the median", at + 1), std::string::npos);
  EXPECT_GT(at, text.find("\nedge\n"));  // the last sweep
  EXPECT_LT(at, text.find("\nFits"));
  EXPECT_EQ(study_text(test::minimal_record()).find("Times: ms"), std::string::npos);  // no settings
}

// By effort around each base, in whatever order they were measured; the default's point says what it is, and
// is no setting that was measured.
TEST(StudyText, SweepsAreInTheOrderOfTheirEffort) {
  StudyRecord record;
  for (const auto& [base, value] : {std::pair<const char*, const char*>{"N = 64", "4"},
                                    {"N = 1", "16"},
                                    {"N = 1", "4"},
                                    {"N = 1", "8"},
                                    {"N = 1", "0"}}) {
    record.points.push_back(test::study_point("edge", base, value, 0, 0.02, 1));  // numbers, but no effort
  }
  record.points.back().of_default = true;
  const std::string text = study_text(record);
  std::size_t last = text.find("\nedge\n");
  ASSERT_NE(last, std::string::npos) << text;
  for (const char* row : {"N = 1   0 (default) ", "N = 1   4 ", "N = 1   8 ", "N = 1   16 ", "N = 64  4 "}) {
    const std::size_t at = text.find(std::string("\n") + row);
    ASSERT_NE(at, std::string::npos) << row << text;
    EXPECT_GT(at, last) << row;
    last = at;
  }
  EXPECT_NE(text.find("Measured: 4 settings"), std::string::npos) << text;
}

TEST(StudyText, NumbersOfTheRichRecordAreWhole) {
  // Only words may be cut to make room; a number cut in half would be another number.
  const std::string text = study_text(test::rich_record());
  for (std::size_t at = text.find(".."); at != std::string::npos; at = text.find("..", at + 1)) {
    EXPECT_FALSE(at > 0 && std::isdigit(static_cast<unsigned char>(text[at - 1])))
        << text.substr(at - 20, 24);
  }
}

TEST(StudyText, WritesNothingThatIsNoNumberOrSteersATerminal) {
  const std::string text = study_text(test::hostile_record());
  for (const char* word : {"nan", "inf ", "inf]", "n/a", "\x1b", "\xff"}) {
    EXPECT_EQ(text.find(word), std::string::npos) << word;
  }
}

TEST(WrappedText, BreaksBetweenWordsAndIndentsWhatFollows) {
  EXPECT_EQ(wrapped_text("one two three", 7, 2), "one two\n  three");
  EXPECT_EQ(wrapped_text("one two three", 8, 2), "one two\n  three");
  EXPECT_EQ(wrapped_text("abcdefgh", 3, 1), "abc\n de\n fg\n h");
  EXPECT_EQ(wrapped_text("", 5), "");
  EXPECT_EQ(wrapped_text("\u00e9\u00e9\u00e9 \u00e9\u00e9", 4),
            "\u00e9\u00e9\u00e9\n\u00e9\u00e9");  // characters count
}

TEST(TableText, CutsWordsBeforeNumbers) {
  const ReportTable table{"", {{"name", true}, {"x"}}, {{"a name of some length", "0.123456"}}, ""};
  EXPECT_EQ(table_text(table, 20), "name               x\na name o..  0.123456\n");
}

TEST(Figure, HasThreeDigitsOrADash) {
  EXPECT_EQ(figure(0.0012345), "0.00123");
  EXPECT_EQ(figure(45.678), "45.7");
  EXPECT_EQ(figure(9.996), "10.0");  // rounds up into the next decade: three digits there too
  EXPECT_EQ(figure(123456.0), "123456");
  EXPECT_EQ(figure(0.0), "0");
  EXPECT_EQ(figure(-0.74, 2), "-0.74");
  EXPECT_EQ(figure(1.2e-7), "1.20e-07");
  EXPECT_EQ(figure(std::numeric_limits<double>::quiet_NaN()), "\u2013");
  EXPECT_EQ(figure(Interval{2, 1.5, std::numeric_limits<double>::infinity()}), "2.00 [1.50, \u2013]");
  EXPECT_EQ(percent_figure(0.974), "97 %");
  EXPECT_EQ(percent_figure(1e308), "\u2013");
  EXPECT_EQ(count_figure(302592.3), "302592");
}

}  // namespace
}  // namespace herr
