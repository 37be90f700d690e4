// `herr study` as its users run it: a small one, cut off and gone on with, printed again, and refused; and
// relations of --stability; the rate of --hz, with the line that it gives to be pasted.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/program/child_program.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSmallProfile = R"({"name": "small", "display_hz": 60, "viewports": [
  {"name": "left_context", "eye": "left", "kind": "context", "width_px": 64, "height_px": 64,
   "left_deg": -45, "right_deg": 45, "down_deg": -45, "up_deg": 45},
  {"name": "left_focus", "eye": "left", "kind": "focus", "width_px": 64, "height_px": 48,
   "left_deg": -20, "right_deg": 20, "down_deg": -12, "up_deg": 12, "edge_blend_deg": 1}]})";

class StudyProgram : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(folder_.path() / "small.json") << kSmallProfile; }
  fs::path root() const { return folder_.path(); }
  // Without the name of the folder.
  static std::string arguments() {
    const std::string source = std::string(test::source_dir());
    return "study '" + source + "/sessions/samples/desk-walk' --scene '" + source +
           "/scenes/samples/shapes.scene.json' --profile small.json --preset direct --polar 64x32 --frames 1 "
           "--minutes 5"
           " --only polar,light_samples,adaptive_samples";
  }
  Outcome study(const std::string& more) { return run_program(root(), with_more(arguments() + " ", more)); }

  TemporaryFolder folder_;
};

std::vector<std::string> rows_of(const fs::path& csv) {
  std::vector<std::string> rows;
  std::istringstream text(content_of(csv));
  for (std::string row; std::getline(text, row);) rows.push_back(row);
  return rows;
}

std::vector<std::string> cells_of_row(const std::string& row) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : row) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

// What does not depend on the clock, by setting, frame and kind of row.
std::map<std::string, std::string> timeless(const fs::path& csv) {
  const std::vector<std::string> rows = rows_of(csv);
  const std::vector<std::string> names = cells_of_row(rows.front());
  std::map<std::string, std::string> found;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const std::vector<std::string> cells = cells_of_row(rows[r]);
    std::string key, rest;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string& name = names[i];
      if (name == "name" || name == "frame" || name == "reference") key += cells[i] + "|";
      const bool timed = name.ends_with("_ms") || name.starts_with("ln_") || name == "measuring_s" ||
                         name == "pairs_preemptions";
      if (!timed) rest += cells[i] + ",";
    }
    EXPECT_TRUE(found.emplace(key, rest).second) << key << " is there twice";
  }
  return found;
}

// The report at any later time and place is the one that the study printed.
TEST_F(StudyProgram, LeavesItsRowsItsPageAndAReportThatPrintsAgainByteForByte) {
  const Outcome outcome = study("--out whole");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Pareto front"), std::string::npos) << outcome.out;
  const std::vector<std::string> rows = rows_of(root() / "whole/study.csv");
  // Two defaults, seven numbers of samples, twelve sizes, five adaptive numbers; then combinations and the
  // clip.
  EXPECT_GE(rows.size(), 1u + 2 + 7 + 12 + 5);
  const std::string page = content_of(root() / "whole/study.html");
  EXPECT_NE(page.find("<svg"), std::string::npos);
  fs::create_directories(root() / "elsewhere");
  fs::copy(root() / "whole/study.json", root() / "elsewhere/study.json");
  fs::remove_all(root() / "whole");
  const Outcome again = run_program(root() / "elsewhere", "study --report study.json --page again.html");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, outcome.out);
  EXPECT_EQ(content_of(root() / "elsewhere/again.html"), page);
}

