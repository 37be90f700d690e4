#include "sessions/import/import_rows.h"

#include <array>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/tables/foreign_table.h"
#include "sessions/import/rows/row_readers.h"

namespace herr {
namespace {

constexpr std::size_t kMostWarnings = 100;

// The first alternative whose columns are all in the file. Throws what the first one lacks.
template <typename Columns>
const Columns& fitting(const std::filesystem::path& file, const std::vector<Columns>& alternatives) {
  for (const Columns& columns : alternatives) {
    const ForeignTable table(file, columns.table);
    bool all = true;
    for (const ColumnRef& column : columns_of(columns)) all = all && table.has(column);
    if (all) return columns;
  }
  const ForeignTable table(file, alternatives.back().table);
  for (const ColumnRef& column : columns_of(alternatives.back())) (void)table.place(column);
  throw InputError(file, 0, "does not fit the map", "check the preset");
}

// Counts, orders and hands on the rows of one stream.
class StreamImport {
 public:
  StreamImport(ForeignTable& table, const TimeColumn& time, const ImportRequest& request,
               ImportedStream& stream, std::vector<std::string>& warnings)
      : table_(table),
        time_place_(table.place(time.column)),
        unit_(time.unit),
        keep_going_(request.keep_going),
        stream_(stream),
        warnings_(warnings) {
    stream_.file = table.path();
  }

  // Calls take(stamp) for each row in order of time; it returns whether it wrote the row.
  template <typename Take>
  void run(const Take& take) {
    while (next_row()) {
      try {
        one_row(take);
      } catch (const InputError& error) {
        skip(error);
      }
    }
    stream_.blank_lines = table_.blank_lines();
    if (!table_.cut_off().empty())
      warn(InputError(table_.path(), table_.line(),
                      "the file ends within this line; '" + printable(table_.cut_off()) + "' was left out",
                      "end the last line if it is whole")
               .what());
    if (stream_.rows == 0) throw InputError(table_.path(), 0, "has no usable rows", "check the map");
  }

 private:
  bool next_row() {
    for (;;) {
      try {
        return table_.next();
      } catch (const InputError& error) {
        skip(error);
      }
    }
  }

  template <typename Take>
  void one_row(const Take& take) {
    const auto stamp = parse_stamp(table_.text(time_place_), unit_);
    if (!stamp)
      table_.fail_field(
          time_place_,
          "is '" + printable(std::string(table_.text(time_place_))) + "', no time stamp in range",
          "check the time unit of the map, or remove the line");
    if (stream_.rows > 0 && *stamp <= stream_.last_ns) {
      const bool repeats = *stamp == stream_.last_ns;
      ++(repeats ? stream_.repeated_stamps : stream_.backward_stamps);
      warn(InputError(table_.path(), table_.line(),
                      repeats ? "the time stamp repeats the one before" : "the time stamp goes backwards",
                      "the row was left out")
               .what());
      return;
    }
    if (!take(*stamp)) return;
    if (stream_.rows > 0)
      stream_.intervals.count(*stamp - stream_.last_ns, table_.line());
    else
      stream_.first_ns = *stamp;
    stream_.last_ns = *stamp;
    ++stream_.rows;
  }

  void skip(const InputError& error) {
    if (!keep_going_) throw error;
    ++stream_.bad_rows;
    warn(std::string(error.what()) + " (left out)");
  }

  void warn(const std::string& text) {
    if (warnings_.size() < kMostWarnings) warnings_.push_back(text);
    if (warnings_.size() == kMostWarnings) warnings_.push_back("further warnings are only counted");
  }

