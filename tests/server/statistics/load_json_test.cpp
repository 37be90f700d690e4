// CPU time as milliseconds of a frame and as a share of the cores, in JSON and in words.
#include "server/statistics/load_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "server/statistics/latency_table.h"

namespace herr {
namespace {

RunStatistics run_of(std::initializer_list<std::pair<double, std::optional<double>>> frames) {
  RunStatistics run;
  for (const auto& [frame_ms, cpu_ms] : frames) {
    FrameRecord record;
    record.times.frame_ms = frame_ms;
    record.cpu_ms = cpu_ms;
    run.add(record);
  }
  return run;
}

TEST(LoadJson, TheShareIsOverWallTimeOnEveryCore) {
  // (30 + 60 + 90) / ((20 + 40 + 60) * 2) = 180 / 240.
  const RunStatistics run = run_of({{20, 30}, {40, 60}, {60, 90}});
  const auto json = load_json(run, {2, 790'000'000});
  EXPECT_NEAR(json["cpu_share"].get<double>(), 0.75, 1e-9);
  EXPECT_NEAR(json["cpu"]["mean"].get<double>(), 60, 1e-6);
  EXPECT_EQ(json["cpu"]["count"], 3);
  EXPECT_EQ(json["cpu"]["unit"], "ms");
  EXPECT_EQ(json["cores"], 2);
  EXPECT_EQ(json["peak_resident_bytes"], 790'000'000);
  EXPECT_EQ(cpu_text(run, 2), "60.0 ms of CPU for each frame, 75.0 % of 2 cores");
  EXPECT_EQ(cpu_text(60.0, 40, 1), "60.0 ms of CPU for each frame, 150.0 % of 1 core");
  EXPECT_EQ(peak_text({2, 790'000'000}), "790.0 MB");
  EXPECT_NE(latency_table(run).find("CPU, all threads"), std::string::npos);
}

TEST(LoadJson, WhatTheKernelDoesNotTellIsNull) {
  const RunStatistics run = run_of({{20, std::nullopt}, {40, std::nullopt}});
  const auto json = load_json(run, {2, std::nullopt});
  EXPECT_TRUE(json["cpu_share"].is_null());
  EXPECT_TRUE(json["cpu"]["mean"].is_null());
  EXPECT_TRUE(json["peak_resident_bytes"].is_null());
  EXPECT_EQ(cpu_text(run, 2), "CPU time of a frame n/a");
  EXPECT_EQ(peak_text({2, std::nullopt}), "n/a");
  EXPECT_EQ(latency_table(run).find("CPU, all threads"), std::string::npos);
  EXPECT_TRUE(load_json(RunStatistics(), {2, std::nullopt})["cpu_share"].is_null()) << "no frame at all";
}

}  // namespace
}  // namespace herr
