// Records of measured runs, there and back; what a run comes down to; the processes and counts behind them.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "server/check/measure/allocation_counter.h"
#include "server/check/measure/child_process.h"
#include "server/check/measure/measure_run.h"
#include "server/check/measure/measurement.h"
#include "server/check/measure/not_comparable.h"
#include "server/check/measure/run_values.h"
#include "server/process/exit_code.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

Measurement small_measurement() {
  Measurement measurement;
  measurement.program = "herr 0.1.0";
  measurement.fingerprint.work.settings = {{"--isa", "avx2"}};
  measurement.fingerprint.work.inputs = {{"session.json", "10 bytes"}};
  measurement.fingerprint.machine = {{"--threads", "2"}};
  measurement.frame_ms = {10, 40, 30};
  measurement.calibration_rays_ms = {1, 1, 1, 3};
  measurement.calibration_memory_ms = {1, 1, 3, 3};
  measurement.counters = {{"rays.primary", 100.0}, {"allocations", std::nullopt}};
  measurement.cpu = CpuTicks{190, 10};
  return measurement;
}

nlohmann::json record() {
  return nlohmann::json::parse(measurement_json(small_measurement()).dump());
}

TEST(Measurement, ComesBackAsItWas) {
  const Measurement there = small_measurement();
  const Measurement back = read_measurement(record(), "x");
  EXPECT_EQ(back.program, there.program);
  EXPECT_EQ(back.frame_ms, there.frame_ms);
  EXPECT_EQ(back.calibration_rays_ms, there.calibration_rays_ms);
  EXPECT_EQ(back.calibration_memory_ms, there.calibration_memory_ms);
  EXPECT_EQ(work_difference(there.fingerprint, back.fingerprint), "");
  EXPECT_EQ(machine_difference(there.fingerprint, back.fingerprint), "");
  ASSERT_TRUE(back.cpu);
  EXPECT_EQ(back.cpu->used, 190);
  EXPECT_EQ(back.cpu->stolen, 10);
  // Sorted by name, as JSON libraries do.
  ASSERT_EQ(back.counters.size(), 2u);
  EXPECT_EQ(back.counters[0].first, "allocations");
  EXPECT_FALSE(back.counters[0].second);
  EXPECT_EQ(back.counters[1].second, 100.0);
}

TEST(Measurement, OfAnotherFormatIsNotComparable) {
  for (const char* key : {"measurement_version", "calibration_version"}) {
    nlohmann::json other = record();
    other[key] = 99;
    try {
      read_measurement(other, "old-herr");
      FAIL() << key;
    } catch (const NotComparable& difference) {
      const std::string what = difference.what();
      EXPECT_NE(what.find("old-herr"), std::string::npos) << what;
      EXPECT_NE(what.find("99"), std::string::npos) << what;
    }
  }
}

TEST(Measurement, WithAnythingMissingIsRefused) {
  for (const char* key : {"program", "fingerprint", "frame_ms", "calibration_rays_ms",
                          "calibration_memory_ms", "counters", "cpu_ticks"}) {
    nlohmann::json damaged = record();
    damaged.erase(key);
    EXPECT_THROW(read_measurement(damaged, "x"), InputError) << key;
  }
  nlohmann::json zero = record(), short_calibration = record(), no_frames = record(), null_time = record();
  zero["frame_ms"][1] = 0;
  short_calibration["calibration_rays_ms"].erase(3);
  no_frames["frame_ms"] = nlohmann::json::array();
  null_time["frame_ms"][0] = nullptr;
  for (const nlohmann::json& damaged : {zero, short_calibration, no_frames, null_time}) {
    EXPECT_THROW(read_measurement(damaged, "x"), InputError) << damaged["frame_ms"].dump();
  }
}

TEST(Measurement, DifferencesNameTheSettingOrTheMachine) {
  const Measurement before = small_measurement();
  Measurement now = before;
  now.fingerprint.work.settings[0].second = "avx512";
  EXPECT_EQ(work_difference(before.fingerprint, now.fingerprint), "--isa was avx2, is avx512");
  EXPECT_EQ(machine_difference(before.fingerprint, now.fingerprint), "");
  now.fingerprint.machine[0].second = "4";
  EXPECT_EQ(machine_difference(before.fingerprint, now.fingerprint), "--threads was 2, is 4");
}

TEST(Measurement, ComparesProgramsOfWhichOneHasASettingMore) {
  const Measurement before = small_measurement();
  Measurement now = before;
  now.fingerprint.work.settings.insert(now.fingerprint.work.settings.begin(), {"--new", "off"});
  EXPECT_EQ(work_difference(before.fingerprint, now.fingerprint), "");
  EXPECT_EQ(work_difference(now.fingerprint, before.fingerprint), "");
  // Another file is other work.
  now.fingerprint.work.inputs.emplace_back("more.csv", "1 bytes");
  EXPECT_EQ(work_difference(before.fingerprint, now.fingerprint), "more.csv was not among the inputs");
}

TEST(RunValues, DivideEachFrameByTheCalibrationsBesideIt) {
  // Units rays + memory are 2 2 4 6. The quicker ones beside the frames: 2, 2, 4; quotients 10/2, 40/2, 30/4
  // = 5, 20, 7.5. Median 7.5; the 95th percentile and the slowest 5 % of three frames are the largest.
  const RunValues values = run_values(small_measurement());
  EXPECT_DOUBLE_EQ(values.median, 7.5);
  EXPECT_DOUBLE_EQ(values.p95, 20);
  EXPECT_DOUBLE_EQ(values.worst_twentieth, 20);
  EXPECT_DOUBLE_EQ(values.frame_ms, 30);
  EXPECT_DOUBLE_EQ(values.rays_ms, 1);
}

