// `herr check` as its users run it, by counters: times of a few frames are no measurement
// (long_check_test.cpp).
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/paths.h"
#include "tests/server/program/check/check_program.h"
#include "tests/server/program/child_program.h"
#include "tests/server/program/program_runner.h"

namespace herr {
namespace {

TEST_F(ProgramCheck, FindsNothingMoreInItself) {
  const Outcome run = check("--only counters --json --against " + test::program_path());
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["verdict"], "ok");
  double pixels = 0;
  for (const auto& counter : json["counters"]) {
    EXPECT_EQ(counter["verdict"], "ok") << counter;
    if (counter["name"] == "viewport_pixels") pixels = counter["candidate"];
  }
  EXPECT_EQ(pixels, 4 * 48 * 40);  // four viewports of the profile
}

TEST_F(ProgramCheck, SlowsDownOnlyItself) {
  // The other build says what it was given, and then that it cannot.
  write_other("echo \"$@\" > given; exit 2");
  const Outcome run = check("--slow-down 1 --no-camera --against other");
  EXPECT_EQ(run.exit_code, 4) << run.err << run.out;
  const std::string given = content_of(root() / "given");
  EXPECT_EQ(given.find("--slow-down"), std::string::npos) << given;
  EXPECT_NE(given.find("--no-camera"), std::string::npos) << given;
  EXPECT_TRUE(given.ends_with(" session\n")) << given;
}

TEST_F(ProgramCheck, FailsWhenItCountsMoreThanTheOtherBuild) {
  write_other(sed(R"(s/"viewport_pixels":[0-9.]*/"viewport_pixels":7600.0/)"));  // 7680 here: 1.05 % more
  const Outcome run =
      check("--only counters --against other --junit j.xml --markdown m.md --annotations github");
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_NE(run.out.find("REGRESSION: more viewport_pixels than before, +1.1 % (limit +0.5 %)"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("\n::error title="), std::string::npos) << run.out;
  EXPECT_NE(content_of(root() / "j.xml").find("<failure type=\"regression\""), std::string::npos);
  // Two processes were started and rendered: no time of 0, as a check that forgot to measure would write.
  const std::string junit = content_of(root() / "j.xml");
  const std::size_t time = junit.find("<testsuite name=\"herr check\"");
  ASSERT_NE(junit.find(" time=\"", time), std::string::npos) << junit;
  EXPECT_GT(std::stod(junit.substr(junit.find(" time=\"", time) + 7)), 0.0) << junit;
  EXPECT_NE(content_of(root() / "m.md").find("| regression |"), std::string::npos);
  // A second report follows the first.
  check("--only counters --against other --markdown m.md");
  EXPECT_EQ(lines_in(content_of(root() / "m.md")) % 2, 0);
  EXPECT_NE(content_of(root() / "m.md").find("### herr check", 10), std::string::npos);
}

TEST_F(ProgramCheck, DoesNotCompareWithAnotherFormatOfMeasurement) {
  write_other(sed(R"(s/"measurement_version":1/"measurement_version":2/)"));
  const Outcome run = check("--only counters --against other");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_EQ(lines_in(run.out), 1) << run.out;
  EXPECT_NE(run.out.find("NOT COMPARABLE"), std::string::npos);
  EXPECT_NE(run.out.find("measures in format 2, this program in format 1"), std::string::npos) << run.out;
}

TEST_F(ProgramCheck, DoesNotCompareWithABuildThatCannotMeasure) {
  write_other("echo \"herr: 'check' is no command\" >&2; exit 2");
  const Outcome run = check("--against other");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_NE(run.out.find("cannot measure this (exit code 2): 'check' is no command"), std::string::npos)
      << run.out;
}

TEST_F(ProgramCheck, DoesNotCompareProgramsThatDoOtherWork) {
  write_other(sed(R"(s/\["--light-samples","1"\]/["--light-samples","4"]/)"));
  const Outcome run = check("--only counters --against other");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_NE(run.out.find("--light-samples was 4, is 1"), std::string::npos) << run.out;
}

TEST_F(ProgramCheck, LetsNoRecordWithoutACounterPass) {
  write_other(sed(R"(s/"bytes_written":[0-9.]*,//)"));
  const Outcome run = check("--only counters --against other");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_NE(run.out.find("INCONCLUSIVE: bytes_written the baseline does not count it"), std::string::npos)
      << run.out;
}

TEST_F(ProgramCheck, ComparesWithAFileAndSaysWhatDiffers) {
  ASSERT_EQ(check("--only counters --save b.json").exit_code, 0);
  EXPECT_EQ(check("--only counters --baseline b.json").exit_code, 0);
  const auto difference = [&](const std::string& flags) {
    const Outcome run = check("--only counters --baseline b.json " + flags);
    EXPECT_EQ(run.exit_code, 4) << flags << run.err;
    return run.out;
  };
  EXPECT_NE(difference("--light-samples 4").find("--light-samples was 1, is 4"), std::string::npos);
  EXPECT_NE(difference("--polar 64x32").find("--polar was 32x16, is 64x32"), std::string::npos);
  fs::copy_file(root() / "scene/small.scene.json", root() / "scene/copy.scene.json");
  EXPECT_NE(difference("--scene scene/copy.scene.json").find("--scene was small.scene.json"),
            std::string::npos);
  write_text(root() / "scene/small.scene.json", content_of(root() / "scene/small.scene.json") + "\n");
  EXPECT_NE(difference("").find("small.scene.json has changed"), std::string::npos);
}

TEST_F(ProgramCheck, ComparesWithAFileAcrossInstructionSetsNever) {
  ASSERT_EQ(check("--only counters --save b.json").exit_code, 0);
  const Outcome run = check("--only counters --baseline b.json --isa avx2");
  if (run.exit_code == 2) GTEST_SKIP() << "this CPU lacks avx2";
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.out.find("--isa was sse4, is avx2"), std::string::npos) << run.out;
}

TEST_F(ProgramCheck, JudgesCountersButNoTimesOnAnotherMachine) {
  ASSERT_EQ(check("--only counters --save b.json").exit_code, 0);
  const Outcome run = check("--baseline b.json --threads 2");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_NE(run.out.find("the baseline is of another machine: --threads was 1, is 2"), std::string::npos)
      << run.out;
  EXPECT_EQ(check("--only counters --baseline b.json --threads 2").exit_code, 0);
}

TEST_F(ProgramCheck, OverwritesABaselineOnlyWhenTold) {
  ASSERT_EQ(check("--only counters --save b.json").exit_code, 0);
  EXPECT_EQ(check("--only counters --save b.json").exit_code, 2);
  EXPECT_EQ(check("--only counters --save b.json --overwrite").exit_code, 0);
}

TEST_F(ProgramCheck, EndsAsItsRunsDoOnBadInput) {
  write_text(root() / "session/pose/data.csv", "nonsense\n");
  const Outcome run = check("--only counters --junit j.xml --against " + test::program_path());
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_EQ(lines_in(run.err), 1) << run.err;
  EXPECT_NE(run.err.find("pose/data.csv"), std::string::npos) << run.err;
  EXPECT_NE(content_of(root() / "j.xml").find("<error "), std::string::npos);
}

TEST_F(ProgramCheck, RefusesWhatItCannotCompare) {
  for (const char* arguments :
       {"", "--against nothing", "--save a --baseline b", "--against a --policy motion",
        "--against a --format png", "--against a --json --annotations github", "--baseline b --overwrite",
        "--against a --annotations gitlab", "--against a --only rays", "another --save a"}) {
    const Outcome run = check(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << run.out;
    EXPECT_EQ(lines_in(run.err), 1) << arguments << run.err;
  }
}

TEST_F(ProgramCheck, RefusesPlacesThatCannotBeWrittenBeforeItMeasures) {
  write_text(root() / "file", "");
  for (const std::string flag : {"--save", "--junit", "--markdown"}) {
    for (const auto& [place, told] : {std::pair{"missing/b", "there is no folder missing;"},
                                      {"file/b", "there is no folder file;"},
                                      {"session", "session cannot be written;"}}) {
      const Outcome run = check((flag == "--save" ? "" : "--against other ") + flag + " " + place);
      EXPECT_EQ(run.exit_code, 2) << flag << place << run.out;
      EXPECT_EQ(lines_in(run.err), 1) << flag << place << run.err;
      EXPECT_NE(run.err.find("herr: " + flag + ": " + told), std::string::npos) << run.err;
    }
  }
}

TEST_F(ProgramCheck, TellsItsHelpWithoutWhatIsBetweenItsProcesses) {
  const Outcome run = run_program(root(), "check --help");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("--against"), std::string::npos);
  EXPECT_EQ(run.out.find("--measure"), std::string::npos);
  for (const char* flag : {"--slow-down PERCENT", "--max-seconds S", "--allow-different PART,..."}) {
    EXPECT_NE(run.out.find(flag), std::string::npos) << flag << run.out;
  }
}

TEST_F(ProgramCheck, EndsOnASignalAndTakesItsRunAlong) {
  // The run of the other build sleeps for ever; it writes its process id first.
  write_other("echo $$ > pid; exec sleep 600");
  ChildProgram child(root(), {test::program_path(), "check", "session", "--profile", "small.json", "--polar",
                              "32x16", "--frames", "6", "--against", "other"});
  for (int i = 0; i < 600 && content_of(root() / "pid").empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  child.send(SIGTERM);
  EXPECT_EQ(child.finish(), 128 + SIGTERM);
  const int pid = std::stoi(content_of(root() / "pid"));
  EXPECT_NE(::kill(pid, 0), 0) << "the run is still there";
}

}  // namespace
}  // namespace herr
