// `herr check` as its users run it: its progress, its ends before the last pair, what it lets differ, and the
// slow-down that makes it go red.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tests/server/program/check/check_program.h"

namespace herr {
namespace {

class ProgramCheckLimits : public ProgramCheck {
 protected:
  // Seconds that a check takes, with room for a machine that others use.
  static constexpr double kPatience_s = 30;

  Outcome timed_check(const std::string& arguments) {
    const auto start = std::chrono::steady_clock::now();
    const Outcome run = check(arguments);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_LT(seconds, kPatience_s) << arguments;
    return run;
  }
  void store_counters() { ASSERT_EQ(check("--only counters --save b.json").exit_code, 0); }
  // The stored file with one entry of its document changed.
  template <typename Change>
  void change_stored(Change&& change) {
    nlohmann::json document = nlohmann::json::parse(content_of(root() / "b.json"));
    change(document);
    write_text(root() / "b.json", document.dump());
  }
};

// A build whose runs were all but stolen: 100,000 of 100,001 ticks.
constexpr const char* kStolen = R"(s/"cpu_ticks":[^}]*}/"cpu_ticks":{"used":1,"stolen":100000}/)";

TEST_F(ProgramCheckLimits, EndsEarlyWhereNothingButNoisyCanCome) {
  // After n pairs n * 100,000 ticks are stolen. The 60 - 2 n runs to come can ask for 100,001 each at most:
  // n / (60 - n) of all is stolen in the end, more than 5 % (1 / 20) from n = 3 on.
  write_other(sed(kStolen));
  const Outcome run = check("--json --against other");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["verdict"], "noisy") << run.out;
  EXPECT_EQ(json["runs"], 3) << run.out;
  EXPECT_EQ(json["ended_early"],
            "ended after 3 of 15–30 pairs: whatever the others measured, the machine is too restless");
  EXPECT_EQ(json["advice"],
            "no number of pairs helps: repeat it when the machine is quieter, or take --only counters");
  // Counters are told all the same.
  EXPECT_FALSE(json["counters"].empty());
}

TEST_F(ProgramCheckLimits, EndsAfterOnePairWhereTheKernelDoesNotTell) {
  write_other(sed(R"(s/"cpu_ticks":[^}]*}/"cpu_ticks":null/)"));
  const Outcome run = check("--against other");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_NE(
      run.out.find("NOISY: the kernel does not say what a hypervisor took of the CPU time; ended after 1 "
                   "of 15–30 pairs"),
      std::string::npos)
      << run.out;
}

TEST_F(ProgramCheckLimits, StaysRedForCountersWhereTimesEndEarly) {
  write_other(sed(std::string(kStolen) + R"(;s/"viewport_pixels":[0-9.]*/"viewport_pixels":7600.0/)"));
  const Outcome run = check("--against other");
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_NE(run.out.find("REGRESSION: more viewport_pixels"), std::string::npos) << run.out;
}

TEST_F(ProgramCheckLimits, EndsInTimeWithoutAPassThatWasNotEarned) {
  // Half a second a pair: of two seconds, three or four.
  write_other("sleep 0.5; exec " + test::program_path() + " \"$@\"");
  const Outcome run = timed_check("--max-seconds 2 --json --junit j.xml --against other");
  EXPECT_EQ(run.exit_code, 4) << run.err << run.out;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_GE(json["runs"], 1);
  EXPECT_LE(json["runs"], 4);
  EXPECT_NE(json["ended_early"].get<std::string>().find("--max-seconds ended it after "), std::string::npos);
  if (json["verdict"] != "noisy") {  // what two short runs say of the machine is chance
    EXPECT_EQ(json["verdict"], "inconclusive");
    EXPECT_NE(json["reason"].get<std::string>().find("too few pairs to tell, it takes 9"), std::string::npos)
        << run.out;
    // 9 pairs allow a verdict, 30 are all.
    const int pairs = json["runs"];
    const std::string more = "it takes " + std::to_string(9 - pairs) + " more pairs at least, " +
                             std::to_string(30 - pairs) + " at most: --max-seconds ";
    EXPECT_EQ(json["advice"].get<std::string>().find(more), 0u) << run.out;
  }
  // The whole sentence, not its first half.
  const std::string junit = content_of(root() / "j.xml"), reason = json["reason"];
  EXPECT_NE(junit.find("<skipped message=\""), std::string::npos) << junit;
  EXPECT_TRUE(reason.ends_with(json["advice"].get<std::string>())) << reason;
  EXPECT_NE(junit.find("; " + json["advice"].get<std::string>() + "\"/>"), std::string::npos) << junit;
}

TEST_F(ProgramCheckLimits, EndsARunThatOutlastsTheTime) {
  write_other("exec sleep 600");
  const Outcome run = timed_check("--max-seconds 1 --against other");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_EQ(run.out,
            "INCONCLUSIVE: --max-seconds ended it before there was anything to compare; give more, "
            "--max-seconds 4, "
            "or fewer --frames\n");
}

TEST_F(ProgramCheckLimits, StoresNothingWhereTimeRunsOut) {
  // Twenty runs of a session of two seconds.
  write_small_session(root() / "long", 20);
  const Outcome run =
      run_program(root(),
                  "check long --profile small.json --preset direct --polar 256x128 --threads 1 "
                  "--frames 1800 --max-seconds 2 --save s.json");
  EXPECT_EQ(run.exit_code, 4) << run.err << run.out;
  EXPECT_NE(run.out.find("--max-seconds ended it"), std::string::npos) << run.out;
  EXPECT_EQ(content_of(root() / "s.json"), "");
}

TEST_F(ProgramCheckLimits, RefusesTimesThatAreNone) {
  for (const char* value : {"0", "0.5", "-5", "nan", "inf", "1e3", "10s", "''", "1000001"}) {
    const Outcome run = check(std::string("--against other --max-seconds ") + value);
    EXPECT_EQ(run.exit_code, 2) << value << run.out;
    EXPECT_EQ(lines_in(run.err), 1) << value << run.err;
    EXPECT_NE(run.err.find("herr: --max-seconds: "), std::string::npos) << run.err;
  }
}

TEST_F(ProgramCheckLimits, SaysHowItStandsInALogSparingly) {
  write_other(sed(kStolen));
  const Outcome run = check("--against other");
  EXPECT_TRUE(run.err.starts_with("herr: pair 1 of 15–30, noisy so far; ")) << run.err;
  EXPECT_EQ(lines_in(run.err), 1) << run.err;
  EXPECT_TRUE(run.err.ends_with(" left\n")) << run.err;
}

TEST_F(ProgramCheckLimits, RewritesItsLineOnATerminal) {
  write_other(sed(kStolen));
  // util-linux runs it with a terminal for stderr and stdout.
  if (run_line(root(), "script -V").exit_code != 0) GTEST_SKIP() << "there is no script(1)";
  const Outcome run = run_line(root(), "TERM=xterm script -qec '" + test::program_path() +
                                           " check session --profile small.json --preset direct --polar "
                                           "32x16 --threads 1 --frames 6 --against other' "
                                           "typescript");
  EXPECT_EQ(run.exit_code, 4) << run.out;
  const std::string first = "\r\033[Kpair 1 of 15–30, noisy so far; ",
                    second = "\r\033[Kpair 2 of 15–30, noisy";
  const std::size_t at = run.out.find(first);
  ASSERT_NE(at, std::string::npos) << run.out;
  const std::size_t next = run.out.find(second, at);
  ASSERT_NE(next, std::string::npos) << run.out;
  EXPECT_EQ(run.out.substr(at, next - at).find('\n'), std::string::npos) << run.out;
  // Cleared before the report.
  EXPECT_NE(run.out.find("\r\033[Ksession: this program", next), std::string::npos) << run.out;
}

TEST_F(ProgramCheckLimits, LetsSettingsDifferAndSaysHow) {
  store_counters();
  const Outcome refused = check("--only counters --baseline b.json --light-samples 4");
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_NE(refused.out.find("--light-samples was 1, is 4; --allow-different settings compares all the same"),
            std::string::npos)
      << refused.out;
  // Four shadow rays in place of one.
  const Outcome run =
      check("--only counters --baseline b.json --light-samples 4 --allow-different settings --junit j.xml");
  EXPECT_EQ(run.exit_code, 1) << run.err << run.out;
  EXPECT_NE(run.out.find("differs, as allowed: settings: --light-samples was 1, is 4\n"), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("settings differ, as allowed\n"), std::string::npos) << run.out;
  const std::string junit = content_of(root() / "j.xml");
  EXPECT_NE(junit.find("name=\"differs, as allowed: settings\" value=\"--light-samples was 1, is 4\""),
            std::string::npos)
      << junit;
  EXPECT_NE(junit.find("<failure type=\"regression\""), std::string::npos);
}

TEST_F(ProgramCheckLimits, LetsTheSceneDifferAndNothingElse) {
  store_counters();
  std::string scene = content_of(root() / "scene/small.scene.json");
  write_text(root() / "scene/other.scene.json", scene);
  EXPECT_EQ(check("--only counters --baseline b.json --scene scene/other.scene.json --allow-different scene")
                .exit_code,
            0);
  // One lamp more, one shadow ray more per hit.
  const std::string lamp = R"("lights": [)";
  scene.insert(
      scene.find(lamp) + lamp.size(),
      R"({"name": "second", "centre": [1, 3, 1], "size": [0.5, 0.1, 0.5], "intensity_w_sr": [5, 5, 5]},)");
  write_text(root() / "scene/small.scene.json", scene);
  const Outcome heavier = check("--only counters --baseline b.json --allow-different scene");
  EXPECT_EQ(heavier.exit_code, 1) << heavier.err << heavier.out;
  EXPECT_NE(heavier.out.find("scene: small.scene.json has changed"), std::string::npos) << heavier.out;
  const Outcome both = check("--only counters --baseline b.json --allow-different scene --polar 64x32");
  EXPECT_EQ(both.exit_code, 4);
  EXPECT_NE(
      both.out.find("--polar was 32x16, is 64x32; --allow-different scene,settings compares all the same"),
      std::string::npos)
      << both.out;
}

TEST_F(ProgramCheckLimits, LetsTheMachineDifferNever) {
  store_counters();
  const Outcome run =
      check("--only counters --baseline b.json --allow-different scene,settings,session --isa avx2");
  if (run.exit_code == 2) GTEST_SKIP() << "this CPU lacks avx2";
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.out.find("--isa was sse4, is avx2\n"), std::string::npos) << run.out;
  const Outcome threads =
      check("--baseline b.json --allow-different scene,settings,session --threads 2 --junit j.xml");
  EXPECT_EQ(threads.exit_code, 4);
  EXPECT_NE(threads.out.find("the baseline is of another machine: --threads was 1, is 2"), std::string::npos);
  EXPECT_NE(content_of(root() / "j.xml").find("<error type=\"not comparable\""), std::string::npos);
}

