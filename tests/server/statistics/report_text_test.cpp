#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "server/process/progress_bar.h"
#include "server/results/frames_csv.h"
#include "server/results/summary_json.h"
#include "server/statistics/latency_table.h"
#include "server/text/number_text.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

FrameRecord record_of(std::int64_t frame, double first_hits_ms, double light_ms) {
  FrameRecord record;
  record.frame = frame;
  record.times[Stage::first_hits] = first_hits_ms;
  record.times[Stage::light_rays] = light_ms;
  record.times.frame_ms = first_hits_ms + light_ms;
  record.pose_age_ms = 5.0;
  record.motion_to_photon_ms = 25.0;
  record.missed = record.times.frame_ms > 16.7;
  record.counters.rays[RayKind::primary] = 1000;
  return record;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::stringstream stream(row.substr(0, row.size() - 1));
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (row.size() >= 2 && row[row.size() - 2] == ',') cells.emplace_back();
  return cells;
}

std::string cell(const FrameRecord& record, const std::string& column) {
  const auto names = cells_of(frames_csv_header());
  const auto values = cells_of(frames_csv_row(record));
  const auto found = std::find(names.begin(), names.end(), column);
  if (found == names.end()) return "no column " + column;
  return values.at(static_cast<std::size_t>(found - names.begin()));
}

TEST(NumberText, IsFixedAndNeverNan) {
  EXPECT_EQ(fixed_text(1.0 / 3.0, 3), "0.333");
  EXPECT_EQ(fixed_text(1e300, 0).size(), 301u);
  EXPECT_EQ(fixed_text(std::numeric_limits<double>::quiet_NaN(), 3), "n/a");
  EXPECT_EQ(shortest_text(0.1), "0.1");
  EXPECT_EQ(right_aligned("ab", 4) + "|" + left_aligned("ab", 4), "  ab|ab  ");
  EXPECT_EQ(right_aligned("abcdef", 4), "abcdef");
}

TEST(FramesCsv, EveryRowHasAsManyCellsAsTheHeader) {
  FrameRecord bare;
  EXPECT_EQ(cells_of(frames_csv_row(bare)).size(), cells_of(frames_csv_header()).size());
  EXPECT_EQ(cells_of(frames_csv_row(record_of(1, 2, 3))).size(), cells_of(frames_csv_header()).size());
  EXPECT_EQ(frames_csv_row(bare).back(), '\n');
}

// The README's table is the list that users look into: it names the columns, all of them and nothing else.
TEST(FramesCsv, TheReadmesTableNamesTheColumns) {
  std::istringstream readme(
      content_of(std::filesystem::path(test::source_dir()) / "server/results/README.md"));
  std::vector<std::string> told;
  bool inside = false;
  for (std::string line; std::getline(readme, line);) {
    inside = inside ? line.starts_with("|") : line == "| column | what it holds |";
    if (!inside) continue;
    const std::string names = line.substr(0, line.find(" | "));
    for (std::size_t at = names.find('`'); at != std::string::npos; at = names.find('`', at + 1)) {
      const std::size_t end = names.find('`', at + 1);
      told.push_back(names.substr(at + 1, end - at - 1));
      at = end;
    }
  }
  std::vector<std::string> columns = cells_of(frames_csv_header());
  std::sort(told.begin(), told.end());
  std::sort(columns.begin(), columns.end());
  EXPECT_EQ(told, columns);
}

TEST(FramesCsv, EveryColumnOfNumbersNamesItsUnitOrCounts) {
  const auto names = cells_of(frames_csv_header());
  EXPECT_EQ(names[0], "frame");
  EXPECT_EQ(names[1], "t_ns");
  EXPECT_EQ(names[2], "frame_ms");
  for (const std::string& name : names) {
    const bool unit = name.ends_with("_ms") || name.ends_with("_ns") || name.ends_with("_deg") ||
                      name.ends_with("_deg_s") || name.ends_with("_arcmin");
    const bool count = name == "frame" || name == "missed" || name == "stutter" || name == "commits" ||
                       name.ends_with("_rays") || name.ends_with("_samples") || name.ends_with("_pixels") ||
                       name.ends_with("_values") || name.ends_with("_frames") || name.ends_with("_ticks") ||
                       name.ends_with("_probes") || name.ends_with("_paths") || name.ends_with("_share") ||
                       name.starts_with("instances_") || name.starts_with("meshes_") ||
                       name == "plan_changes" || name == "polar_width" || name == "polar_height" ||
                       name == "light_beyond_feed" || name == "preemptions";
    const bool word =
        name.find("_source") != std::string::npos || name == "quality_reason" || name == "miss_cause";
    const bool unit_vector = name.starts_with("gaze_left_") || name.starts_with("gaze_right_");
    EXPECT_TRUE(unit || count || word || unit_vector) << name;
  }
}

