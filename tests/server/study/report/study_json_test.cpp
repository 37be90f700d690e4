// study.json: nothing is lost on the way, and what is broken is refused by the name of its field.
#include "server/study/report/study_json.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "server/study/report/study_page.h"
#include "server/study/report/study_text.h"
#include "sessions/files/input_error.h"
#include "tests/server/study/report/study_records.h"

namespace herr {
namespace {

std::string text_of(const StudyRecord& record) {
  return study_json(record).dump(1);
}

StudyRecord read_again(const StudyRecord& record) {
  return read_study(nlohmann::json::parse(text_of(record)), "study.json");
}

TEST(StudyJson, ReportsOfTheRecordReadAgainAreTheSameBytes) {
  for (const StudyRecord& record :
       {test::rich_record(), test::minimal_record(), test::hostile_record(), StudyRecord{}}) {
    const StudyRecord again = read_again(record);
    // Not EXPECT_EQ: it looks for the smallest difference of two long texts, for minutes.
    EXPECT_TRUE(text_of(again) == text_of(record)) << record.session;
    EXPECT_TRUE(study_page(again) == study_page(record)) << record.session;
    EXPECT_TRUE(study_text(again) == study_text(record)) << record.session;
  }
}

TEST(StudyJson, DoublesComeBackBitForBit) {
  StudyRecord record = test::minimal_record();
  const double values[] = {0.1,
                           1.0 / 3,
                           -0.0,
                           5e-324,
                           std::numeric_limits<double>::min(),
                           std::numeric_limits<double>::max(),
                           std::nextafter(1.0, 2.0),
                           123456789012345678.0};
  for (const double value : values) {
    StudyPoint point;
    point.error.value[kAllPixels][0] = value;
    point.own_error = ErrorTable();
    point.own_error->value[0][kMetrics - 1] = value;
    point.bias = point.n = point.frame_ms = value;
    point.time_ratio = {value, value, value};
    point.counters = {{"z", value}, {"a", 1}};
    record.points.push_back(point);
  }
  const StudyRecord again = read_again(record);
  ASSERT_EQ(again.points.size(), record.points.size());
  for (std::size_t i = 0; i < again.points.size(); ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(values[i]);
    const StudyPoint& point = again.points[i];
    ASSERT_TRUE(point.own_error && point.bias);
    for (const double value : {point.error.value[kAllPixels][0], point.own_error->value[0][kMetrics - 1],
                               *point.bias, point.n, point.frame_ms, point.time_ratio.estimate,
                               point.time_ratio.lower, point.time_ratio.upper, point.counters.at(0).second}) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(value), bits) << values[i];
    }
    EXPECT_EQ(point.counters[0].first, "z");  // in order, not sorted
  }
}

TEST(StudyJson, WhatIsNotFiniteIsAbsentAndComesBackAsNotKnown) {
  StudyRecord record = test::minimal_record();
  record.minutes_taken = std::numeric_limits<double>::infinity();
  record.points.emplace_back();
  const nlohmann::json document = nlohmann::json::parse(text_of(record));
  EXPECT_FALSE(document.contains("minutes_taken"));
  EXPECT_TRUE(document.at("points").at(0).at("error").empty());
  const StudyRecord again = read_study(document, "study.json");
  EXPECT_TRUE(std::isnan(again.minutes_taken));
  EXPECT_TRUE(std::isnan(again.points[0].time_ratio.estimate));
  EXPECT_EQ(again.points[0].time_ratio.lower, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(again.points[0].time_ratio.upper, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(again.points[0].own_error);
  EXPECT_FALSE(again.points[0].bias);
}

TEST(StudyJson, PicturesComeBackByteForByte) {
  const StudyRecord record = test::rich_record();
  EXPECT_EQ(read_again(record).pictures.at(1).png, record.pictures.at(1).png);
}

TEST(StudyJson, SaysWhatEveryMetricAndBandIs) {
  const nlohmann::ordered_json document = study_json(test::minimal_record());
  for (const MetricRow& metric : metric_rows()) {
    EXPECT_TRUE(document.at("definitions").at("metrics").contains(metric.name)) << metric.name;
  }
  for (const Band& band : bands()) {
    EXPECT_TRUE(document.at("definitions").at("bands").contains(band.name)) << band.name;
  }
}

TEST(StudyJson, RefusesBrokenFieldsByTheirName) {
  const nlohmann::json good = nlohmann::json::parse(text_of(test::rich_record()));
  const std::pair<const char*, const char*> broken[] = {
      {"/study_version", "2"},
      {"/study_version", "\"1\""},
      {"/session", "7"},
      {"/triangles", "-1"},
      {"/threads", "1.5"},
      {"/minutes_taken", "null"},
      {"/aims/1/met", "\"yes\""},
      {"/aims/0/measured", "[1, 2, 3]"},
      {"/points", "{}"},
      {"/points/3/name", "null"},
      {"/points/3/time_ratio/upper", "\"1\""},
      {"/points/3/error/all/rmse", "true"},
      {"/points/3/error/all/rmsd", "1"},
      {"/points/3/error/everything", "{}"},
      {"/points/3/counters/0/per_frame", "[]"},
      {"/points/0/flicker/all/excess", "\"\""},
      {"/fits/0/metric", "\"acuity\""},
      {"/fits/0/fit/points", "-3"},
      {"/left_out/0", "1"},
      {"/pictures/0/png", "\"@@@@\""},
      {"/pictures/0/png", "\"AAAA\""},  // base64, but no PNG
      {"/pictures/0/width_px", "100000"},
      {"/references/0/pases", "1"},
      {"/surprise", "1"},
  };
  ASSERT_NO_THROW(read_study(good, "study.json"));
  for (const auto& [path, value] : broken) {
    nlohmann::json document = good;
    const nlohmann::json::json_pointer at(path);
    document[at] = nlohmann::json::parse(value);
    try {
      read_study(document, "study.json");
      ADD_FAILURE() << path << " = " << value << " was read";
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("study.json"), std::string::npos) << what;
      // The path as strict_json writes it: points[3].error.all.rmse
      std::string field;
      std::string part;
      for (const char* c = path + 1;; ++c) {
        if (*c != '/' && *c != '\0') {
          part += *c;
          continue;
        }
        const bool index = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
        field += index ? "[" + part + "]" : (field.empty() ? "" : ".") + part;
        part.clear();
        if (*c == '\0') break;
      }
      EXPECT_NE(what.find("field " + field), std::string::npos) << field << ": " << what;
    }
  }
}

TEST(StudyJson, RefusesWhatLacksAField) {
  const nlohmann::json good = nlohmann::json::parse(text_of(test::rich_record()));
  for (const char* key : {"study_version", "session", "frames", "points", "warnings", "pictures"}) {
    nlohmann::json document = good;
    document.erase(key);
    EXPECT_THROW(read_study(document, "study.json"), InputError) << key;
  }
  EXPECT_THROW(read_study(nlohmann::json::array(), "study.json"), InputError);
}

TEST(StudyJson, SaysWhichVersionsThereAre) {
  nlohmann::json document = nlohmann::json::parse(text_of(test::minimal_record()));
  document["study_version"] = 9;
  document["not_of_version_1"] = true;  // the version is the better explanation
  try {
    read_study(document, "study.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is 9, this program reads 1"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace herr
