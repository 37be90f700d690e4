// Maps are written so that they read back as the same maps.
#include "sessions/import/map/column_map_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "sessions/files/input_file.h"
#include "sessions/import/map/column_map.h"
#include "tests/paths.h"
#include "tests/sessions/import/map/map_text.h"

namespace herr::test {
namespace {

std::vector<std::filesystem::path> maps_of_the_source() {
  std::vector<std::filesystem::path> files;
  const auto folder = std::filesystem::path(source_dir()) / "sessions/import/presets/maps";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void expect_same_map_again(const ColumnMap& map) {
  const std::string text = column_map_text(map);
  const ColumnMap again = parse_column_map(text, "written.json");
  EXPECT_TRUE(again == map) << text;
  EXPECT_EQ(column_map_text(again), text);
}

TEST(ColumnMapText, OfEveryBuiltInMapReadsBackAsTheSame) {
  const auto files = maps_of_the_source();
  ASSERT_GE(files.size(), 7u);
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename());
    expect_same_map_again(read_column_map(file));
  }
}

TEST(ColumnMapText, OfTheExampleInTheReadmeReadsBackAsTheSame) {
  const auto readme = std::filesystem::path(source_dir()) / "sessions/import/map/README.md";
  const std::string text = read_whole_file(readme, 1 << 20), fence = "```json\n";
  const std::size_t begin = text.find(fence) + fence.size();
  const ColumnMap map = parse_column_map(text.substr(begin, text.find("```", begin) - begin), "README.md");
  EXPECT_EQ(map.layouts.size(), 1u);
  expect_same_map_again(map);
}

TEST(ColumnMapText, OfEveryKeyReadsBackAsTheSame) {
  const ColumnMap map = parse_column_map(kEveryKey, "every.json");
  ASSERT_EQ(map.head.size(), 10u);
  ASSERT_EQ(map.gaze.size(), 5u);
  expect_same_map_again(map);
  // Each alternative differs from the others, so that none is written as another.
  for (std::size_t i = 0; i < map.head.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(map.head[i] == map.head[j]) << i << " " << j;
}

void collect_keys(const nlohmann::json& value, std::set<std::string>& keys) {
  for (const auto& item : value.items()) {
    if (value.is_object()) keys.insert(item.key());
    if (item.value().is_structured()) collect_keys(item.value(), keys);
  }
}

TEST(ColumnMapText, LeavesNoKeyOut) {
  std::set<std::string> given, written;
  collect_keys(nlohmann::json::parse(kEveryKey), given);
  collect_keys(nlohmann::json::parse(column_map_text(parse_column_map(kEveryKey, "every.json"))), written);
  EXPECT_EQ(written, given);
}

TEST(ColumnMapText, IsLaidOutForPeople) {
  const std::string json = head_map(R"("separator": "tab", )" + kHeadTime + ", " + kHeadPlace + ", " +
                                    kHeadTurn + ", " + kHeadAxes);
  EXPECT_EQ(column_map_text(parse_column_map(json, "lab.json")), R"({
  "format_version": 1,
  "name": "lab",
  "head": [
    {
      "separator": "tab",
      "time": {"column": "t", "unit": "ms"},
      "position": {"columns": ["x", "y", "z"], "unit": "mm"},
      "orientation": {"quaternion_xyzw": "q"},
      "world_axes": ["right", "up", "back"],
      "head_axes": ["right", "up", "back"],
      "handedness": "right"
    }
  ]
}
)");
}

TEST(ColumnMapText, KeepsEveryDigitOfAnOffset) {
  ColumnMap map = parse_column_map(head_map(kHeadTime + ", " + kHeadTurn + ", " + kHeadAxes), "lab.json");
  for (const TimeNs offset : {TimeNs{1}, TimeNs{-1}, TimeNs{-250'000'000}, TimeNs{1'700'000'000'123'456'789},
                              TimeNs{4'000'000'000'000'000'000}, TimeNs{-3'999'999'999'999'999'999}}) {
    map.head[0].time.offset_ns = offset;
    EXPECT_EQ(parse_column_map(column_map_text(map), "lab.json").head[0].time.offset_ns, offset);
  }
}

TEST(ColumnMapText, WithBytesThatAreNoTextIsStillJson) {
  ColumnMap map = parse_column_map(head_map(kHeadTime + ", " + kHeadTurn + ", " + kHeadAxes), "lab.json");
  map.head[0].time.column.name = "Zeit \xb5s";
  EXPECT_EQ(parse_column_map(column_map_text(map), "lab.json").head[0].time.column.name,
            "Zeit \xef\xbf\xbds");
}

}  // namespace
}  // namespace herr::test