TEST(FramesCsv, ValuesStandInTheirColumns) {
  const FrameRecord record = record_of(7, 1.25, 2.5);
  EXPECT_EQ(cell(record, "frame"), "7");
  EXPECT_EQ(cell(record, "frame_ms"), "3.750000");
  EXPECT_EQ(cell(record, "first_hits_ms"), "1.250000");
  EXPECT_EQ(cell(record, "light_rays_ms"), "2.500000");
  EXPECT_EQ(cell(record, "pose_age_ms"), "5.000000");
  EXPECT_EQ(cell(record, "camera_age_ms"), "");
  EXPECT_EQ(cell(record, "primary_rays"), "1000");
  EXPECT_EQ(cell(record, "missed"), "0");
}

TEST(FramesCsv, ARowReadsBackAsTheSameRecord) {
  FrameRecord record = record_of(12, 1.234567, 0.000001);
  record.t_ns = 1'000'000'000;
  record.camera_age_ms = 0.0;
  record.cpu_ms = 2.345678;
  record.gaze_source = {SampleSource::gliding, SampleSource::exact};
  record.gaze_in_head[1] = {0.6, 0.0, -0.8};
  record.period_ms = 11.111111;
  record.nonfinite_pictures = 3;
  record.repeated_ticks = 2;
  record.decision = {{16, 315, 128, 384}, QualityReason::grow_limited, 40.5, 48.25};
  record.missed = true;
  record.cause = MissCause::machine;
  record.preemptions = 17;
  record.clipped_pixels = 1234;
  record.head_deg_s = 31.25;
  record.misregistration_arcmin = 171.5;
  const std::string row = frames_csv_row(record);
  const auto read = frame_record_of(row.substr(0, row.size() - 1));
  ASSERT_TRUE(read);
  EXPECT_EQ(frames_csv_row(*read), row);
  EXPECT_EQ(read->nonfinite_pictures, 3);
  EXPECT_EQ(read->cause, MissCause::machine);
  EXPECT_EQ(read->gaze_in_head[1], glm::dvec3(0.6, 0.0, -0.8));
  EXPECT_EQ(cell(record, "gaze_right_z"), "-0.800000");
  EXPECT_EQ(read->preemptions, 17);
  EXPECT_EQ(read->clipped_pixels, 1234);
  EXPECT_FALSE(read->gaze_age_ms);
  EXPECT_FALSE(read->feed_turn_arcmin);
  EXPECT_EQ(read->decision.reason, QualityReason::grow_limited);
  EXPECT_EQ(read->decision.quality.polar_width, 315);
  EXPECT_EQ(read->decision.quality.polar_height, 384);
  ASSERT_TRUE(read->camera_age_ms);
  // Statistics of rows are those of the run: histograms count whole nanoseconds, and rows state them.
  RunStatistics of_run, of_rows;
  of_run.add(record);
  of_rows.add(*read);
  EXPECT_EQ(of_run.frame, of_rows.frame);
  EXPECT_EQ(of_run.stages, of_rows.stages);
  EXPECT_EQ(of_run.cpu, of_rows.cpu);
}

TEST(FramesCsv, WhatIsNoRowIsNotRead) {
  std::string row = frames_csv_row(record_of(12, 1, 2));
  row.pop_back();
  ASSERT_TRUE(frame_record_of(row));
  // Every shorter text lacks a cell: the last one has a single digit.
  for (std::size_t length = 0; length < row.size(); ++length) {
    EXPECT_FALSE(frame_record_of(row.substr(0, length))) << row.substr(0, length);
  }
  EXPECT_FALSE(frame_record_of(row + ","));
  EXPECT_FALSE(frame_record_of(row + " "));
  std::string nan = row;
  nan.replace(nan.find("3.000000"), 8, "nan");
  EXPECT_FALSE(frame_record_of(nan));
  std::string source = row;
  source.replace(source.find("held"), 4, "helt");
  EXPECT_FALSE(frame_record_of(source));
}

