// `herr check` by times, for real: this program against itself, and against itself slowed down. A small scene
// and short runs: whether a machine is quiet enough for 3 % is not the question here.
#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/paths.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

class LongCheck : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(folder_.path() / "scene");
    write_small_session(folder_.path() / "session", 2);
  }
  // Frames of two milliseconds or so.
  Outcome check(const std::string& arguments) {
    const Outcome run = run_program(
        folder_.path(),
        "check session --profile xr1-half --preset direct --polar 128x64 --threads 1 --frames 60 --json " +
            arguments);
    std::cout << run.out.substr(run.out.find("\"verdict\""), 300) << "...\n";
    return run;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(LongCheck, FindsNoRegressionInItself) {
  const Outcome run = check("--against " + test::program_path());
  EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.exit_code << run.err << run.out;
}

TEST_F(LongCheck, FindsItselfSlowedByAQuarterUnlessTheMachineIsTooRestless) {
  const Outcome run = check("--slow-down 25 --against " + test::program_path());
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_TRUE(json["verdict"] == "regression" || json["verdict"] == "noisy") << run.out;
  EXPECT_EQ(run.exit_code, json["verdict"] == "regression" ? 1 : 4);
  // Found or not, the slow-down is what was measured: 25 % and what restlessness adds or takes.
  EXPECT_NEAR(json["times"][0]["ratio"].get<double>(), 1.25, 0.1);
}

TEST_F(LongCheck, HoldsRunsAgainstStoredOnes) {
  const Outcome saved = check("--save b.json");
  if (saved.exit_code == 4) GTEST_SKIP() << "the machine is too restless to store runs";
  ASSERT_EQ(saved.exit_code, 0) << saved.err;
  EXPECT_NE(check("--baseline b.json").exit_code, 1);
  const Outcome slow = check("--slow-down 25 --baseline b.json");
  const auto json = nlohmann::json::parse(slow.out);
  EXPECT_TRUE(json["verdict"] == "regression" || json["verdict"] == "noisy") << slow.out;
}

}  // namespace
}  // namespace herr
