// What a check says in each of its forms, and its stored runs there and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "server/check/baseline_file.h"
#include "server/check/measure/not_comparable.h"
#include "server/check/report/ci_reports.h"
#include "server/check/report/text_report.h"
#include "server/check/run_length.h"
#include "sessions/files/input_error.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

CheckReport report_of(Verdict time, Verdict counter) {
  CheckReport report;
  report.session = "desk-walk";
  report.candidate = "this program (herr 0.1.0)";
  report.baseline = "old/herr (herr 0.1.0)";
  report.settings = "--isa avx2, --threads 2";
  CheckedTime median;
  median.name = median.title = "median";
  median.decides = true;
  median.verdict = time;
  median.shift = {0.0001, std::log(1.08), std::log(1.06), kInfinity};
  if (time == Verdict::noisy)
    median.reason = "the machine's speed varied by 9.0 % from run to run (limit 5.0 %)";
  report.times = {median};
  report.counters = {{"pixels", counter, 1000, 1200, ""}};
  report.baseline_ms = 40, report.candidate_ms = 43.2;
  report.noise = Noise{0.02, 0.001};
  report.runs = report.baseline_runs = 15;
  report.frames = 32;
  conclude(report);
  return report;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(CheckReport, EndsWithTheExitCodeOfItsVerdict) {
  EXPECT_EQ(exit_code_of(Verdict::ok), 0);
  EXPECT_EQ(exit_code_of(Verdict::regression), 1);
  for (const Verdict v : {Verdict::inconclusive, Verdict::noisy, Verdict::not_comparable}) {
    EXPECT_EQ(exit_code_of(v), 4) << name_of(v);
  }
}

TEST(CheckReport, PassesOnlyWhenEverythingPasses) {
  EXPECT_EQ(report_of(Verdict::ok, Verdict::ok).verdict, Verdict::ok);
  EXPECT_EQ(report_of(Verdict::ok, Verdict::inconclusive).verdict, Verdict::inconclusive);
  EXPECT_EQ(report_of(Verdict::noisy, Verdict::ok).verdict, Verdict::noisy);
  EXPECT_EQ(report_of(Verdict::noisy, Verdict::regression).verdict, Verdict::regression);
  EXPECT_EQ(report_of(Verdict::regression, Verdict::ok).verdict, Verdict::regression);
}

TEST(CheckReport, SaysWhyInItsLastLine) {
  const std::string text = check_text(report_of(Verdict::regression, Verdict::ok));
  EXPECT_NE(text.find("REGRESSION: frames take 8.0 % more time (limit +3 %, p 0.00010)\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("      +6.0 % at least"), std::string::npos) << text;
  const std::string noisy = check_text(report_of(Verdict::noisy, Verdict::ok));
  EXPECT_NE(noisy.find("NOISY: the machine's speed varied by 9.0 %"), std::string::npos) << noisy;
}

TEST(CheckReport, IsValidJsonWithInfiniteBoundsAsNull) {
  const auto json = nlohmann::json::parse(check_json(report_of(Verdict::regression, Verdict::ok)).dump());
  EXPECT_EQ(json["verdict"], "regression");
  EXPECT_NEAR(json["times"][0]["ratio"].get<double>(), 1.08, 1e-12);
  EXPECT_TRUE(json["times"][0]["upper"].is_null());
  EXPECT_EQ(json["counters"][0]["candidate"], 1200);
}

TEST(JUnit, CountsRegressionsAsFailuresAndTheRestAsSkipped) {
  const std::string failed = check_junit(report_of(Verdict::noisy, Verdict::regression));
  EXPECT_NE(failed.find("tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"1\""), std::string::npos)
      << failed;
  EXPECT_EQ(count_of(failed, "<failure "), 1u);
  EXPECT_EQ(count_of(failed, "<skipped "), 1u);
  const std::string good = check_junit(report_of(Verdict::ok, Verdict::ok));
  EXPECT_EQ(count_of(good, "<failure ") + count_of(good, "<skipped ") + count_of(good, "<error "), 0u);
  EXPECT_EQ(count_of(good, "<testcase "), 2u);
}

TEST(JUnit, HasAnErrorForWhatIsNotComparable) {
  // Times of another machine beside counters that pass.
  const std::string times = check_junit(report_of(Verdict::not_comparable, Verdict::ok));
  EXPECT_EQ(count_of(times, "tests=\"2\" failures=\"0\" errors=\"1\" skipped=\"0\""), 1u) << times;
  EXPECT_EQ(count_of(times, "<error type=\"not comparable\" "), 1u) << times;
  // Nothing compares at all.
  CheckReport report;
  report.session = "s";
  report.verdict = Verdict::not_comparable;
  report.reason = "--isa was sse4, is avx2";
  const std::string whole = check_junit(report);
  EXPECT_EQ(count_of(whole, "tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\""), 1u) << whole;
  EXPECT_EQ(count_of(whole, "<error type=\"not comparable\" message=\"--isa was sse4, is avx2\"/>"), 1u);
  EXPECT_EQ(count_of(whole, "<failure ") + count_of(whole, "<skipped "), 0u) << whole;
  EXPECT_EQ(check_annotations(report).find("::error "), 0u) << check_annotations(report);
}

TEST(CheckReport, NamesTheCounterThatGrewMostAndCountsTheOthers) {
  CheckReport report;
  report.counters = {{"bytes", Verdict::regression, 1000, 1060, ""},
                     {"rays.shadow", Verdict::regression, 100, 413, ""},
                     {"pixels", Verdict::ok, 10, 10, ""},
                     {"rays.mirror", Verdict::regression, 100, 400, ""}};
  conclude(report);
  EXPECT_EQ(report.reason, "more rays.shadow than before, +313.0 % (limit +0.5 %), and 2 more counters");
  report.counters.push_back({"new", Verdict::regression, 0, 1, ""});  // from nothing is the most
  conclude(report);
  EXPECT_EQ(report.reason, "more new than before, from 0 (limit +0.5 %), and 3 more counters");
}

TEST(CheckReport, SaysWhatDiffersAndWhyItEndedEarlyInEveryForm) {
  CheckReport report = report_of(Verdict::regression, Verdict::ok);
  report.ended_early = "--max-seconds ended it after 12 of 15–30 pairs";
  report.differences = {{"scene", "--scene was a, is b"},
                        {"scene", "1"},
                        {"scene", "2"},
                        {"scene", "3"},
                        {"scene", "4"},
                        {"settings", "--polar was 32x16, is 64x32"}};
  conclude(report);
  const std::string text = check_text(report);
  EXPECT_EQ(count_of(text, "differs, as allowed: scene: --scene was a, is b; 1; 2; and 2 more\n"), 1u)
      << text;
  EXPECT_EQ(count_of(text, "differs, as allowed: settings: --polar was 32x16, is 64x32\n"), 1u) << text;
  EXPECT_EQ(
      count_of(text,
               "p 0.00010); --max-seconds ended it after 12 of 15–30 pairs; scene and settings differ, as "
               "allowed\n"),
      1u)
      << text;
  const std::string junit = check_junit(report);
  EXPECT_EQ(count_of(junit,
                     "<failure type=\"regression\" message=\"frames take 8.0 % more time (bounds +6.0 % at "
                     "least, p 0.00010), limit +3 %; --max-seconds ended it after 12 of 15–30 pairs; scene "
                     "and settings differ, as allowed\"/>"),
            1u)
      << junit;
  EXPECT_EQ(count_of(junit, "<property name=\"ended early\" value=\"--max-seconds ended it after 12"), 1u);
  EXPECT_EQ(count_of(junit, "<property name=\"differs, as allowed: settings\" value=\"--polar was 32x16"), 1u)
      << junit;
  EXPECT_EQ(count_of(check_markdown(report), "Differs, as allowed: scene: "), 1u) << check_markdown(report);
  const auto json = nlohmann::json::parse(check_json(report).dump());
  EXPECT_EQ(json["ended_early"], report.ended_early);
  ASSERT_EQ(json["differences"].size(), 6u);
  EXPECT_EQ(json["differences"][4]["part"], "scene");
  EXPECT_EQ(json["differences"][4]["difference"], "4");
  EXPECT_TRUE(
      nlohmann::json::parse(check_json(report_of(Verdict::ok, Verdict::ok)).dump())["ended_early"].is_null());
}

TEST(CheckReport, KeepsTheWholeSentenceInEveryFormAndAdviceWhereItCouldNotTell) {
  CheckReport report = report_of(Verdict::noisy, Verdict::ok);
  report.ended_early = "--max-seconds ended it after 12 of 15–30 pairs";
  report.advice = "it takes 3 more pairs at least, 18 at most: --max-seconds 210";
  conclude(report);
  const std::string sentence =
      "the machine's speed varied by 9.0 % from run to run (limit 5.0 %); --max-seconds ended it after 12 of "
      "15–30 pairs; it takes 3 more pairs at least, 18 at most: --max-seconds 210";
  EXPECT_EQ(report.reason, sentence);
  EXPECT_EQ(count_of(check_text(report), "NOISY: " + sentence + "\n"), 1u) << check_text(report);
  EXPECT_EQ(count_of(check_junit(report), "<skipped message=\"" + sentence + "\"/>"), 1u);
  EXPECT_EQ(count_of(check_markdown(report), "18 at most: --max-seconds 210"), 1u);
  EXPECT_EQ(count_of(check_annotations(report), "18 at most: --max-seconds 210"), 1u);
  const auto json = nlohmann::json::parse(check_json(report).dump());
  EXPECT_EQ(json["advice"], report.advice);
  // A regression of a counter needs no more pairs.
  report.counters.front().verdict = Verdict::regression;
  conclude(report);
  EXPECT_EQ(report.reason.find("more pairs"), std::string::npos) << report.reason;
}

TEST(CheckReport, SaysInWordsThatThereAreNoBounds) {
  EXPECT_EQ(bounds_text({0.5, 0, std::log(1.06), kInfinity}), "+6.0 % at least");
  EXPECT_EQ(bounds_text({0.5, 0, -kInfinity, std::log(1.06)}), "+6.0 % at most");
  EXPECT_EQ(bounds_text({0.5, 0, std::log(0.98), std::log(1.06)}), "-2.0 % ... +6.0 %");
  const Shift none{0.5, std::log(1.02), -kInfinity, kInfinity};
  EXPECT_EQ(bounds_text(none), "none, too few runs");
  EXPECT_EQ(open_text(none), "frames take 2.0 % more time, too few runs for bounds: too little to tell");
  CheckReport report = report_of(Verdict::inconclusive, Verdict::ok);
  report.times.front().shift = none;
  for (const std::string& text : {check_text(report), check_junit(report), check_markdown(report)})
    EXPECT_EQ(text.find("none ..."), std::string::npos) << text;
}

TEST(CheckReport, KeepsItsColumnsApartWhereBoundsAreWide) {
  CheckReport report = report_of(Verdict::noisy, Verdict::ok);
  report.times.front().shift = {0.02, std::log(1.62), std::log(1.257), std::log(2.224)};
  EXPECT_EQ(count_of(check_text(report), "+62.0 %   +25.7 % ... +122.4 %"), 1u) << check_text(report);
}

TEST(CheckReport, SaysThatTheKernelDoesNotTellOfAHypervisor) {
  const Noise noise{0.01, std::nan("")};
  EXPECT_EQ(noise_text(noise), "the kernel does not say what a hypervisor took of the CPU time");
  CheckReport report = report_of(Verdict::noisy, Verdict::ok);
  report.noise = noise;
  EXPECT_EQ(count_of(check_text(report), "an unknown share of the CPU time was stolen"), 1u);
}

TEST(JUnit, SharesTheSecondsOfTheCheckAmongItsCases) {
  // 45.5 s for two cases from the same runs: 22.75 s each, with a point in every locale.
  CheckReport report = report_of(Verdict::ok, Verdict::regression);
  report.seconds = 45.5;
  const std::string text = check_junit(report);
  EXPECT_EQ(count_of(text, "skipped=\"0\" time=\"45.500\">"), 1u) << text;
  EXPECT_EQ(count_of(text, "<testcase "), 2u);
  EXPECT_EQ(count_of(text, "name=\"frame time, median\" time=\"22.750\">"), 1u) << text;
  EXPECT_EQ(count_of(text, "name=\"pixels\" time=\"22.750\">"), 1u) << text;
  // Broken off: the findings so far and the error.
  report.error = "the disk is full";
  report.seconds = 3;
  EXPECT_EQ(count_of(check_junit(report), " time=\"1.000\">"), 3u);
}

TEST(JUnit, HasAnErrorWhenTheCheckBrokeOff) {
  CheckReport report;
  report.session = "s";
  report.error = "pose/data.csv:3: is wrong";
  const std::string text = check_junit(report);
  EXPECT_NE(text.find("tests=\"1\" failures=\"0\" errors=\"1\""), std::string::npos) << text;
  EXPECT_NE(text.find("<error message=\"pose/data.csv:3: is wrong\"/>"), std::string::npos) << text;
}

TEST(JUnit, StaysXmlWhateverNamesHold) {
  CheckReport report;
  report.session = "a<b>&\"c\x01";
  report.verdict = Verdict::not_comparable;
  report.reason = "<&>";
  const std::string text = check_junit(report);
  EXPECT_NE(text.find("a&lt;b&gt;&amp;&quot;c "), std::string::npos) << text;
  EXPECT_NE(text.find("message=\"&lt;&amp;&gt;\""), std::string::npos) << text;
  EXPECT_EQ(text.find('\x01'), std::string::npos);
}

TEST(Markdown, KeepsItsTableWhateverNamesHold) {
  CheckReport report = report_of(Verdict::ok, Verdict::ok);
  report.counters[0].name = "a|b\nc";
  const std::string text = check_markdown(report);
  EXPECT_NE(text.find("| a\\|b c | 1000.0 | 1200.0 | +20.0 % |"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("|\n\n"));
}

TEST(Annotations, EscapeWhatGitHubWouldRead) {
  CheckReport report = report_of(Verdict::regression, Verdict::ok);
  report.session = "a,b:c";
  const std::string text = check_annotations(report);
  EXPECT_EQ(
      text.find("::error title=herr check%2C a%2Cb%3Ac%3A frame time%2C median::frames take 8.0 %25 more"),
      0u)
      << text;
  EXPECT_EQ(count_of(text, "\n"), 1u);
}

TEST(Annotations, AreTenAtMostRegressionsFirst) {
  CheckReport report = report_of(Verdict::noisy, Verdict::ok);
  report.counters.assign(12, {"pixels", Verdict::regression, 1, 2, ""});
  EXPECT_EQ(count_of(check_annotations(report), "::error "), 10u);
  EXPECT_EQ(count_of(check_annotations(report), "::warning "), 0u);
  EXPECT_EQ(check_annotations(report_of(Verdict::ok, Verdict::ok)), "");
  EXPECT_EQ(count_of(check_annotations(report_of(Verdict::noisy, Verdict::ok)), "::warning "), 1u);
}

Baseline small_baseline() {
  Baseline baseline;
  baseline.program = "herr 0.1.0";
  baseline.frames = 40;
  baseline.fingerprint.work.settings = {{"--isa", "avx2"}};
  baseline.runs.resize(2);
  for (RunValues& run : baseline.runs) run = {18.5, 20, 22, 40.25, 0.8, std::nullopt};
  baseline.counters = {{"pixels", 1000, 1001}};
  return baseline;
}

TEST(BaselineFile, ComesBackAsItWas) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "b.json";
  std::ofstream(file) << baseline_text(small_baseline());
  const Baseline back = read_baseline(file);
  EXPECT_EQ(back.frames, 40);
  ASSERT_EQ(back.runs.size(), 2u);
  EXPECT_EQ(back.runs[1].median, 18.5);
  EXPECT_EQ(back.runs[1].rays_ms, 0.8);
  ASSERT_EQ(back.counters.size(), 1u);
  EXPECT_EQ(back.counters[0].highest, 1001);
  EXPECT_EQ(work_difference(back.fingerprint, small_baseline().fingerprint), "");
}

TEST(BaselineFile, OfAnotherFormatIsNotComparableAndADamagedOneIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "b.json";
  const auto read = [&](const std::string& key, const nlohmann::json& value) {
    nlohmann::json document = nlohmann::json::parse(baseline_text(small_baseline()));
    document[key] = value;
    std::ofstream(file) << document.dump();
    read_baseline(file);
  };
  EXPECT_THROW(read("baseline_version", 2), NotComparable);
  EXPECT_THROW(read("calibration_version", 0), NotComparable);
  EXPECT_THROW(read("runs", nlohmann::json::array()), InputError);
  EXPECT_THROW(read("runs", {{{"median", 0}}}), InputError);
  EXPECT_THROW(read("frames", "many"), InputError);
  EXPECT_THROW(read_baseline(folder.path() / "missing.json"), InputError);
}

}  // namespace
}  // namespace herr
