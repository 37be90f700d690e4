// `herr study --stability` as its users run it: a group or two, printed again, and refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/server/program/program_runner.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTinyProfile = R"({"name": "tiny", "display_hz": 60, "viewports": [
  {"name": "left_context", "eye": "left", "kind": "context", "width_px": 64, "height_px": 64,
   "left_deg": -45, "right_deg": 45, "down_deg": -45, "up_deg": 45}]})";

class StabilityProgram : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(folder_.path() / "tiny.json") << kTinyProfile; }
  fs::path root() const { return folder_.path(); }
  Outcome stability(const std::string& more) {
    const std::string source = test::source_dir();
    return run_program(root(), "study --stability '" + source + "/sessions/samples/desk-walk' --scene '" +
                                   source + "/scenes/samples/shapes.scene.json' --profile tiny.json " +
                                   "--polar 256x128 " + more);
  }

  TemporaryFolder folder_;
};

TEST_F(StabilityProgram, HoldsOnASampleAndLeavesAReportThatPrintsAgainByteForByte) {
  const Outcome outcome = stability("--only place");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(files_below(root() / "stability"),
            (std::vector<std::string>{"stability.html", "stability.json"}));
  const std::string json = content_of(root() / "stability/stability.json");
  EXPECT_EQ(json.back(), '\n');
  const nlohmann::json document = nlohmann::json::parse(json);
  EXPECT_GE(document.at("results").size(), 3u);
  for (const nlohmann::json& result : document.at("results")) {
    EXPECT_EQ(result.at("group"), "place");
    EXPECT_NE(result.at("verdict"), "FAILS");
    EXPECT_FALSE(result.at("bound_from").get<std::string>().empty());
  }
  EXPECT_NE(outcome.out.find("\nVerdict: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("herr: place: "), std::string::npos) << outcome.err;

  const Outcome again = run_program(root(), "study --report stability/stability.json --page again.html");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, outcome.out);
  EXPECT_EQ(content_of(root() / "again.html"), content_of(root() / "stability/stability.html"));
  EXPECT_EQ(run_program(root(), "study --report stability/stability.json --json").out, json);

  const Outcome there = stability("--only place");
  EXPECT_EQ(there.exit_code, 2);
  EXPECT_NE(there.err.find("--overwrite"), std::string::npos) << there.err;
  EXPECT_EQ(content_of(root() / "stability/stability.json"), json);
}

TEST_F(StabilityProgram, RefusesWhatItCannotDoInOneLineAndLeavesNothing) {
  const struct {
    const char* arguments;
    int exit_code;
    const char* says;
  } cases[] = {
      {"study --stability", 2, "SESSION: missing"},
      {"study --stability s --only plac", 2, "did you mean 'place'?"},
      {"study --stability s --only polar", 2, "'polar' is no group of relations"},
      {"study --stability s --minutes 3", 2, "--minutes"},
      {"study --stability s --frames 3", 2, "--frames"},
      {"study --stability s --resume", 2, "--resume"},
      {"study --stability s --references r", 2, "--references"},
      {"study --stability s --export e", 2, "--export"},
      {"study --stability s --page p.html", 2, "OUT/stability.html"},
      {"study --stability s", 3, "s"},
      {"study --stability --report tiny.json", 3, "is no stability report"},
  };
  for (const auto& one : cases) {
    const Outcome outcome = run_program(root(), one.arguments);
    EXPECT_EQ(outcome.exit_code, one.exit_code) << one.arguments << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(one.says), std::string::npos) << one.arguments << ": " << outcome.err;
    EXPECT_EQ(lines_in(outcome.err), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "") << one.arguments;
  }
  EXPECT_FALSE(fs::exists(root() / "stability"));
}

}  // namespace
}  // namespace herr