  ForeignTable& table_;
  std::size_t time_place_;
  TimeUnit unit_;
  bool keep_going_;
  ImportedStream& stream_;
  std::vector<std::string>& warnings_;
};

void import_poses(const ImportRequest& request, const ImportSink& sink, ImportReport& report) {
  const HeadColumns& columns = fitting(request.head_file, request.map->head);
  ForeignTable table(request.head_file, columns.table);
  const HeadReader reader(table, columns);
  std::optional<Pose> before;
  StreamImport(table, columns.time, request, report.poses, report.warnings).run([&](TimeNs stamp_ns) {
    const auto pose = reader.read(table, report.poses);
    if (!pose) {
      ++report.poses.lost_rows;
      return false;
    }
    const bool same =
        before && before->position == pose->position && before->orientation == pose->orientation;
    report.poses.repeated_values += same ? 1 : 0;
    before = pose;
    sink.pose({stamp_ns, *pose});
    return true;
  });
}

// The gaze of one row. Rays are read where a pupil was seen; elsewhere trackers write anything.
void read_rays(const ForeignTable& table, const std::vector<RayReader>& readers,
               const std::vector<FilterReader>& pupils, const AxisDirections& axes, GazeRow& row,
               ImportedStream& stream) {
  std::array<bool, 2> seen{true, true};
  for (std::size_t eye = 0; eye < pupils.size(); ++eye) seen[eye] = pupils[eye].passes(table);
  if (!seen[0] && !seen[1]) return;
  for (std::size_t eye = 0; eye < readers.size(); ++eye) {
    const auto direction = readers[eye].read(table, stream);
    row.valid[eye] = direction.has_value();
    if (direction) row.head_direction[eye] = axes.to_ours(*direction);
  }
  if (readers.size() > 1) return;
  row.head_direction[1] = row.head_direction[0];
  row.valid = {row.valid[0] && seen[0], row.valid[0] && seen[1]};
}

void import_gaze(const ImportRequest& request, const std::filesystem::path& file, const GazeColumns& columns,
                 const ImportSink& sink, ImportReport& report) {
  ForeignTable table(file, columns.table);
  std::vector<RayReader> readers;
  for (const DirectionColumns& ray : columns.rays) readers.emplace_back(table, ray);
  std::vector<FilterReader> pupils;
  for (const RowFilter& pupil : columns.pupils) pupils.emplace_back(table, pupil);
  report.has_gaze = true;
  report.gaze_combined = readers.size() == 1;
  std::optional<GazeRow> before;
  StreamImport(table, columns.time, request, report.gaze, report.warnings).run([&](TimeNs stamp_ns) {
    GazeRow row;
    row.stamp_ns = stamp_ns;
    read_rays(table, readers, pupils, columns.axes, row, report.gaze);
    report.gaze.lost_rows += !row.valid[0] && !row.valid[1] ? 1 : 0;
    report.gaze.one_eye_rows += row.valid[0] != row.valid[1] ? 1 : 0;
    const bool same = before && row.valid == before->valid && (row.valid[0] || row.valid[1]) &&
                      row.head_direction == before->head_direction;
    report.gaze.repeated_values += same ? 1 : 0;
    before = row;
    sink.gaze(row);
    return true;
  });
}

}  // namespace

const HeadColumns& fitting_head_columns(const ImportRequest& request) {
  return fitting(request.head_file, request.map->head);
}

ImportReport import_rows(const ImportRequest& request, const ImportSink& sink) {
  ImportReport report;
  import_poses(request, sink, report);
  std::vector<GazeColumns> usable;
  for (const GazeColumns& columns : request.map->gaze)
    if (columns.in_head_file || request.gaze_file) usable.push_back(columns);
  if (request.gaze_file && usable.empty())
    throw InputError(*request.gaze_file, 0, "cannot be read: map '" + request.map->name + "' has no gaze",
                     "leave --gaze out, or write a map that has one");
  if (usable.empty()) return report;
  const std::filesystem::path& file = request.gaze_file ? *request.gaze_file : request.head_file;
  const GazeColumns chosen = fitting(file, usable);
  import_gaze(request, file, chosen, sink, report);
  return report;
}

}  // namespace herr
