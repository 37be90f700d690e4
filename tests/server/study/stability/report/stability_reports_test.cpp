// The stability report on a terminal, as a page, and its pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "server/study/stability/report/stability_page.h"
#include "server/study/stability/report/stability_pictures.h"
#include "server/study/stability/report/stability_text.h"
#include "tests/server/study/report/page_checks.h"
#include "tests/server/study/stability/report/stability_records.h"

namespace herr {
namespace {

TEST(StabilityText, SaysWhatFailsWhereWhatWasNotAskedAndTheVerdictLast) {
  const std::string text = stability_text(test::rich_stability());
  const auto at = [&](const std::string& part) { return text.find(part); };
  const std::size_t fails = at("light: too large FAILS"), table = at("light: light times k"),
                    absent = at("samples: sum of lights: the scene has one light"),
                    closest = at("Closest to its limit: light, near its limit: 83 % of its bound\n"),
                    verdict = at("Verdict: 3 FAIL");
  ASSERT_NE(verdict, std::string::npos) << text;
  EXPECT_LT(fails, table);
  EXPECT_LT(table, absent);
  EXPECT_LT(absent, closest);
  EXPECT_LT(closest, verdict);
  EXPECT_NE(at("8 relations in 61 s"), std::string::npos);
  EXPECT_NE(at("left, pixel (3, 5): 0.3 instead of 0.2"), std::string::npos);
  EXPECT_NE(at("off in this run: adaptive"), std::string::npos);
  EXPECT_NE(at("the session was cut off"), std::string::npos);
}

TEST(StabilityText, WithinAGroupTheOneThatFailsStandsFirst) {
  const std::string text = stability_text(test::rich_stability());
  EXPECT_LT(text.find("FAILS    too large"), text.find("holds    quiet"));
}

TEST(StabilityText, LinesFitATerminalAndHoldNoControlCharacters) {
  for (const StabilityRecord& record :
       {test::rich_stability(), test::hostile_stability(), StabilityRecord{}}) {
    std::istringstream lines(stability_text(record));
    for (std::string line; std::getline(lines, line);) {
      const auto columns = std::count_if(
          line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
      EXPECT_LE(columns, 118) << line;
      for (const char c : line) ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) << line;
    }
  }
}

TEST(StabilityPage, TagsAreBalancedAndNamesAreTextForAnyRecord) {
  for (const StabilityRecord& record :
       {test::rich_stability(), test::hostile_stability(), StabilityRecord{}}) {
    const std::string page = stability_page(record);
    EXPECT_EQ(tag_problem(page), "");
    EXPECT_EQ(times_in(page, "<script"), 0u);
    EXPECT_EQ(times_in(page, "src="), times_in(page, "src=\"data:image/png;base64,"));
  }
}

TEST(StabilityPage, HoldsVerdictTablesPicturesAndWhatWasNotAskedInThisOrder) {
  const std::string page = stability_page(test::rich_stability());
  std::size_t before = 0;
  for (const char* part :
       {"<dl class=\"facts\">", "<b>Does not hold: </b>3 FAIL", "light: too large FAILS",
        "Closest to its limit: light, near its limit: 83 % of its bound.", "<caption>light: light times k",
        "src=\"data:image/png;base64,", "id=\"not-applicable\"",
        "samples: sum of lights: the scene has one light", "id=\"warnings\""}) {
    const std::size_t found = page.find(part, before);
    ASSERT_NE(found, std::string::npos) << part << " after byte " << before;
    before = found;
  }
  StabilityRecord sound = test::rich_stability();
  sound.results.resize(3);
  EXPECT_NE(stability_page(sound).find("<b>Holds: </b>3 hold"), std::string::npos);
}

TEST(StabilityPictures, ShowTheThreeWorstThatHaveSomeFailuresFirst) {
  StabilityRecord record = test::rich_stability();
  for (const std::size_t i : {0u, 1u, 2u, 3u, 4u})
    record.results[i].pictures = test::pictures_of(0.5f, 0.25f);
  const std::vector<StudyPicture> shown = worst_shown(record.results);
  ASSERT_EQ(shown.size(), 3u);
  EXPECT_EQ(shown[0].title, "light: too large");  // the two that are no numbers have no pictures
  EXPECT_EQ(shown[1].title, "samples: adaptive mean");
  EXPECT_EQ(shown[2].title, "light: near its limit");
  // Three panels of 4 pixels with gaps.
  EXPECT_GE(shown[0].width_px, 12);
  EXPECT_EQ(shown[0].height_px, 2);
}

TEST(StabilityPictures, StateTheGainThatFillsTheRampAndGoesNotBeyond) {
  const struct {
    float got, wanted;
    const char* says;
  } cases[] = {
      {0.5f, 0.25f, "channel times 4,"},                    // 1/4: 4 fills it, 8 leaves it
      {0.4375f, 0.25f, "channel times 4,"},                 // 3/16: 5.3
      {1.0f, 0.0f, "channel times 1,"},                     // never below 1
      {0.25f, 0.25f, "channel times 1,"},                   // no difference
      {0.25f + 0x1p-24f, 0.25f, "channel times 1048576,"},  // 2^20 at most
  };
  for (const auto& one : cases) {
    std::vector<RelationResult> results{test::result_of("a", 2, 1)};
    results[0].pictures = test::pictures_of(one.got, one.wanted);
    EXPECT_NE(worst_shown(results).at(0).caption.find(one.says), std::string::npos)
        << worst_shown(results).at(0).caption;
  }
}

}  // namespace
}  // namespace herr
