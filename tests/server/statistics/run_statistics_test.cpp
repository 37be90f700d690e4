// Runs merge exactly: whatever frames they are split into and in whatever order they come together.
#include "server/statistics/run_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "server/statistics/frame_pace.h"
#include "server/statistics/statistics_rows.h"

namespace herr {
namespace {

// A frame in which nothing is 0 for long, and with everything optional there or not.
FrameRecord random_record(std::mt19937_64& random) {
  std::lognormal_distribution<double> ms(1.5, 1.2);
  const auto count = [&] { return static_cast<std::int64_t>(random() % 1000); };
  const auto maybe = [&]() -> std::optional<double> {
    return random() % 3 == 0 ? std::nullopt : std::optional<double>(ms(random));
  };
  FrameRecord record;
  for (double& stage : record.times.ms) stage = ms(random);
  record.times.frame_ms = ms(random);
  for_each_counter(record.counters, [&](const std::string&, std::int64_t& value) { value = count(); });
  record.probes.active = count();
  record.sample_ms = ms(random), record.write_ms = ms(random), record.wait_ms = ms(random);
  record.pose_age_ms = maybe(), record.gaze_age_ms = maybe(), record.camera_age_ms = maybe();
  record.motion_to_photon_ms = maybe(), record.cpu_ms = maybe();
  record.decision.quality.polar_width = static_cast<int>(count());
  record.decision.quality.polar_height = static_cast<int>(count());
  record.decision.quality.probes = static_cast<int>(count());
  record.decision.quality.light_samples = static_cast<int>(count());
  record.decision.reason = static_cast<QualityReason>(random() % kQualityReasons);
  record.head_deg_s = ms(random);
  record.feed_turn_arcmin = maybe(), record.feed_shift_arcmin = maybe();
  record.misregistration_arcmin = maybe();
  record.missed = random() % 2 == 0;
  record.stutter = random() % 4 == 0;
  record.dropped_frames = count(), record.repeated_ticks = count(), record.nonfinite_pictures = count();
  return record;
}

// Row by row, so that a failure names the row.
void expect_same(const RunStatistics& one, const RunStatistics& other) {
  EXPECT_EQ(one.stages, other.stages);
  EXPECT_EQ(one.reasons, other.reasons);
  for (const DistributionRow& row : distribution_rows()) {
    EXPECT_TRUE(one.*row.values == other.*row.values) << row.name;
  }
  for (const CountRow& row : count_rows()) EXPECT_EQ(one.*row.total, other.*row.total) << row.name;
  for (const CounterRow& row : counter_rows()) {
    EXPECT_EQ(one.counters.*row.value, other.counters.*row.value) << row.name;
  }
  EXPECT_EQ(one.counters.rays.of_kind, other.counters.rays.of_kind);
  EXPECT_EQ(one.stutter_share_of_time(), other.stutter_share_of_time());
}

TEST(RunStatisticsTest, SplitAtRandomAndMergedInAnyOrderTheyAreThoseOfTheWholeRun) {
  const std::uint64_t seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 20; ++round) {
    RunStatistics whole;
    std::vector<RunStatistics> parts(1 + random() % 6);
    const int frames = static_cast<int>(random() % 60);
    for (int i = 0; i < frames; ++i) {
      const FrameRecord record = random_record(random);
      whole.add(record);
      parts[random() % parts.size()].add(record);
    }
    // Two at a time, any two: neither order nor grouping matters.
    while (parts.size() > 1) {
      std::shuffle(parts.begin(), parts.end(), random);
      const RunStatistics last = parts.back();
      parts.pop_back();
      parts.front().merge(last);
    }
    expect_same(parts.front(), whole);
  }
}

TEST(RunStatisticsTest, ProbesAreOfOneRunAlone) {
  std::mt19937_64 random(1);
  const FrameRecord record = random_record(random);
  RunStatistics run, empty;
  EXPECT_FALSE(run.probes);
  run.add(record);
  ASSERT_TRUE(run.probes);
  EXPECT_EQ(run.probes->active, record.probes.active);
  run.merge(empty);
  EXPECT_TRUE(run.probes) << "a run without frames adds nothing";
  empty.merge(run);
  EXPECT_TRUE(empty.probes) << "nor does it take anything away";
  run.merge(empty);
  EXPECT_FALSE(run.probes) << "of two runs there is no newest frame";
  run.merge(empty);
  EXPECT_FALSE(run.probes);
}

TEST(RunStatisticsTest, StutterIsAsEachFramesOwnRunSawIt) {
  StutterWatch watch;
  RunStatistics whole, first, second;
  int frame = 0;
  for (const double ms : {10.0, 10.0, 10.0, 10.0, 40.0, 10.0}) {
    FrameRecord record;
    record.times.frame_ms = ms;
    record.stutter = watch.next_ms(ms);
    whole.add(record);
    (frame++ < 4 ? first : second).add(record);  // the stutter is the first frame of its part
  }
  EXPECT_EQ(whole.stutter_frames, 1);
  EXPECT_DOUBLE_EQ(whole.stutter_share_of_time(), 40.0 / 90);
  second.merge(first);
  expect_same(second, whole);
}

TEST(StatisticsRowsTest, NamesAndMetricsAreThereOnce) {
  std::set<std::string> names, metrics;
  for (const DistributionRow& row : distribution_rows())
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
  for (const CountRow& row : count_rows()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    if (row.metric == nullptr) continue;
    EXPECT_TRUE(metrics.insert(row.metric).second) << row.metric;
  }
  for (const CounterRow& row : counter_rows()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(metrics.insert(row.name).second) << row.name;
    EXPECT_EQ(row.sentence[std::string(row.sentence).size() - 1], '.') << row.name;
  }
}

}  // namespace
}  // namespace herr