TEST(RunValues, OfAMachineTwiceAsSlowAreTheSame) {
  Measurement slow = small_measurement();
  for (auto* times : {&slow.frame_ms, &slow.calibration_rays_ms, &slow.calibration_memory_ms}) {
    for (double& ms : *times) ms *= 2;
  }
  EXPECT_DOUBLE_EQ(run_values(slow).median, run_values(small_measurement()).median);
}

TEST(RunValues, TellTheNoiseOfAllRunsTogether) {
  RunValues a = run_values(small_measurement()), b = a;
  b.cpu = CpuTicks{790, 10};
  // 20 of 1000 ticks.
  EXPECT_DOUBLE_EQ(noise_of(std::vector<RunValues>{a, b}).steal, 0.02);
  b.cpu.reset();
  EXPECT_TRUE(std::isnan(noise_of(std::vector<RunValues>{a, b}).steal));
}

TEST(CounterRanges, KeepTheExtremesAndDropWhatIsUnknown) {
  Measurement a = small_measurement(), b = a;
  b.counters[0].second = 110.0;
  b.counters.emplace_back("rays.mirror", 5.0);
  const std::vector<CounterRange> ranges = counter_ranges(std::vector<Measurement>{a, b});
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].name, "rays.primary");
  EXPECT_EQ(ranges[0].lowest, 100);
  EXPECT_EQ(ranges[0].highest, 110);
  // Not listed by the first run: it traced none.
  EXPECT_EQ(ranges[1].name, "rays.mirror");
  EXPECT_EQ(ranges[1].lowest, 0);
  EXPECT_EQ(ranges[1].highest, 5);
}

TEST(CounterRanges, TakeKindsOfRaysThatAProgramDoesNotKnowForNone) {
  std::vector<CounterRange> before{{"rays.primary", 1, 1}},
      now{{"rays.primary", 1, 1}, {"rays.new", 2, 2}, {"x", 3, 3}};
  complete_ray_kinds(before, now);
  ASSERT_EQ(before.size(), 2u);
  EXPECT_EQ(before[1].name, "rays.new");
  EXPECT_EQ(before[1].highest, 0);
  EXPECT_EQ(judge_counters(before, now)[1].verdict, Verdict::regression);
}

TEST(CpuTicks, ComeFromTheFirstLineOfProcStat) {
  const auto ticks = parse_cpu_ticks("cpu  10 20 30 4000 500 6 7 8 9 10\ncpu0 1 1 1 1 1 1 1 1");
  ASSERT_TRUE(ticks);
  EXPECT_EQ(ticks->used, 10 + 20 + 30 + 6 + 7);
  EXPECT_EQ(ticks->stolen, 8);
  EXPECT_FALSE(parse_cpu_ticks("cpu 1 2 3"));
  EXPECT_FALSE(parse_cpu_ticks(""));
}

TEST(AllocationCounter, CountsWhileItIsOn) {
  if (!allocations_counted()) GTEST_SKIP() << "a sanitizer owns the allocator";
  const auto counted_by = [](auto&& work) {
    const std::int64_t before = *allocations_counted();
    work();
    return *allocations_counted() - before;
  };
  std::unique_ptr<int> kept;
  std::vector<double> aligned;
  EXPECT_EQ(counted_by([&] { kept = std::make_unique<int>(1); }), 0);
  count_allocations(true);
  EXPECT_EQ(counted_by([&] { kept = std::make_unique<int>(2); }), 1);
  EXPECT_EQ(counted_by([&] { aligned.resize(100); }), 1);
  EXPECT_EQ(counted_by([&] { aligned.resize(10); }), 0);
  count_allocations(false);
  EXPECT_EQ(counted_by([&] { kept = std::make_unique<int>(3); }), 0);
}

TEST(WarmUp, TakesTenFramesAndLeavesHalfOfAShortRun) {
  EXPECT_EQ(warm_up_frames(40), 10);
  EXPECT_EQ(warm_up_frames(6), 3);
  EXPECT_EQ(warm_up_frames(3), 1);
}

ProcessOutcome shell(const std::string& script, double most_seconds = 20) {
  return run_process("/bin/sh", {"-c", script}, most_seconds);
}

TEST(ChildProcess, ReturnsWhatWasSaidAndTheExitCode) {
  const ProcessOutcome outcome = shell("echo result; echo message >&2; exit 7");
  EXPECT_EQ(outcome.exit_code, 7);
  EXPECT_EQ(outcome.out, "result\n");
  EXPECT_EQ(outcome.err, "message\n");
}

TEST(ChildProcess, TakesMoreThanAPipeHoldsFromBoth) {
  const ProcessOutcome outcome = shell("head -c 300000 /dev/zero >&2; head -c 400000 /dev/zero");
  EXPECT_EQ(outcome.out.size(), 400000u);
  EXPECT_EQ(outcome.err.size(), 300000u);
}

TEST(ChildProcess, TellsOfASignal) {
  EXPECT_EQ(shell("kill -9 $$").exit_code, 128 + 9);
}

TEST(ChildProcess, EndsWhatTakesTooLong) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(shell("exec sleep 60", 0.1), TemporaryError);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(ChildProcess, SaysWhenAProgramCannotBeRun) {
  EXPECT_THROW(run_process("/nonexistent/herr", {}, 1), std::system_error);
}

}  // namespace
}  // namespace herr
