#include "sessions/import/cameras/column_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sessions/files/input_error.h"
#include "sessions/import/middle_value.h"
#include "sessions/import/rows/filter_reader.h"
#include "sessions/import/tables/row_source.h"

namespace herr {
namespace {

constexpr double kChangeWorthSaying = 0.01;
constexpr double kFarthestFromMiddle = 0.2;  // of the picture's width or height
constexpr std::size_t kMostLensRows = 1'000'000;
constexpr std::array<const char*, 4> kLensNames{"fx", "fy", "cx", "cy"};

std::array<std::vector<double>, 4> read_lens_rows(const std::filesystem::path& table,
                                                  const CameraColumns& columns) {
  std::vector<ColumnRef> wanted = columns.lens;
  add_columns(columns.valid, wanted);
  const std::unique_ptr<RowSource> rows = open_rows(table, columns.table, wanted);
  const FilterReader valid(*rows, columns.valid);
  std::array<std::size_t, 4> places{};
  for (std::size_t i = 0; i < 4; ++i) places[i] = rows->place(columns.lens[i]);
  std::array<std::vector<double>, 4> values;
  while (rows->next() && values[0].size() < kMostLensRows) {
    const bool whole =
        std::none_of(places.begin(), places.end(), [&](std::size_t place) { return rows->absent(place); });
    if (!whole || !valid.passes(*rows)) continue;
    for (std::size_t i = 0; i < 4; ++i) values[i].push_back(rows->number(places[i]));
  }
  if (values[0].empty())
    throw InputError(table, 0, "has no row with a lens (fx, fy, cx, cy)",
                     "give --camera-calibration or --camera-hfov");
  return values;
}

// The principal point is in pixels, so its changes count against the focal length.
std::string lens_change(const std::array<std::vector<double>, 4>& values, const std::array<double, 4>& lens) {
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [low, high] = std::minmax_element(values[i].begin(), values[i].end());
    const double share = (*high - *low) / lens[i % 2];
    if (share > kChangeWorthSaying)
      return std::string("the lens changes during the recording (") + kLensNames[i] + " by " +
             std::to_string(std::lround(share * 100)) +
             " % of the focal length, as with autofocus); one lens, the median, stands for all pictures";
  }
  return {};
}

}  // namespace

ColumnLens lens_from_columns(const std::filesystem::path& table, const CameraColumns& columns,
                             const ImageSize& size) {
  const std::array<std::vector<double>, 4> values = read_lens_rows(table, columns);
  std::array<double, 4> lens{};
  std::transform(values.begin(), values.end(), lens.begin(), middle_value<double>);
  const double off_x = std::abs(lens[2] - 0.5 * (size.width_px - 1)) / size.width_px;
  const double off_y = std::abs(lens[3] - 0.5 * (size.height_px - 1)) / size.height_px;
  if (!(lens[0] >= 1 && lens[1] >= 1))
    throw InputError(table, 0, "has a lens with a focal length below a pixel", "check the columns fx and fy");
  if (!(off_x <= kFarthestFromMiddle && off_y <= kFarthestFromMiddle))
    throw InputError(table, 0,
                     "has a lens whose middle is at (" + std::to_string(std::lround(lens[2])) + ", " +
                         std::to_string(std::lround(lens[3])) + "), and the pictures are " +
                         std::to_string(size.width_px) + "x" + std::to_string(size.height_px),
                     "use the pictures in the size in which they were recorded, and not turned");
  ColumnLens found;
  found.model.width_px = size.width_px;
  found.model.height_px = size.height_px;
  found.model.fx = lens[0];
  found.model.fy = lens[1];
  found.model.cx = lens[2];
  found.model.cy = lens[3];
  found.model.prepare();
  if (std::string change = lens_change(values, lens); !change.empty())
    found.remarks.push_back(std::move(change));
  return found;
}

}  // namespace herr
