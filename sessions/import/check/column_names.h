// What the names of columns say: their words, the unit in them, columns that differ in one letter alone.
// Before: sniffed_table. After: the roles of columns.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/import/check/sniffed_table.h"

namespace herr {

struct NameWords {
  std::vector<std::string> words;  // lower case; cut at signs and where capitals begin
  std::string unit;                // "s" "ms" "us" "ns" "m" "cm" "mm" "deg" "rad" "tan", or empty

  bool has(std::initializer_list<std::string_view> any) const;        // one of these is a word
  bool has_start(std::initializer_list<std::string_view> any) const;  // a word begins with one of these
};
// "HMDRotation.x (deg)": hmd, rotation, x; unit deg.
NameWords words_of(std::string_view name);

enum class Side { none, left, right };
Side side_of(const NameWords& name);

// Columns named alike but for x, y, z and, where there is one, w.
struct LetterGroup {
  NameWords name;  // without that letter
  std::array<std::size_t, 3> xyz{};
  std::optional<std::size_t> w;

  std::vector<std::size_t> columns() const { return {xyz.begin(), xyz.end()}; }
};
std::vector<LetterGroup> letter_groups(const SniffedTable& table);

// Of the head, not of a hand, a controller or an eye: the more the better, below 0 something else.
int head_score(const NameWords& name);
bool is_of_eyes(const NameWords& name);

}  // namespace herr
