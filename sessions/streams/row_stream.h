// One stream of stamped rows, read forwards: each row is parsed, and stamps must grow.
// Opening reads it once in full as a check, replaying reads it again: the same rows are skipped both times.
// Before: CsvRows and a parser of stream_rows.h. After: stream_census (the check) and the samplers.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/streams/csv_rows.h"

namespace herr {

struct RowPolicy {
  bool keep_going = false;  // skip bad rows instead of throwing
  // Told of each skipped row; may be empty.
  std::function<void(const InputError&)> on_skipped;
};

template <typename Row>
class RowStream {
 public:
  using Parser = std::function<Row(const CsvRows&)>;

  // Throws InputError when the file or its header line is bad, whatever the policy.
  RowStream(const std::filesystem::path& file, const CsvLayout& layout, Parser parse, RowPolicy policy)
      : rows_(file, layout), parse_(std::move(parse)), policy_(std::move(policy)) {}

  // The next good row, or none at the end.
  std::optional<Row> next() {
    for (;;) {
      try {
        if (!rows_.next()) return std::nullopt;
        Row row = parse_(rows_);
        check_order(row.stamp_ns);
        return row;
      } catch (const InputError& error) {
        if (!policy_.keep_going) throw;
        if (policy_.on_skipped) policy_.on_skipped(error);
      }
    }
  }

  const CsvRows& rows() const { return rows_; }

 private:
  void check_order(TimeNs stamp_ns) {
    if (last_ns_ && stamp_ns == *last_ns_)
      rows_.fail("time stamp " + std::to_string(stamp_ns) + " repeats the one before",
                 "remove one of the two rows");
    if (last_ns_ && stamp_ns < *last_ns_)
      rows_.fail("time stamp " + std::to_string(stamp_ns) + " goes backwards by " +
                     std::to_string(*last_ns_ - stamp_ns) + " ns",
                 "sort the rows by time, or split the recording where its clock was reset");
    last_ns_ = stamp_ns;
  }

  CsvRows rows_;
  Parser parse_;
  RowPolicy policy_;
  std::optional<TimeNs> last_ns_;
};

}  // namespace herr
