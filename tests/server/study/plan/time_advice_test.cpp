// What a study says before it spends its time on too little.
#include "server/study/plan/time_advice.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

TimeShortage shortage() {
  TimeShortage made;
  made.planned = 3, made.settings = 22;
  made.minutes = 2, made.minutes_needed = 7;
  made.only = 3;
  made.references = "study/references", made.references_s = 61.2;
  made.profile_scale = 1;
  return made;
}

TEST(TimeAdvice, SaysWhatHelpsMostFirst) {
  EXPECT_EQ(
      too_few_settings(shortage()),
      "--minutes 2 is enough for 3 of 22 settings, too few for a recommendation; what helps, most first: "
      "fewer names than 3 in --only; in the next study --references study/references, which took 62 s of "
      "this one; --profile-scale 0.4 (with references of its own); --minutes 7 or more, after this one "
      "with --resume");
}

TEST(TimeAdvice, LeavesOutWhatIsDoneAlready) {
  TimeShortage made = shortage();
  made.only = 1, made.references.clear(), made.profile_scale = 0.4;
  EXPECT_EQ(
      too_few_settings(made),
      "--minutes 2 is enough for 3 of 22 settings, too few for a recommendation; what helps, most first: "
      "--minutes 7 or more, after this one with --resume");
  made.only = 0;
  EXPECT_NE(
      too_few_settings(made).find("first: --only with one or two names (herr study --help lists them); "),
      std::string::npos);
  made.references = "my study/references";
  EXPECT_NE(too_few_settings(made).find(" --references 'my study/references', "), std::string::npos);
}

// A quarter of 22 is 5.5.
TEST(TimeAdvice, IsSilentFromAQuarterOn) {
  TimeShortage made = shortage();
  made.planned = 6;
  EXPECT_EQ(too_few_settings(made), "");
  made.planned = 5;
  EXPECT_NE(too_few_settings(made), "");
  made.planned = 1, made.settings = 4;
  EXPECT_EQ(too_few_settings(made), "");
}

// 10 s are for the report, a quarter is reserve, and the answer is in whole minutes above those asked for.
TEST(TimeAdvice, MinutesAreForReferencesAndSettings) {
  // 60 + (20 + 150 + 10) = 240 s are more than twice 60; 300 s.
  EXPECT_EQ(minutes_for(2, 60, 20, 150, true), 5);
  // Twice 200 s are more than 200 + 40; 500 s are 8.3 minutes.
  EXPECT_EQ(minutes_for(2, 200, 20, 10, true), 9);
  // References of further frames take up to half: twice 180 s, 450 s are 7.5 minutes.
  EXPECT_EQ(minutes_for(2, 60, 20, 150, false), 8);
  // 30 s would do: more than what was not enough.
  EXPECT_EQ(minutes_for(2, 5, 5, 5, true), 3);
  EXPECT_EQ(minutes_for(2.7, 5, 5, 5, true), 4);
}

}  // namespace
}  // namespace herr
