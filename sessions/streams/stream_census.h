// What a whole stream looks like: how many rows, from when to when, how far apart. Constant memory.
// Before: RowStream, read once in full when a session is opened. After: the findings of Session::open.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "sessions/files/input_error.h"
#include "sessions/format/pose.h"

namespace herr {

class StreamCensus {
 public:
  void count(TimeNs stamp_ns, std::int64_t line);

  std::int64_t rows() const { return rows_; }
  TimeNs first_ns() const { return first_ns_; }
  TimeNs last_ns() const { return last_ns_; }

  // Throws InputError when most neighbours are less than 0.1 ms apart or, if `slow_refused`, more than 10 s:
  // the stamps are then in another unit. Most neighbours decide, so that one long pause is allowed.
  void check_rate(const std::filesystem::path& file, bool slow_refused) const;
  // A line about gaps of more than a second, when there are any.
  std::optional<InputError> gap_warning(const std::filesystem::path& file) const;

 private:
  std::int64_t rows_ = 0, too_close_ = 0, too_far_ = 0, gaps_ = 0;
  TimeNs first_ns_ = 0, last_ns_ = 0, widest_ns_ = 0;
  std::int64_t widest_line_ = 0;
};

}  // namespace herr
