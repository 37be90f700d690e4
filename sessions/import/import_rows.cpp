#include "sessions/import/import_rows.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/format/session_header.h"
#include "sessions/import/head_at.h"
#include "sessions/import/ordered_rows.h"
#include "sessions/import/row_watches.h"
#include "sessions/import/rows/gaze_reader.h"
#include "sessions/import/rows/head_reader.h"
#include "sessions/import/stream_cursor.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr glm::dvec3 kAhead(0, 0, -1);
constexpr TimeNs kSecondNs = 1'000'000'000;

class RowsImport {
 public:
  RowsImport(const ImportRequest& request, const ImportSink& sink) : request_(request), sink_(sink) {
    report_.gaze.lost_rows_stay = true;
  }

  ImportReport run() {
    find_streams();
    survey();
    if (has_head())
      import_poses();
    else
      stand_still();
    if (has_gaze())
      import_gaze();
    else if (request_.still.gaze)
      look_ahead();
    return std::move(report_);
  }

 private:
  bool has_head() const { return head_.table != nullptr; }
  bool has_gaze() const { return gaze_.table != nullptr; }

  void find_streams() {
    const auto [head, gaze] = request_.columns;
    if (head != nullptr && !request_.still.head)
      head_ = {request_.head_file, &head->table, &head->time, columns_of(*head)};
    if (gaze != nullptr && !request_.still.gaze)
      gaze_ = {request_.gaze_file.value_or(request_.head_file), &gaze->table, &gaze->time, columns_of(*gaze)};
    if (!has_head() && !has_gaze())
      throw InputError(request_.head_file, 0, "holds neither poses of the head nor gaze by this map",
                       "check the map");
    one_table_ = has_head() && has_gaze() && gaze_.path == head_.path && head->time == gaze->time;
    if (one_table_ && gaze->space == GazeSpace::world)
      gaze_.wanted.insert(gaze_.wanted.end(), head_.wanted.begin(), head_.wanted.end());
  }

  void survey() {
    if (has_head()) head_survey_ = survey_file(head_, request_);
    if (has_gaze()) gaze_survey_ = one_table_ ? head_survey_ : survey_file(gaze_, request_);
    carry_days();
    TimeNs lowest_ns = 0, last_ns = 0;
    for (const StampSurvey* survey : {&head_survey_, &gaze_survey_}) {
      lowest_ns = std::min(lowest_ns, survey->lowest_ns);
      last_ns = std::max(last_ns, survey->last_ns);
    }
    report_.poses.remarks = head_survey_.remarks;
    report_.gaze.remarks = gaze_survey_.remarks;
    for (const StreamFile* stream : {&head_, &gaze_})
      if (stream->time != nullptr && stream->time->kind == TimeColumns::Kind::rate)
        report_.assumed.push_back("stamps were not recorded: " + plain_number_text(stream->time->rate_hz) +
                                  " rows a second");
    if ((has_head() && assumes_utc(head_)) || (has_gaze() && assumes_utc(gaze_)))
      report_.assumed.push_back("dates name no zone: they were taken as UTC");
    if (has_head() && request_.columns.head->rotation_kind == RotationKind::fixed)
      report_.assumed.push_back(
          request_.columns.head->position
              ? "the head does not turn: its orientation was not recorded"
              : "the head stands still at the origin, level: its pose was not recorded");
    if (lowest_ns == 0) return;
    const TimeNs seconds = (-lowest_ns + kSecondNs - 1) / kSecondNs;
    report_.shift_ns = seconds * kSecondNs;
    if (last_ns > kLastStampNs - report_.shift_ns)
      throw InputError(has_head() ? head_.path : gaze_.path, 0,
                       "stamps reach from " + std::to_string(lowest_ns) + " to " + std::to_string(last_ns) +
                           " ns: more than a session can hold",
                       "check the time unit of the map");
    report_.assumed.push_back("stamps are negative: " + std::to_string(seconds) +
                              " s was added to every stamp");
  }