TEST_F(StudyProgram, CutOffAtAnyMomentGoesOnToTheSameErrorsAndCounters) {
  ASSERT_EQ(study("--out whole").exit_code, 0);
  const std::uint32_t seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  std::string before;
  int cuts = 0;
  for (;; ++cuts) {
    const std::string line = "exec " + std::string(test::program_path()) + " " + arguments() + " --out cut" +
                             (fs::exists(root() / "cut") ? " --resume" : "");
    ChildProgram child(root(), {"/bin/sh", "-c", line + " > report.txt"});
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(200 + random() % 2500);
    while (child.runs() && (cuts >= 5 || std::chrono::steady_clock::now() < until)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const bool ended = !child.runs();
    if (!ended) child.send(random() % 2 == 0 ? SIGKILL : SIGTERM);
    while (child.runs()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const std::string now = fs::exists(root() / "cut/study.csv") ? content_of(root() / "cut/study.csv") : "";
    const std::string whole_rows = before.substr(0, before.rfind('\n') + 1);
    EXPECT_EQ(now.substr(0, whole_rows.size()), whole_rows) << "rows that were finished have changed";
    before = now;
    if (ended) break;
  }
  std::cout << cuts << " cuts\n";
  ASSERT_TRUE(fs::exists(root() / "cut/study.json")) << content_of(root() / "stderr.txt");
  const auto whole = timeless(root() / "whole/study.csv"), cut = timeless(root() / "cut/study.csv");
  int compared = 0;
  for (const auto& [key, rest] : whole) {
    const auto found = cut.find(key);
    // Which combinations are tried depends on times.
    if (found == cut.end()) {
      EXPECT_NE(rest.find("combination"), std::string::npos) << key << " is missing";
      continue;
    }
    EXPECT_EQ(found->second, rest) << key;
    ++compared;
  }
  EXPECT_GE(compared, 2 + 7 + 12 + 5);
}

// Six seconds are not enough for the many settings around a default of probes and occlusion. The references
// of one frame and the default with hard light are measured all the same: of small pictures within seconds,
// and a minute is ten times what was asked for.
TEST_F(StudyProgram, SaysFirstWhenTheTimeIsTooShortForARecommendationAndEndsSoon) {
  const std::string source = test::source_dir();
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome =
      run_program(root(), "study '" + source + "/sessions/samples/desk-walk' --scene '" + source +
                              "/scenes/samples/shapes.scene.json' --profile small.json --polar 256x128 "
                              "--minutes 0.1 --out short");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LT(seconds, 60);
  const std::string first = outcome.out.substr(0, outcome.out.find('\n'));
  EXPECT_NE(first.find(" settings measured: no recommendation; give --minutes "), std::string::npos)
      << outcome.out;
  EXPECT_EQ(outcome.out.find("\nRecommendation"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\nDropped for want of time"), std::string::npos) << outcome.out;
  EXPECT_GE(rows_of(root() / "short/study.csv").size(), 2u);
}

// More minutes are shared out anew: what the first were too few for is measured, and what they gave stays.
TEST_F(StudyProgram, GoesOnWithMoreMinutesToWhatWasDropped) {
  const auto study_of = [&](const std::string& minutes) {
    const std::string source = test::source_dir();
    return run_program(root(),
                       "study '" + source + "/sessions/samples/desk-walk' --scene '" + source +
                           "/scenes/samples/shapes.scene.json' --profile small.json --preset direct "
                           "--polar 64x32 --frames 1 --only polar,edge_samples --out more --minutes " +
                           minutes);
  };
  const Outcome few = study_of("0.1");
  ASSERT_EQ(few.exit_code, 0) << few.err;
  EXPECT_NE(few.err.find("herr: warning: --minutes 0.1 is enough for 1 of "), std::string::npos) << few.err;
  EXPECT_NE(few.err.find("; in the next study --references more/references, "), std::string::npos) << few.err;
  EXPECT_NE(few.out.find("\n  polar: "), std::string::npos) << few.out;
  const std::string rows = content_of(root() / "more/study.csv");
  const Outcome more = study_of("3 --resume");
  ASSERT_EQ(more.exit_code, 0) << more.err;
  EXPECT_EQ(content_of(root() / "more/study.csv").substr(0, rows.size()), rows);
  // Twelve sizes beside the default's, three numbers of edge samples beside 0 with hard light and one with
  // soft light, and two defaults.
  EXPECT_NE(more.err.find("plan: 18 of 18 settings"), std::string::npos) << more.err;
  EXPECT_EQ(more.out.find("\n  polar: "), std::string::npos) << more.out;
  EXPECT_NE(more.out.find("64x32 (default)"), std::string::npos) << more.out;
  EXPECT_NE(more.out.find("\nRecommendation"), std::string::npos) << more.out;
}

TEST_F(StudyProgram, RefusesWhatItCannotDoInOneLine) {
  const struct {
    const char* arguments;
    int exit_code;
    const char* says;
  } cases[] = {
      {"study", 2, "SESSION: missing"},
      {"study s --only polr", 3, "s"},  // the session comes first
      {"study s --report r.json", 2, "--report: prints a study that is done"},
      {"study s --page p.html", 2, "--page: is of --report only"},
      {"study s --resume --overwrite", 2, "--resume: conflicts with --overwrite"},
      {"study s --foveation off", 2, "--foveation"},
      {"study s --minutes 0", 2, "--minutes"},
      {"study --report missing.json", 3, "missing.json"},
      {"study --report small.json", 3, "small.json"},
  };
  for (const auto& one : cases) {
    const Outcome outcome = run_program(root(), one.arguments);
    EXPECT_EQ(outcome.exit_code, one.exit_code) << one.arguments << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(one.says), std::string::npos) << one.arguments << ": " << outcome.err;
    EXPECT_EQ(lines_in(outcome.err), 1) << outcome.err;
  }
  // What is refused leaves an earlier study as it was.
  fs::create_directories(root() / "out");
  std::ofstream(root() / "out/study.csv") << "rows";
  const Outcome unknown = study("--out out --overwrite --only polr");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'polar'?"), std::string::npos) << unknown.err;
  EXPECT_EQ(content_of(root() / "out/study.csv"), "rows");
  fs::create_directories(root() / "mine");
  std::ofstream(root() / "mine/letter.txt") << "keep me";
  const Outcome foreign = study("--out mine --overwrite");
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_EQ(content_of(root() / "mine/letter.txt"), "keep me");
}

constexpr const char* kTinyProfile = R"({"name": "tiny", "display_hz": 60, "viewports": [
  {"name": "left_context", "eye": "left", "kind": "context", "width_px": 64, "height_px": 64,
   "left_deg": -45, "right_deg": 45, "down_deg": -45, "up_deg": 45}]})";

