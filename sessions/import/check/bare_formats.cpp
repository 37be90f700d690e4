#include "sessions/import/check/bare_formats.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "sessions/import/check/axis_trials.h"
#include "sessions/import/check/column_names.h"
#include "sessions/import/check/sniffed_table.h"
#include "sessions/import/map/map_words.h"
#include "sessions/import/presets/recording_folder.h"
#include "sessions/import/rows/head_reader.h"

namespace herr {
namespace {

constexpr std::size_t kTooManyByAccident = 100;  // columns

bool is_tum(const ChosenFormat& chosen) {
  return chosen.format.preset == "tum";
}

// "timestamp tx ty tz qx qy qz qw", as tools for TUM trajectories write it.
bool has_tum_names(const SniffedTable& table) {
  constexpr std::array<std::string_view, 7> kNames{"tx", "ty", "tz", "qx", "qy", "qz", "qw"};
  return table.names.size() == kNames.size() + 1 &&
         std::equal(kNames.begin(), kNames.end(), table.names.begin() + 1);
}

std::size_t widest_column(const HeadColumns& head) {
  std::size_t widest = 0;
  for (const ColumnRef& column : columns_of(head)) widest = std::max(widest, column.number);
  return widest;
}

// The names call the quaternion's numbers what the format takes them for.
bool names_agree(const SniffedTable& table, const HeadColumns& head) {
  for (const LetterGroup& group : letter_groups(table)) {
    if (!group.w) continue;
    std::vector<std::size_t> columns = group.columns();
    columns.insert(head.rotation_kind == RotationKind::quaternion_wxyz ? columns.begin() : columns.end(),
                   *group.w);
    return std::equal(columns.begin(), columns.end(), head.rotation.columns.begin(),
                      head.rotation.columns.end(),
                      [](std::size_t column, const ColumnRef& ref) { return column + 1 == ref.number; });
  }
  return false;
}

}  // namespace

bool is_its_own_file(const ChosenFormat& chosen, const FormatRequest& request) {
  const HeadColumns* head = chosen.format.columns.head;
  if (chosen.format.named_columns > 0 || head == nullptr) return true;
  const auto table = sniff_table(request.files.head);
  if (!table) return true;
  if (named_in_layouts(request.files.head, *chosen.format.map) || table->columns() > kTooManyByAccident)
    return true;
  const bool same_width = table->columns() == widest_column(*head);
  const bool parted_by_blanks = table->format.separator == ' ' || table->format.separator == '\t';
  if (is_tum(chosen))
    return same_width && (has_tum_names(*table) ||
                          (!table->format.header && (parted_by_blanks || !table->format.comment.empty())));
  if (is_matrix(head->rotation_kind)) return same_width && table->names.empty();
  return names_agree(*table, *head);
}

std::optional<std::string> open_axes(const ChosenFormat& chosen, const FormatRequest& request) {
  if (!is_tum(chosen)) return std::nullopt;
  using Axes = AxisConvention;
  AxisReading reading;
  reading.map = *chosen.format.map;
  reading.map.head = {*chosen.format.columns.head};
  reading.conventions = {Axes::openxr, Axes::ros, Axes::camera_z_up, Axes::camera_y_up, Axes::camera_y_down};
  const AxisVerdict verdict = settle_axes(request.files, {reading});
  if (verdict.map && verdict.map->head.front().head_axes == chosen.format.columns.head->head_axes)
    return std::nullopt;
  return "Which way the axes point: a TUM trajectory does not say, and its data fit several (--variant, or a "
         "map "
         "with \"world_axes\" and \"head_axes\").";
}

}  // namespace herr