TEST_F(ProgramCheckLimits, TakesStoredRunsThatLackWhatIsCompared) {
  store_counters();
  // A setting that the builds of then did not know: it is a difference, and may be allowed.
  change_stored([](nlohmann::json& stored) { stored["fingerprint"]["settings"].erase(0); });
  const Outcome scene = check("--only counters --baseline b.json");
  EXPECT_EQ(scene.exit_code, 4) << scene.err;
  EXPECT_NE(scene.out.find("--scene was not known then, is small.scene.json; --allow-different scene "),
            std::string::npos)
      << scene.out;
  EXPECT_EQ(check("--only counters --baseline b.json --allow-different scene").exit_code, 0);
  // Without any fingerprint nothing can be said.
  change_stored([](nlohmann::json& stored) { stored.erase("fingerprint"); });
  const Outcome none = check("--only counters --baseline b.json --allow-different scene");
  EXPECT_EQ(none.exit_code, 3) << none.out;
  EXPECT_EQ(lines_in(none.err), 1) << none.err;
  EXPECT_NE(none.err.find("b.json"), std::string::npos) << none.err;
  EXPECT_NE(none.err.find("fingerprint"), std::string::npos) << none.err;
}

TEST_F(ProgramCheckLimits, RefusesDifferencesThatCannotBeAllowed) {
  for (const auto& [arguments, told] :
       {std::pair{"--baseline b --allow-different scenes", "did you mean scene?"},
        {"--baseline b --allow-different Settings", "did you mean settings?"},
        {"--baseline b --allow-different ''", "--allow-different: "},
        {"--baseline b --allow-different scene,", "--allow-different: "},
        {"--baseline b --allow-different scene,scene", "'scene' is named twice"},
        {"--baseline b --allow-different isa", "'isa' may never differ"},
        {"--baseline b --allow-different settings,threads", "'threads' may never differ"},
        {"--save b --allow-different scene", "--save compares nothing"},
        {"--against other --allow-different scene", "both builds render the same scene"},
        {"--against other --allow-different settings,session", "both builds render the same session"}}) {
    const Outcome run = check(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << run.out;
    EXPECT_EQ(lines_in(run.err), 1) << arguments << run.err;
    EXPECT_NE(run.err.find(told), std::string::npos) << arguments << run.err;
  }
}

TEST_F(ProgramCheckLimits, LetsDefaultsOfTwoBuildsDiffer) {
  write_other(sed(R"(s/\["--seed","0"\]/["--seed","7"]/)"));
  const Outcome refused = check("--only counters --against other");
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_NE(refused.out.find("--allow-different settings compares all the same"), std::string::npos)
      << refused.out;
  const Outcome run = check("--only counters --against other --allow-different settings");
  EXPECT_EQ(run.exit_code, 0) << run.out;
  EXPECT_NE(run.out.find("differs, as allowed: settings: --seed was 7, is 0\n"), std::string::npos)
      << run.out;
}

TEST_F(ProgramCheckLimits, RefusesASlowDownWithoutEffect) {
  for (const auto& [arguments, told] :
       {std::pair{"--against other --only counters --slow-down 10", "has no effect on counters"},
        {"--baseline b --only counters --slow-down 10", "has no effect on counters"},
        {"--save b --slow-down 10", "--save gives no verdict"},
        {"--save b --only counters --slow-down 10", "--save gives no verdict"},
        {"--against other --slow-down 0", "'0' is out of range: 0.1 to 1000"},
        {"--against other --slow-down -5", "'-5' is out of range: 0.1 to 1000"},
        {"--against other --slow-down nan", "'nan' is not a number from 0.1 to 1000"},
        {"--slow-down 10", "give one of --against"}}) {
    const Outcome run = check(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << run.out;
    EXPECT_EQ(lines_in(run.err), 1) << arguments << run.err;
    EXPECT_NE(run.err.find(told), std::string::npos) << arguments << run.err;
  }
}

}  // namespace
}  // namespace herr