  // Of stamps that name no day, those of one file may begin before midnight and those of the other behind it.
  void carry_days() {
    for (const auto& [file, survey] : {std::pair(&head_, &head_survey_), std::pair(&gaze_, &gaze_survey_)})
      if (survey->carried_line > 0 && !(one_table_ && file == &gaze_))
        report_.assumed.push_back("stamps name no " + period_word(*file) + ": from line " +
                                  std::to_string(survey->carried_line) +
                                  " on, where they start again, they are those of the next");
    if (!has_head() || !has_gaze() || one_table_) return;
    const TimeNs period_ns = period_of(*head_.time), ahead_ns = gaze_survey_.first_ns - head_survey_.first_ns;
    if (period_ns == 0 || period_ns != period_of(*gaze_.time) || std::abs(ahead_ns) <= period_ns / 2) return;
    StreamFile& late = ahead_ns > 0 ? head_ : gaze_;
    StampSurvey& survey = ahead_ns > 0 ? head_survey_ : gaze_survey_;
    late.later_ns = period_ns;
    for (TimeNs* stamp : {&survey.first_ns, &survey.last_ns, &survey.lowest_ns}) *stamp += period_ns;
    report_.assumed.push_back("stamps name no " + period_word(late) + ": the " +
                              (ahead_ns > 0 ? "poses begin" : "gaze begins") + " in the next one");
  }

  static std::string period_word(const StreamFile& file) {
    const TimeNs minutes = period_of(*file.time) / (60 * kSecondNs);
    return minutes > 60 ? "day" : minutes > 1 ? "hour" : "minute";
  }

  // Calls take(row) for each pose of the file.
  template <typename Take>
  void each_pose(ImportedStream& stream, Warnings& warnings, const Take& take) {
    const HeadColumns& columns = *request_.columns.head;
    StreamCursor cursor(head_, head_survey_, report_.shift_ns, request_.keep_going, stream, warnings);
    const HeadReader reader(cursor.rows(), columns);
    IdWatch ids(cursor.rows(), columns.part);
    GravityWatch gravity;
    OrderedRows<PoseRow> rows(cursor, request_.sort_rows, request_.most_rows);
    const auto read = [&](PoseRow& row) {
      const auto pose = reader.read(cursor.rows(), stream.reading);
      if (!pose) {
        if (stream.fates[RowFate::lost_tracking] == 0)
          stream.first_absent = reader.absent_column(cursor.rows());
        cursor.leave_out(RowFate::lost_tracking, cursor.line());
        return false;
      }
      row.world_from_head = *pose;
      ids.see(cursor.rows());
      if (columns.gravity) gravity.see(reader.gravity(cursor.rows()));
      return true;
    };
    for (PoseRow row; rows.next(row, read);) take(row);
    cursor.finish();
    gravity.finish(head_.path, columns.world_axes);
    if (&stream == &report_.poses) ids.finish(report_.remarks);
  }

  void import_poses() {
    Pose before;
    ImportedStream& stream = report_.poses;
    const bool recorded = request_.columns.head->rotation_kind != RotationKind::fixed;
    each_pose(stream, warnings_, [&](const PoseRow& row) {
      const Pose& pose = row.world_from_head;
      const bool same = before.position == pose.position && before.orientation == pose.orientation;
      stream.repeated_values += same && recorded && stream.rows > 1 ? 1 : 0;
      before = pose;
      sink_.pose(row);
    });
  }