TEST(LatencyTable, HasOneRowPerStageThatRanAndTheWholeFrame) {
  RunStatistics statistics;
  for (int i = 0; i < 4; ++i) statistics.add(record_of(i, 3.0, 1.0));
  const std::string table = latency_table(statistics);
  EXPECT_NE(table.find("first hits"), std::string::npos);
  EXPECT_NE(table.find("75.0 %"), std::string::npos);   // 3 of 4 ms
  EXPECT_NE(table.find("100.0 %"), std::string::npos);  // the frame
  EXPECT_EQ(table.find("overlays"), std::string::npos);
  EXPECT_NE(table.find("motion to photon"), std::string::npos);
  // All values are equal, so every quantile is the exact minimum or maximum: 3 ms.
  const std::string row = table.substr(table.find("first hits"), 78);
  EXPECT_EQ(row, "first hits             3.000     3.000     3.000     3.000     3.000    75.0 %");
  std::stringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 79u) << line;
}

TEST(RunStatistics, MergedRunsEqualOneRunOverAllFrames) {
  RunStatistics whole, first, second;
  for (int i = 0; i < 10; ++i) {
    const FrameRecord record = record_of(i, 0.5 * i, 2.0 * i);
    whole.add(record);
    (i < 6 ? first : second).add(record);
  }
  second.merge(first);
  EXPECT_EQ(second.frame, whole.frame);
  EXPECT_EQ(second.stages, whole.stages);
  EXPECT_EQ(second.motion_to_photon, whole.motion_to_photon);
  EXPECT_EQ(second.counters.rays[RayKind::primary], 10'000);
  // 2.5 i > 16.7 for i = 7, 8, 9.
  EXPECT_EQ(second.missed_frames, 3);
}

TEST(Summary, SaysStateFramesLatencyAndPlan) {
  SessionReport report;
  report.name = "desk\n\xFFwalk";  // not UTF-8: replaced, never refused
  report.state = ReplayState::interrupted;
  report.exit_code = 130;
  report.range.count = 9;
  report.range.first = 0;
  report.plan.entries = {{"mirror rays", false, "skipped: no material reflects"}};
  for (int i = 0; i < 4; ++i) report.statistics.add(record_of(i, 3.0, 1.0));
  const std::string text = json_text(summary_json(report, ReplayOptions()));
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["state"], "interrupted");
  EXPECT_EQ(json["frames"]["rendered"], 4);
  EXPECT_EQ(json["frames"]["planned"], 9);
  EXPECT_DOUBLE_EQ(json["latency"]["frame"]["mean"], 4.0);
  EXPECT_DOUBLE_EQ(json["latency"]["stages"]["first_hits"]["p95"], 3.0);
  EXPECT_EQ(json["latency"]["camera_age"]["count"], 0);
  EXPECT_TRUE(json["latency"]["camera_age"]["p50"].is_null());
  EXPECT_EQ(json["plan"][0]["name"], "mirror rays");
  EXPECT_EQ(json["settings"]["polar_width_per_eye"], 788);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.back(), '\n');
}

TEST(ProgressBar, TellsShareRateAndRemainingTime) {
  // 60 frames in 5 s are 12 frames/s; 60 more take 5 s.
  EXPECT_EQ(progress_text("walk", 60, 120, 5.0),
            "walk [###############---------------]  60/120  12.0 frames/s  ETA 0:05");
  // 30 of the 60 were there before: the rate is that of the others.
  EXPECT_EQ(progress_text("walk", 60, 120, 5.0, 30),
            "walk [###############---------------]  60/120  6.0 frames/s  ETA 0:10");
  EXPECT_EQ(log_progress_text("walk", 60, 120, 5.0, 30), "walk: 60 of 120, 6.0 frames/s, 0:10 left");
  EXPECT_EQ(log_progress_text("walk", 0, 120, 5.0), "walk: 0 of 120");
  EXPECT_EQ(progress_text("walk", 0, 120, 5.0), "walk [------------------------------]  0/120");
  EXPECT_EQ(progress_text("walk", 0, 0, 0.0), "walk [##############################]  0/0");
}

}  // namespace
}  // namespace herr
