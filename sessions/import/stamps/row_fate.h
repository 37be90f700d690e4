// What can happen to a row of a foreign recording, each with its word in JSON, its sentence and whether it is
// a loss: the one list from which reports, session.json and exit codes are made. Before: stamps/,
// import_rows. After: import_report, `herr convert`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace herr {

enum class RowFate : std::size_t {
  lost_tracking,   // poses: left out, a loss; gaze: written as not valid for both eyes, no loss
  wild_stamp,      // far from its neighbours
  other_clock,     // many rows that do not fit in time between those that stay: a reset, a jump
  backward_stamp,  // earlier than the row before
  repeated_stamp,  // equal to the row before: the first stays
  bad,             // --keep-going: cannot be read
  thinned,         // a second camera's stamp beside the first one's: no loss
  count
};
inline constexpr std::size_t kRowFates = static_cast<std::size_t>(RowFate::count);

struct RowFateText {
  std::string_view key;       // "wild_stamp"
  std::string_view sentence;  // "rows left out: the stamp is far from its neighbours"
  bool loss;                  // counts towards the share that makes a result partial
};
std::span<const RowFateText, kRowFates> row_fate_texts();

struct RowFateCounts {
  static constexpr std::size_t kNamedLines = 8;
  std::array<std::int64_t, kRowFates> rows{};
  std::array<std::array<std::int64_t, kNamedLines>, kRowFates> lines{};  // the first ones of each

  void count(RowFate fate, std::int64_t line) {
    const auto i = static_cast<std::size_t>(fate);
    if (rows[i] < static_cast<std::int64_t>(kNamedLines)) lines[i][static_cast<std::size_t>(rows[i])] = line;
    ++rows[i];
  }
  std::int64_t operator[](RowFate fate) const { return rows[static_cast<std::size_t>(fate)]; }
};

}  // namespace herr