class StabilityProgram : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(folder_.path() / "tiny.json") << kTinyProfile; }
  fs::path root() const { return folder_.path(); }
  Outcome stability(const std::string& more) {
    const std::string source = test::source_dir();
    return run_program(
        root(), with_more("study --stability '" + source + "/sessions/samples/desk-walk' --scene '" + source +
                              "/scenes/samples/shapes.scene.json' --profile tiny.json --polar 256x128 ",
                          more));
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

class StudyRateProgram : public testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(folder_.path() / "scene");
    write_small_session(folder_.path() / "walk", 4);
    write_small_profile(folder_.path() / "small.profile.json");
  }
  Outcome run(const std::string& arguments) { return run_program(folder_.path(), arguments); }

  TemporaryFolder folder_;
};

// Four seconds hold nine frames at 2 Hz, of which four warm up: the session is gone through again and again.
// 500 ms are enough for any of these settings.
TEST_F(StudyRateProgram, GivesALineThatHoldsTheRateWhenPasted) {
  const Outcome outcome =
      run("study walk --hz 2 --profile small.profile.json --polar 64x32 --light-samples 3 --threads 1 "
          "--no-probes --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["hz"], 2);
  EXPECT_EQ(json["holds"], true);
  EXPECT_TRUE(json["prevented_by"].is_null());
  EXPECT_EQ(json["held"]["runs"].size(), 3u);
  EXPECT_EQ(json["held"]["frames"], 300);
  EXPECT_LE(json["held"]["p95_ms"].get<double>(), 500);
  const std::string line = json["command_line"];
  EXPECT_EQ(line,
            "herr replay walk --profile small.profile.json --profile-scale 1 --polar 64x32 --light-samples 3 "
            "--no-probes --threads 1 --clock realtime --target-ms 500 --format none --contact-sheet none");

  const Outcome pasted = run(line.substr(std::string("herr ").size()));
  ASSERT_EQ(pasted.exit_code, 0) << pasted.err;
  const auto summary = nlohmann::json::parse(content_of(folder_.path() / "out/walk/summary.json"));
  EXPECT_EQ(summary["settings"]["polar"], "64x32");
  EXPECT_EQ(summary["settings"]["light_samples"], 3);
  EXPECT_LE(summary["latency"]["frame"]["p95"].get<double>(), 500);
}

// The smallest has 9,600 samples of both eyes; those that hit something send 64 short rays each: far more
// than 1 ms. What holds without them, and with smaller buffers, is no answer to what was asked.
TEST_F(StudyRateProgram, EndsWithOneWhereNoSettingHoldsTheRateAndAsksForLess) {
  const Outcome outcome =
      run("study walk --hz 1000 --profile small.profile.json --polar 400x384 --light-samples 1 "
          "--occlusion-rays 64 "
          "--threads 1");
  EXPECT_NE(outcome.out.find("holds that with no setting"), std::string::npos) << outcome.out << outcome.err;
  const auto tells = [&](const std::string& words) { return outcome.out.find(words) != std::string::npos; };
  EXPECT_TRUE(tells("The stage that prevents it is occlusion (--occlusion-rays 0 leaves it out), "))
      << outcome.out;
  EXPECT_EQ(outcome.err.find("herr: no setting holds 1000 Hz as asked: the smallest takes "), 0u)
      << outcome.err;
  EXPECT_NE(outcome.err.find(" ms); step 1, without what flags leave out: "), std::string::npos);
  EXPECT_TRUE(tells("\nWhat was asked does not hold; ")) << outcome.out;
  const std::size_t line = outcome.out.find("\nherr replay walk ");
  if (tells(" it does:\n")) {
    ASSERT_NE(line, std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" --occlusion-rays 0 ", line), std::string::npos) << outcome.out;
  } else {
    EXPECT_EQ(line, std::string::npos);
    EXPECT_TRUE(tells("\nherr study walk ")) << outcome.out;
  }
  if (outcome.err.find("the machine was busy") == std::string::npos) {
    EXPECT_EQ(outcome.exit_code, 1);
  } else {
    EXPECT_EQ(outcome.exit_code, 4);
  }
}

TEST_F(StudyRateProgram, ARateThatIsNoneIsOneLine) {
  for (const std::string value : {"0", "nan", "inf", "1e9", "1001", "-90", "0.5", "''", "ninety"}) {
    const Outcome outcome = run("study walk --hz " + value);
    EXPECT_EQ(outcome.exit_code, 2) << value;
    EXPECT_EQ(outcome.err.find("herr: --hz: "), 0u) << outcome.err;
    EXPECT_EQ(lines_in(outcome.err), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

}  // namespace
}  // namespace herr
