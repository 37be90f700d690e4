// The page of a study: sound for any record, safe for any name, and in the order that a reader needs.
#include "server/study/report/study_page.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>
#include <vector>

#include "server/diagrams/html_text.h"
#include "server/text/base64.h"
#include "tests/server/study/report/page_checks.h"
#include "tests/server/study/report/study_records.h"

namespace herr {
namespace {

// Words of the page outside of letters: "nan" within "finance" is none.
bool has_word(const std::string& text, const std::string& word) {
  const auto letter = [&](std::size_t i) {
    return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if (!(at > 0 && letter(at - 1)) && !letter(at + word.size())) return true;
  }
  return false;
}

std::vector<StudyRecord> all_records() {
  return {test::rich_record(), test::minimal_record(), test::hostile_record(), StudyRecord{}};
}

TEST(StudyPage, TagsAreBalancedForAnyRecord) {
  for (const StudyRecord& record : all_records()) EXPECT_EQ(tag_problem(study_page(record)), "");
}

TEST(StudyPage, NeverWritesWhatIsNoNumber) {
  std::string page = study_page(test::hostile_record());
  for (const char* word : {"nan", "-nan", "inf", "-inf", "NaN", "Infinity", "n/a"}) {
    EXPECT_FALSE(has_word(page, word)) << word;
  }
}

TEST(StudyPage, ShowsNamesAsTextAndNotAsMarkup) {
  const std::string page = study_page(test::hostile_record());
  EXPECT_EQ(times_in(page, "<script"), 0u);
  EXPECT_GT(times_in(page, "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&quot;&amp;"), 10u);
  for (const char c : page) {
    ASSERT_TRUE(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F)) << int(c);
  }
}

TEST(StudyPage, LoadsNothingAndRunsNothing) {
  const std::string page = study_page(test::rich_record());
  for (const char* part : {"http:", "https:", "<script", "<link", "<iframe", "@import", "url("}) {
    EXPECT_EQ(times_in(page, part), 0u) << part;
  }
  for (std::size_t at = page.find(" on"); at != std::string::npos; at = page.find(" on", at + 1)) {
    EXPECT_NE(page[page.find_first_not_of("abcdefghijklmnopqrstuvwxyz", at + 3)], '=') << page.substr(at, 30);
  }
  EXPECT_EQ(times_in(page, "src="), times_in(page, "src=\"data:image/png;base64,"));
}

TEST(StudyPage, EachIdStandsOnce) {
  for (const StudyRecord& record : all_records()) {
    const std::string page = study_page(record);
    std::set<std::string> ids;
    std::size_t found = 0;
    for (std::size_t at = page.find(" id=\""); at != std::string::npos; at = page.find(" id=\"", at + 1)) {
      ids.insert(page.substr(at + 5, page.find('"', at + 5) - at - 5));
      ++found;
    }
    EXPECT_EQ(ids.size(), found);
    EXPECT_GE(found, 1u);
  }
}

TEST(StudyPage, MissedAimsStandBeforeAllOtherResults) {
  const std::string page = study_page(test::rich_record());
  const std::size_t missed = page.find("<b>Missed: </b>N = 64 at full scale"),
                    met = page.find("<b>Met: </b>uniform");
  ASSERT_NE(missed, std::string::npos);
  ASSERT_NE(met, std::string::npos);
  EXPECT_LT(missed, met);
  EXPECT_LT(met, page.find("id=\"advice\""));
  EXPECT_LT(page.find("id=\"advice\""), page.find("<svg"));
  EXPECT_LT(page.find("<svg"), page.find("id=\"points\""));
}

TEST(StudyPage, TellsWhatTheRecordHolds) {
  const StudyRecord record = test::rich_record();
  const std::string page = study_page(record);
  for (const StudyPoint& point : record.points) {
    EXPECT_NE(page.find("<title>" + html_text(point.name) + ": "), std::string::npos) << point.name;
  }
  for (const MetricRow& metric : metric_rows()) {
    EXPECT_NE(page.find(html_text(metric.sentence)), std::string::npos);
    EXPECT_NE(page.find(html_text(metric.blind_to)), std::string::npos);
  }
  for (const std::string& text :
       {record.remarks[0].text, record.left_out[0], record.dropped[0], record.warnings[0],
        record.references[1].name, record.advice[1].sentence, record.fits.back().remark,
        record.fits[0].theory, std::string("p = -0.74 [-0.80, -0.68]")}) {
    EXPECT_NE(page.find(html_text(text)), std::string::npos) << text;
  }
  EXPECT_NE(page.find("Recommendation</h2>\n<p>" + html_text(record.advice_note) + "</p>\n<ul"),
            std::string::npos);
  EXPECT_EQ(times_in(page, "<p class=\"note\">Times: ms is the median"), 1u);
  EXPECT_NE(page.find(base64_text(std::as_bytes(std::span(record.pictures[1].png)))), std::string::npos);
}

TEST(StudyPage, ARecordOfNextToNothingHasNoEmptyParts) {
  const std::string page = study_page(test::minimal_record());
  EXPECT_EQ(times_in(page, "<svg"), 0u);
  EXPECT_EQ(times_in(page, "<section"), times_in(page, "<h2"));
  EXPECT_EQ(times_in(page, "<ul"), 0u);
  EXPECT_EQ(times_in(page, "<dd></dd>"), 0u);
  EXPECT_EQ(times_in(page, "id=\"aims\""), 0u);
}

}  // namespace
}  // namespace herr
