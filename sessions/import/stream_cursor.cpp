#include "sessions/import/stream_cursor.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace herr {
namespace {

constexpr std::size_t kMostWarnings = 100;

// "Z", "+08", "+0800" or "+08:00" at the end.
bool ends_with_zone(std::string_view text) {
  if (text.ends_with('Z') || text.ends_with('z')) return true;
  const std::size_t sign = text.find_last_of("+-");
  const std::size_t time = text.find(':');
  return sign != std::string_view::npos && time != std::string_view::npos && sign > time;
}

}  // namespace

bool assumes_utc(const StreamFile& file) {
  const TimeColumns& time = *file.time;
  if (time.kind != TimeColumns::Kind::date || time.zone_minutes) return false;
  if (!time.date_format.empty()) return time.date_format.find("%z") == std::string::npos;
  const std::unique_ptr<RowSource> rows = open_rows(file.path, *file.table, file.wanted);
  const std::size_t place = rows->place(time.column);
  try {
    return rows->next() && !ends_with_zone(rows->text(place));
  } catch (const InputError&) {
    return true;
  }
}

void Warnings::add(const InputError& error, const std::string& then) {
  if (texts_.size() >= kMostWarnings) return;
  std::string text = error.what() + then;
  // Poses and gaze of one file meet the same line.
  if (std::find(texts_.begin(), texts_.end(), text) != texts_.end()) return;
  texts_.push_back(std::move(text));
  if (texts_.size() == kMostWarnings - 1) texts_.push_back("further warnings are only counted");
}

StampSurvey survey_file(const StreamFile& file, const ImportRequest& request) {
  const std::unique_ptr<RowSource> rows = open_rows(file.path, *file.table, file.wanted);
  TimeReader time(*rows, *file.time);
  StampSurvey survey = survey_stamps(*rows, time, request.sort_rows, request.most_rows);
  if (survey.all_equal)
    throw InputError(file.path, 0,
                     "all " + std::to_string(survey.rows) + " stamps are equal: written in single precision?",
                     "let the logger write time with more digits, or take another column as time");
  return survey;
}

StreamCursor::StreamCursor(const StreamFile& file, const StampSurvey& survey, TimeNs shift_ns,
                           bool keep_going, ImportedStream& stream, Warnings& warnings)
    : survey_(survey),
      shift_ns_(shift_ns),
      keep_going_(keep_going),
      stream_(stream),
      warnings_(warnings),
      rows_(open_rows(file.path, *file.table, file.wanted)),
      time_(*rows_, *file.time) {
  stream_.file = file.path;
}

bool StreamCursor::next() {
  while (!ended_) {
    try {
      if (!rows_->next()) break;
      ++stream_.rows_read;
      place_.move_to(rows_->line());
      if (const RowFate* left_out = fate()) {
        leave_out(*left_out, place_.line);
        continue;
      }
      stamp_ns_ = time_.read(*rows_) + shift_ns_;
      return true;
    } catch (const InputError& error) {
      if (place_.line != rows_->line()) {  // a row that is not whole
        place_.move_to(rows_->line());
        ++stream_.rows_read;
      }
      bad(error);
    }
  }
  ended_ = true;
  return false;
}

const RowFate* StreamCursor::fate() {
  const std::vector<LeftOutRows>& left_out = survey_.left_out;
  while (next_left_out_ < left_out.size() && left_out[next_left_out_].last < place_) ++next_left_out_;
  if (next_left_out_ == left_out.size() || place_ < left_out[next_left_out_].first) return nullptr;
  return &left_out[next_left_out_].fate;
}

void StreamCursor::leave_out(RowFate fate, std::int64_t line) {
  stream_.fates.count(fate, line);
}

void StreamCursor::bad(const InputError& error) {
  if (!keep_going_) {
    if (stream_.rows == 0) throw error;  // they may all be so
    throw InputError(error.file(), error.line(), error.problem(),
                     error.remedy() + ", or leave out such rows with --keep-going");
  }
  stream_.fates.count(RowFate::bad, error.line());
  warnings_.add(error, " (left out)");
}

void StreamCursor::finish() {
  stream_.source = rows_->counts();
  if (!rows_->cut_off().empty())
    warnings_.add(
        InputError(rows_->path(), rows_->line(),
                   "the file ends within this line; '" + printable(rows_->cut_off()) + "' was left out",
                   "end the last line if it is whole"),
        "");
  if (stream_.rows > 0) return;
  if (stream_.rows_read == 0)
    throw InputError(rows_->path(), 0, "holds no rows", "check that the recording was written to its end");
  const std::string all = std::to_string(stream_.rows_read);
  if (stream_.fates[RowFate::lost_tracking] == stream_.rows_read)
    throw InputError(rows_->path(), 0, "has no usable row: tracking was lost in all " + all + " rows",
                     "check 'valid' of the map");
  throw InputError(rows_->path(), 0, "has no usable row among " + all, "check the columns of the map");
}

}  // namespace herr
