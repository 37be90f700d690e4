// Rows of study.csv: what is written is read again, bit for bit, and what is no row is none.
#include "server/study/measure/study_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace herr {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// All finite doubles are alike to it: subnormal ones, -0 and the largest come as well.
class AnyNumber {
 public:
  explicit AnyNumber(std::uint64_t seed) : engine_(seed) {}
  double operator()() {
    for (;;) {
      const auto value = std::bit_cast<double>(engine_());
      if (std::isfinite(value)) return value;
    }
  }
  bool rarely() { return engine_() % 8 == 0; }
  std::int64_t count() { return static_cast<std::int64_t>(engine_() >> 1); }

 private:
  std::mt19937_64 engine_;
};

ErrorTable any_errors(AnyNumber& any) {
  ErrorTable table;
  for (auto& band : table.value) {
    for (double& value : band) value = any.rarely() ? kNan : any();
  }
  table.value[kAllPixels][0] = any();
  return table;
}

StudyRow any_row(AnyNumber& any) {
  StudyRow row;
  row.name = "filter \"bicubic\", N = 1";
  row.knob = "filter", row.base = "N = 1", row.value = "a,b";
  row.flags = "--filter bicubic";
  row.n = any(), row.frame = any.count();
  row.reference = "endless effort, --probes", row.own_reference = "\"";
  row.error = any_errors(any);
  if (!any.rarely()) row.own_error = any_errors(any);
  if (!any.rarely()) row.bias = any();
  for (int i = 0; i < 4; ++i) row.log_ratios.push_back(any()), row.work_log_ratios.push_back(any());
  row.frame_ms = any(), row.pixels_ms = any(), row.calibration_ms = any.rarely() ? kNan : any();
  for_each_counter(row.counters, [&](const std::string&, std::int64_t& count) { count = any.count(); });
  if (!any.rarely()) {
    row.flicker.emplace();
    for (auto* values : {&row.flicker->test, &row.flicker->reference, &row.flicker->excess}) {
      for (double& value : *values) value = any.rarely() ? kNan : any();
    }
  }
  row.seconds = any();
  return row;
}

bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}
template <class Values>
bool all_same(const Values& a, const Values& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}
bool all_same(const std::optional<ErrorTable>& a, const std::optional<ErrorTable>& b) {
  if (!a || !b) return !a && !b;
  for (std::size_t band = 0; band < kBands; ++band) {
    if (!all_same(a->value[band], b->value[band])) return false;
  }
  return true;
}

void expect_same(const StudyRow& a, const StudyRow& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.knob, b.knob);
  EXPECT_EQ(a.base, b.base);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.flags, b.flags);
  EXPECT_EQ(a.reference, b.reference);
  EXPECT_EQ(a.own_reference, b.own_reference);
  EXPECT_EQ(a.frame, b.frame);
  for (const auto number : {&StudyRow::n, &StudyRow::frame_ms, &StudyRow::pixels_ms,
                            &StudyRow::calibration_ms, &StudyRow::seconds}) {
    EXPECT_TRUE(same(a.*number, b.*number)) << a.*number << " " << b.*number;
  }
  EXPECT_TRUE(all_same(a.error, b.error));
  EXPECT_TRUE(all_same(a.own_error, b.own_error));
  ASSERT_EQ(a.bias.has_value(), b.bias.has_value());
  EXPECT_TRUE(same(a.bias.value_or(0), b.bias.value_or(0)));
  EXPECT_TRUE(all_same(a.log_ratios, b.log_ratios));
  EXPECT_TRUE(all_same(a.work_log_ratios, b.work_log_ratios));
  EXPECT_EQ(a.counters.rays.of_kind, b.counters.rays.of_kind);
  for (const CounterRow& row : counter_rows()) EXPECT_EQ(a.counters.*row.value, b.counters.*row.value);
  ASSERT_EQ(a.flicker.has_value(), b.flicker.has_value());
  if (!a.flicker) return;
  EXPECT_TRUE(all_same(a.flicker->test, b.flicker->test));
  EXPECT_TRUE(all_same(a.flicker->reference, b.flicker->reference));
  EXPECT_TRUE(all_same(a.flicker->excess, b.flicker->excess));
}

std::string line_of(const StudyRow& row) {
  const std::string text = study_csv_row(row);
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  return text.substr(0, text.size() - 1);
}

TEST(StudyRow, IsReadAgainBitForBit) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    AnyNumber any(seed);
    const StudyRow row = any_row(any);
    const std::optional<StudyRow> again = study_row_of(line_of(row));
    ASSERT_TRUE(again);
    expect_same(row, *again);
  }
  const std::optional<StudyRow> empty = study_row_of(line_of({}));
  ASSERT_TRUE(empty);
  expect_same({}, *empty);
  EXPECT_FALSE(empty->error || empty->own_error || empty->bias || empty->flicker);
}

TEST(StudyRow, HasACellForEachColumn) {
  const std::string header = study_csv_header(), row = study_csv_row({});
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(row.begin(), row.end(), ','));
  for (const char* column : {"name,knob,", ",acuity_rmse_all,", ",own_flip_0_5_deg,", ",bias_rmse,",
                             ",primary_rays,", ",flicker_excess_all,"}) {
    EXPECT_NE(header.find(column), std::string::npos) << column;
  }
}

// Within its last cell it cannot be told: there the line break is missing, for which whoever reads lines
// looks.
TEST(StudyRow, ALineThatWasCutOffIsNone) {
  AnyNumber any(7);
  const std::string line = line_of(any_row(any));
  for (std::size_t end = 0; end <= line.rfind(','); ++end) {
    EXPECT_FALSE(study_row_of(std::string_view(line).substr(0, end))) << end;
  }
  EXPECT_TRUE(study_row_of(line));
  EXPECT_FALSE(study_row_of(line + ","));
}

TEST(StudyRow, WhatIsNoNumberIsNone) {
  StudyRow row;
  row.frame = 4711, row.seconds = 1.5, row.n = 23.5;
  const std::string line = line_of(row);
  ASSERT_TRUE(study_row_of(line));
  for (const auto& [number, damaged] : {std::pair{"4711", "47x1"},
                                        {"4711", "4711x"},
                                        {"4711", ""},
                                        {"4711", " 4711"},
                                        {"4711", "99999999999999999999"},
                                        {"23.5", "23,5"},
                                        {"23.5", "23.5 "},
                                        {"1.5", "1.5.5"}}) {
    std::string changed = line;
    changed.replace(changed.rfind(number), std::string(number).size(), damaged);
    EXPECT_FALSE(study_row_of(changed)) << number << " as '" << damaged << "'";
  }
}

}  // namespace
}  // namespace herr
