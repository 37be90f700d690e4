// stability.json: nothing is lost on the way, and what is broken is refused by the name of its field.
#include "server/study/stability/report/stability_json.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "server/results/summary_json.h"
#include "server/study/stability/report/stability_page.h"
#include "server/study/stability/report/stability_text.h"
#include "sessions/files/input_error.h"
#include "tests/server/study/stability/report/stability_records.h"

namespace herr {
namespace {

StabilityRecord read_again(const StabilityRecord& record) {
  return read_stability(nlohmann::json::parse(json_text(stability_json(record))), "stability.json");
}

TEST(StabilityJson, ReportsOfTheRecordReadAgainAreTheSameBytes) {
  for (const StabilityRecord& record :
       {test::rich_stability(), test::hostile_stability(), StabilityRecord{}}) {
    const StabilityRecord again = read_again(record);
    EXPECT_TRUE(json_text(stability_json(again)) == json_text(stability_json(record))) << record.session;
    EXPECT_TRUE(stability_page(again) == stability_page(record)) << record.session;
    EXPECT_TRUE(stability_text(again) == stability_text(record)) << record.session;
  }
}

TEST(StabilityJson, EveryFieldOfAResultComesBackBitForBit) {
  const StabilityRecord record = test::rich_stability(), again = read_again(record);
  ASSERT_EQ(again.results.size(), record.results.size());
  const auto bits = [](double value) {
    return std::isnan(value) ? std::uint64_t{1} : std::bit_cast<std::uint64_t>(value);
  };
  for (std::size_t i = 0; i < record.results.size(); ++i) {
    const RelationResult &a = record.results[i], &b = again.results[i];
    EXPECT_EQ(b.group, a.group);
    EXPECT_EQ(b.relation.name, a.relation.name);
    EXPECT_EQ(b.relation.holds, a.relation.holds);
    EXPECT_EQ(b.relation.kind, a.relation.kind);
    EXPECT_EQ(bits(b.relation.bound), bits(a.relation.bound));
    EXPECT_EQ(b.relation.unit, a.relation.unit);
    EXPECT_EQ(b.relation.bound_from, a.relation.bound_from);
    EXPECT_EQ(b.relation.option, a.relation.option);
    EXPECT_EQ(b.not_applicable, a.not_applicable);
    EXPECT_EQ(bits(b.error), bits(a.error)) << a.relation.name;
    EXPECT_EQ(b.where, a.where);
    EXPECT_EQ(bits(b.seconds), bits(a.seconds));
  }
  EXPECT_EQ(again.frame.number, 101);
  EXPECT_EQ(again.frame.time_s, 1.0 / 3);
  EXPECT_EQ(again.pictures.at(0).png, record.pictures.at(0).png);
}

TEST(StabilityJson, WhatIsNotFiniteIsNullWithItsText) {
  const nlohmann::json document = nlohmann::json::parse(json_text(stability_json(test::rich_stability())));
  EXPECT_TRUE(document.at("results").at(6).at("error").is_null());
  EXPECT_EQ(document.at("results").at(6).at("error_text"), "nan");
  EXPECT_TRUE(document.at("results").at(7).at("error").is_null());
  EXPECT_EQ(document.at("results").at(7).at("error_text"), "inf");
}

TEST(StabilityJson, RefusesWhatIsBrokenByTheNameOfItsField) {
  const nlohmann::json whole = nlohmann::json::parse(json_text(stability_json(test::rich_stability())));
  const struct {
    const char* pointer;
    nlohmann::json value;
    const char* says;
  } cases[] = {
      {"/stability_version", 2, "stability_version"},
      {"/results/0/kind", "exactly", "results[0].kind"},
      {"/results/1/error", "0.1", "results[1].error"},
      {"/results/1/colour", "red", "colour"},
      {"/results/6/error_text", "none", "error_text"},
      {"/pictures/0/png", "!", "pictures[0].png"},
      {"/threads", -1, "threads"},
      {"/results", nullptr, "results"},
  };
  for (const auto& one : cases) {
    nlohmann::json broken = whole;
    broken[nlohmann::json::json_pointer(one.pointer)] = one.value;
    try {
      read_stability(broken, "stability.json");
      ADD_FAILURE() << one.pointer << " was taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(one.says), std::string::npos) << error.what();
    }
  }
}

TEST(StabilityJson, IsToldFromAStudyByItsVersion) {
  EXPECT_TRUE(is_stability_json(nlohmann::json::parse(R"({"stability_version": 7})")));
  EXPECT_FALSE(is_stability_json(nlohmann::json::parse(R"({"study_version": 1})")));
  EXPECT_FALSE(is_stability_json(nlohmann::json::parse("[]")));
}

}  // namespace
}  // namespace herr