  // Calls take(row) for each row of gaze.
  template <typename Take>
  void each_gaze(ImportedStream& stream, Warnings& warnings, const Take& take) {
    const GazeColumns& columns = *request_.columns.gaze;
    StreamCursor cursor(gaze_, gaze_survey_, report_.shift_ns, request_.keep_going, stream, warnings);
    const GazeReader reader(cursor.rows(), columns);
    std::optional<HeadReader> row_head;
    std::optional<HeadAt> head_at;
    if (reader.needs_head() && one_table_)
      row_head.emplace(cursor.rows(), *request_.columns.head);
    else if (reader.needs_head() && has_head())
      head_at.emplace(head_, *request_.columns.head, head_survey_, report_.shift_ns, request_.sort_rows);
    const std::array<glm::dvec3, 2> eyes = reader.combined() ? std::array<glm::dvec3, 2>{} : request_.eyes;
    ConfidenceWatch confidence;
    ReadingCounts of_head;  // counted with the poses
    OrderedRows<GazeRow> rows(cursor, request_.sort_rows, request_.most_rows);
    const auto read = [&](GazeRow& row) {
      std::optional<Pose> head;
      if (row_head)
        head = row_head->read(cursor.rows(), of_head);
      else if (head_at)
        head = (*head_at)(row.stamp_ns);
      else
        head.emplace();
      reader.read(cursor.rows(), head ? &*head : nullptr, eyes, row, stream.reading);
      if (!row.valid[0] && !row.valid[1]) stream.fates.count(RowFate::lost_tracking, cursor.line());
      confidence.see(reader, cursor.rows(), row);
      return true;
    };
    for (GazeRow row; rows.next(row, read);) take(row);
    cursor.finish();
    if (&stream != &report_.gaze) return;
    report_.has_gaze = true;
    report_.gaze_combined = reader.combined();
    confidence.finish(report_.remarks);
  }

  void import_gaze() {
    GazeRow before;
    ImportedStream& stream = report_.gaze;
    each_gaze(stream, warnings_, [&](const GazeRow& row) {
      stream.one_eye_rows += row.valid[0] != row.valid[1] ? 1 : 0;
      const bool same = row.valid == before.valid && (row.valid[0] || row.valid[1]) &&
                        row.head_direction == before.head_direction;
      stream.repeated_values += same && stream.rows > 1 ? 1 : 0;
      before = row;
      sink_.gaze(row);
    });
  }

  // Poses at the gaze's stamps: the gaze is read twice, so that poses come first.
  void stand_still() {
    report_.assumed.push_back(
        "the head stands still at the origin, level, whatever was recorded: so it was asked for");
    ImportedStream pass;
    std::vector<std::string> texts;
    Warnings warnings(texts);
    each_gaze(pass, warnings, [&](const GazeRow& row) {
      count(row.stamp_ns, report_.poses);
      sink_.pose({row.stamp_ns, {}});
    });
  }

  void look_ahead() {
    report_.assumed.push_back("the gaze looks straight ahead, whatever was recorded: so it was asked for");
    ImportedStream pass;
    std::vector<std::string> texts;
    Warnings warnings(texts);
    each_pose(pass, warnings, [&](const PoseRow& row) {
      count(row.stamp_ns, report_.gaze);
      sink_.gaze({row.stamp_ns, {kAhead, kAhead}, {true, true}});
    });
    report_.has_gaze = report_.gaze_combined = true;
  }

  // A row that no file holds.
  static void count(TimeNs stamp_ns, ImportedStream& stream) {
    if (stream.rows == 0)
      stream.first_ns = stamp_ns;
    else
      stream.intervals.count(stamp_ns - stream.last_ns, 0);
    stream.last_ns = stamp_ns;
    ++stream.rows;
    ++stream.rows_read;
  }

  const ImportRequest& request_;
  const ImportSink& sink_;
  ImportReport report_;
  Warnings warnings_{report_.warnings};
  StreamFile head_, gaze_;  // no table: not read
  StampSurvey head_survey_, gaze_survey_;
  bool one_table_ = false;  // each row holds a pose and its gaze
};

}  // namespace

ImportReport import_rows(const ImportRequest& request, const ImportSink& sink) {
  return RowsImport(request, sink).run();
}

}  // namespace herr
