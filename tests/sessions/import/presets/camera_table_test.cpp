// Which columns a table of camera stamps is read with, where the recording's format has none that fit.
#include "sessions/import/presets/camera_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/presets/built_in_maps.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

CameraTableColumns columns_of(const std::string& table, const ColumnMap& map = {}) {
  const test::RecordedFolder folder;
  folder.write("table.csv", table);
  return camera_columns_of(folder / "table.csv", map);
}

TEST(CameraTable, TablesOfKnownProgramsAreRecognised) {
  struct Case {
    std::string table, preset;
    TimeUnit unit;
    bool names_pictures;
  };
  const std::vector<Case> cases{
      {"#timestamp [ns],filename\n1403636579763555584,1403636579763555584.png\n", "euroc", TimeUnit::ns,
       true},
      {"1403636579763555584,1403636579763555584.png\n", "euroc", TimeUnit::ns, true},
      {"timestamp_ns,filename\n1403636579763555584,000000.png\n", "euroc", TimeUnit::ns, true},
      {"# color images\n# timestamp filename\n1305031102.175304 rgb/1305031102.175304.png\n", "tum",
       TimeUnit::s, true},
      {"section id,recording id,timestamp [ns]\nx,y,1705064123000000000\n", "neon", TimeUnit::ns, false},
  };
  for (const Case& each : cases) {
    const CameraTableColumns found = columns_of(each.table);
    EXPECT_EQ(found.preset, each.preset) << each.table;
    EXPECT_EQ(found.columns.time.unit, each.unit) << each.table;
    EXPECT_EQ(found.columns.file.has_value(), each.names_pictures) << each.table;
  }
}

TEST(CameraTable, TheFormatsOwnColumnsComeFirst) {
  ColumnMap map;
  CameraColumns own;
  own.time.column = {"timestamp_ns", 0};
  own.time.unit = TimeUnit::us;
  map.camera = {own};
  const CameraTableColumns found = columns_of("timestamp_ns,filename\n1,a.png\n", map);
  EXPECT_EQ(found.preset, "");
  EXPECT_EQ(found.columns.time.unit, TimeUnit::us);
}

// A lens of which one column is missing belongs to another version of the program.
TEST(CameraTable, AlternativesWithALensNeedAllItsColumns) {
  const std::vector<BuiltInMap>& maps = built_in_maps();
  const auto stray = std::find_if(maps.begin(), maps.end(),
                                  [](const BuiltInMap& one) { return one.name == "stray-scanner"; });
  ASSERT_NE(stray, maps.end());
  const ColumnMap map = parse_column_map(stray->json, "stray-scanner.json");
  EXPECT_EQ(
      columns_of("timestamp, frame, fx, fy, cx, cy\n1.5, 000000, 2, 2, 2, 2\n", map).columns.lens.size(), 4u);
  EXPECT_EQ(columns_of("timestamp, frame, fx, fy, cx\n1.5, 000000, 2, 2, 2\n", map).columns.lens.size(), 0u);
}

TEST(CameraTable, AnUnknownTableIsRefusedWithWhatIsKnown) {
  EXPECT_INPUT_ERROR(columns_of("when,what\nnoon,a.png\n"), "has the columns of no table of camera stamps");
}

}  // namespace
}  // namespace herr
