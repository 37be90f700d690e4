#include "sessions/import/stream_cursor.h"

#include <algorithm>
#include <utility>

#include "sessions/import/text/date_text.h"

namespace herr {
namespace {

constexpr std::size_t kMostWarnings = 100;
constexpr int kRowsForAZone = 100;

}  // namespace

bool assumes_utc(const StreamFile& file) {
  const TimeColumns& time = *file.time;
  if (time.kind != TimeColumns::Kind::date || time.zone_minutes || period_of(time) > 0) return false;
  const std::unique_ptr<RowSource> rows = open_rows(file.path, *file.table, file.wanted);
  const std::size_t place = rows->place(time.column);
  for (int row = 0; row < kRowsForAZone; ++row) {
    try {
      if (!rows->next()) break;
      if (parse_date(rows->text(place), time.date_format, {}))
        return !date_names_zone(rows->text(place), time.date_format);
    } catch (const InputError&) {
      continue;
    }
  }
  return true;
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
      shift_ns_(shift_ns + file.later_ns),
      keep_going_(keep_going),
      stream_(stream),
      warnings_(warnings),
      rows_(open_rows(file.path, *file.table, file.wanted)),
      time_(*rows_, *file.time) {
  stream_.file = file.path;
}

bool StreamCursor::next() {
  while (!ended_) {
    bool whole = false;
    try {
      if (!rows_->next()) break;
      whole = true;
      ++stream_.rows_read;
      place_.move_to(rows_->line());
      if (const RowFate* left_out = fate()) {
        leave_out(*left_out, place_.line);
        pass_over();
        continue;
      }
      stamp_ns_ = time_.read(*rows_) + shift_ns_;
      return true;
    } catch (const InputError& error) {
      if (!whole) {
        place_.move_to(rows_->line());
        time_.pass_over();
        ++stream_.rows_read;
      }
      bad(error);
    }
  }
  ended_ = true;
  return false;
}

// The stamp of a row that is left out counts for those behind it, as in the survey.
void StreamCursor::pass_over() {
  try {
    (void)time_.read(*rows_);
  } catch (const InputError&) {
    return;
  }
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
