// The rows of a stream in order of time: each newer than the one before. Rows that are not are left out, or,
// with a window, put where they belong. Before: stream_cursor. After: import_rows hands them on. Memory: the
// window.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/stream_cursor.h"

namespace herr {

// Row: a struct with `stamp_ns`.
template <typename Row>
class OrderedRows {
 public:
  // `cursor` must outlive it. `sort_rows`: the window; `most_rows`: after so many the end is reached, 0: all.
  OrderedRows(StreamCursor& cursor, std::size_t sort_rows, std::int64_t most_rows)
      : cursor_(cursor), sort_rows_(sort_rows), most_rows_(most_rows) {
    waiting_.reserve(std::min<std::size_t>(sort_rows, 4096) + 1);
  }

  // The next row; false at the end. read(row) fills in all but the stamp from the cursor's row; it returns
  // false where the row is left out, and may throw InputError.
  template <typename Read>
  bool next(Row& row, const Read& read) {
    if (most_rows_ > 0 && written_ >= most_rows_) return false;
    return sort_rows_ == 0 ? next_in_file(row, read) : next_sorted(row, read);
  }

 private:
  struct Waiting {
    Row row;
    std::int64_t line = 0, number = 0;
    bool late = false;

    // Heaps keep the largest in front.
    bool operator<(const Waiting& other) const {
      if (row.stamp_ns != other.row.stamp_ns) return row.stamp_ns > other.row.stamp_ns;
      return number > other.number;
    }
  };

  template <typename Read>
  bool next_in_file(Row& row, const Read& read) {
    while (cursor_.next()) {
      row = Row{};
      row.stamp_ns = cursor_.stamp_ns();
      if (!grows(row.stamp_ns, cursor_.line()) || !good(row, read)) continue;
      write(row.stamp_ns, cursor_.line());
      return true;
    }
    return false;
  }

  template <typename Read>
  bool next_sorted(Row& row, const Read& read) {
    for (;;) {
      while (waiting_.size() <= sort_rows_ && cursor_.next()) push(read);
      if (waiting_.empty()) return false;
      std::pop_heap(waiting_.begin(), waiting_.end());
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      if (!grows(next.row.stamp_ns, next.line)) continue;
      cursor_.stream().sorted_rows += next.late ? 1 : 0;
      row = next.row;
      write(row.stamp_ns, next.line);
      return true;
    }
  }

  template <typename Read>
  void push(const Read& read) {
    Waiting next;
    next.row.stamp_ns = cursor_.stamp_ns();
    next.line = cursor_.line();
    next.number = numbered_++;
    if (!good(next.row, read)) return;
    next.late = next.number > 0 && next.row.stamp_ns < newest_ns_;
    newest_ns_ = next.number > 0 ? std::max(newest_ns_, next.row.stamp_ns) : next.row.stamp_ns;
    waiting_.push_back(next);
    std::push_heap(waiting_.begin(), waiting_.end());
  }

  template <typename Read>
  bool good(Row& row, const Read& read) {
    try {
      return read(row);
    } catch (const InputError& error) {
      cursor_.bad(error);
      return false;
    }
  }

  bool grows(TimeNs stamp_ns, std::int64_t line) {
    if (written_ == 0) return true;
    const TimeNs step_ns = stamp_ns - last_ns_;
    if (step_ns > 0 && step_ns >= cursor_.survey().thin_below_ns) return true;
    cursor_.leave_out(step_ns > 0    ? RowFate::thinned
                      : step_ns == 0 ? RowFate::repeated_stamp
                                     : RowFate::backward_stamp,
                      line);
    return false;
  }

  void write(TimeNs stamp_ns, std::int64_t line) {
    ImportedStream& stream = cursor_.stream();
    if (written_++ == 0)
      stream.first_ns = stamp_ns;
    else
      stream.intervals.count(stamp_ns - last_ns_, line);
    last_ns_ = stream.last_ns = stamp_ns;
    stream.rows = written_;
  }

  StreamCursor& cursor_;
  std::size_t sort_rows_;
  std::int64_t most_rows_;
  std::vector<Waiting> waiting_;
  std::int64_t written_ = 0, numbered_ = 0;
  TimeNs last_ns_ = 0, newest_ns_ = 0;
};

}  // namespace herr
