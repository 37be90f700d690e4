// Display profiles on every command that renders, and the rate that `herr study` is asked for.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/server/cli/refused_line.h"

namespace herr {
namespace {

using test::complaint;

TEST(CommandLine, EveryCommandThatRendersTakesAProfileAndItsScale) {
  const auto parsed = [](std::vector<std::string> line) {
    for (const char* word : {"--profile", "quest3", "--profile-scale", "0.25"}) line.emplace_back(word);
    return parse_command_line(line);
  };
  const auto expect_both = [](const auto& options) {
    EXPECT_EQ(options.profile, "quest3");
    EXPECT_EQ(options.profile_scale, 0.25);
  };
  expect_both(std::get<ReplayOptions>(parsed({"replay", "walk"})));
  expect_both(std::get<ServeOptions>(parsed({"serve", "walk"})).replay);
  expect_both(std::get<BenchOptions>(parsed({"bench"})));
  expect_both(std::get<StudyOptions>(parsed({"study", "walk"})));
  expect_both(std::get<InspectOptions>(parsed({"inspect", "walk"})));
  expect_both(std::get<CheckOptions>(parsed({"check", "walk", "--save", "a.json"})).run.replay);
  EXPECT_EQ(std::get<SynthOptions>(parse_command_line({"synth", "out", "--profile", "quest3"})).profile,
            "quest3");
  for (const char* command : {"replay", "serve", "bench", "study", "inspect", "check", "synth", "convert"}) {
    const std::string help = std::get<ShowText>(parse_command_line({command, "--help"})).text;
    // The help is wrapped at blanks.
    for (const char* name : {"xr1,", "xr1-half,", "quest3,", "generic-90"}) {
      EXPECT_NE(help.find(name), std::string::npos) << command << " " << name;
    }
  }
}

// The help is wrapped at blanks: words without them.
std::string words_of_help(const char* command) {
  std::string help = std::get<ShowText>(parse_command_line({command, "--help"})).text;
  std::string words;
  for (const char c : help) {
    const bool blank = c == ' ' || c == '\n';
    if (!blank || (!words.empty() && words.back() != ' ')) words += blank ? ' ' : c;
  }
  return words;
}

TEST(CommandLine, EachHelpSaysWhatItsCommandDoesWithAPartOfTheSession) {
  EXPECT_NE(words_of_help("replay").find("replay at most this many frames, 1 ..."), std::string::npos);
  const std::string check = words_of_help("check");
  EXPECT_NE(
      check.find("frames that each run renders, in place of --run-seconds; those after the first ten, but "
                 "the last half at least, are measured, for counters and for times, 1 ..."),
      std::string::npos)
      << check;
  EXPECT_NE(
      check.find("(default: as many as last --run-seconds, 30 for --only counters, those of --baseline)"),
      std::string::npos)
      << check;
  EXPECT_EQ(check.find("replay at most"), std::string::npos);
  EXPECT_NE(words_of_help("serve").find("replay at most this many frames, in each lap, 1 ..."),
            std::string::npos);
}

// complaint() expects exit code 2. A path that leads nowhere is missing input, 3, once it is read.
TEST(CommandLine, AWordThatIsNoProfileIsAWrongValueAndAPathIsLeftToReading) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"replay", "walk"},
                                             {"serve", "walk"},
                                             {"bench"},
                                             {"study", "walk"},
                                             {"inspect", "walk"},
                                             {"check", "walk", "--save", "a.json"},
                                             {"synth", "out"}}) {
    const auto with_profile = [&command](const std::string& profile) {
      std::vector<std::string> line = command;
      line.insert(line.end(), {"--profile", profile});
      return line;
    };
    EXPECT_EQ(
        complaint(with_profile("xr2")),
        "--profile: 'xr2' is neither a built-in display profile (xr1, xr1-half, quest3, generic-90) nor "
        "a file; did you mean xr1?");
    EXPECT_TRUE(complaint(with_profile("XR1-Half")).ends_with("; did you mean xr1-half?"));
    EXPECT_EQ(complaint(with_profile("quest33")).find("--profile: 'quest33' is neither"), 0u);
    EXPECT_NE(complaint(with_profile("vive")).find("; give one of them, or the path of a JSON file"),
              std::string::npos);
    for (const char* path : {"nowhere/xr2", "./xr2", "xr2.json", "xr1"}) {
      EXPECT_EQ(complaint(with_profile(path)), "") << path;
    }
  }
}

TEST(CommandLine, StudyTakesARateInPlaceOfItsSweeps) {
  const auto study = std::get<StudyOptions>(parse_command_line({"study", "walk", "--hz", "90"}));
  EXPECT_EQ(study.hz, 90);
  EXPECT_FALSE(study.profile_given);
  EXPECT_FALSE(study.light_given);
  const auto given =
      std::get<StudyOptions>(parse_command_line({"study", "walk", "--hz", "72.5", "--profile", "quest3",
                                                 "--light-samples", "1", "--profile-scale", "0.5"}));
  EXPECT_EQ(given.hz, 72.5);
  EXPECT_TRUE(given.profile_given);
  EXPECT_TRUE(given.light_given);
  EXPECT_EQ(complaint({"study", "walk", "--hz", "90", "--stability"}),
            "--hz: conflicts with --stability; give one of them");
  EXPECT_EQ(complaint({"study", "--hz", "90", "--report", "a.json"}),
            "--hz: conflicts with --report, which measures nothing; give one of them");
  EXPECT_EQ(complaint({"study", "walk", "--hz", "90", "--frames", "5"}),
            "--frames: is of error against time; leave it out with --hz");
  EXPECT_FALSE(study.minutes_given);
  const auto limited =
      std::get<StudyOptions>(parse_command_line({"study", "walk", "--hz", "90", "--minutes", "0.5"}));
  EXPECT_TRUE(limited.minutes_given);
  EXPECT_EQ(limited.minutes, 0.5);
  EXPECT_EQ(complaint({"study", "walk", "--hz", "90", "--out", "a"}),
            "--out: --hz writes nothing; leave it out, and take --json for machines");
  EXPECT_EQ(complaint({"study", "walk", "--hz", "90", "--polar", "acuity"}).find("--polar: acuity follows"),
            0u);
  EXPECT_EQ(complaint({"study", "walk", "--hz", "90", "--only", "polar"}),
            "--only: --hz sweeps nothing; leave it out");
  EXPECT_EQ(complaint({"study", "--hz", "90"}), "SESSION: missing; give a session folder");
  for (const char* value : {"0", "nan", "1e9", "1001", "0.9", "-1", ""}) {
    EXPECT_EQ(complaint({"study", "walk", "--hz", value}).find("--hz:"), 0u) << value;
  }
}

}  // namespace
}  // namespace herr
