#include "sessions/import/rows/filter_reader.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sessions/streams/field_text.h"

namespace herr {
namespace {

// "31", "31.0", "-1" (all bits) or "0x1f".
std::optional<std::uint64_t> bits_of(std::string_view text, char decimal) {
  const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
  if (hexadecimal) text.remove_prefix(2);
  const std::size_t point = hexadecimal ? std::string_view::npos : text.find(decimal);
  if (point != std::string_view::npos) {
    if (text.find_first_not_of('0', point + 1) != std::string_view::npos) return std::nullopt;
    text = text.substr(0, point);
  }
  const char* last = text.data() + text.size();
  std::uint64_t bits = 0;
  auto [end, error] = std::from_chars(text.data(), last, bits, hexadecimal ? 16 : 10);
  if (text.starts_with('-') && !hexadecimal) {
    std::int64_t negative = 0;
    const auto result = std::from_chars(text.data(), last, negative);
    end = result.ptr;
    error = result.ec;
    bits = static_cast<std::uint64_t>(negative);
  }
  return error == std::errc() && end == last ? std::optional(bits) : std::nullopt;
}

// "inf", "-Infinity", "1.#INF", also among several numbers.
bool is_infinite(std::string_view text) {
  constexpr std::string_view kUpper = "INF";
  const auto same = [](char c, char upper) { return c == upper || c == upper - 'A' + 'a'; };
  return std::search(text.begin(), text.end(), kUpper.begin(), kUpper.end(), same) != text.end();
}

bool has_bits(const RowSource& rows, std::size_t place, std::uint64_t wanted) {
  const auto bits = bits_of(rows.text(place), rows.decimal());
  if (!bits)
    rows.fail_field(place, "is " + in_quotes(rows.text(place)) + ", not a whole number, and has no bits",
                    "check has_bits of the map, or remove the line");
  return (*bits & wanted) == wanted;
}

}  // namespace

FilterReader::FilterReader(RowSource& rows, const RowFilter& filter) {
  for (const RowCondition& condition : filter.all) all_.push_back({&condition, rows.place(condition.column)});
  for (const RowCondition& condition : filter.any) any_.push_back({&condition, rows.place(condition.column)});
}

bool FilterReader::Test::passes(const RowSource& rows) const {
  const std::string_view text = rows.text(place);
  const auto is_text = [&](const std::string& wanted) { return text == wanted; };
  const bool listed = std::any_of(condition->texts.begin(), condition->texts.end(), is_text);
  switch (condition->kind) {
    case RowCondition::Kind::is:
    case RowCondition::Kind::one_of:
      return listed;
    case RowCondition::Kind::is_not:
      return !listed;
    default:
      break;
  }
  if (rows.absent(place) || is_infinite(text)) return false;
  switch (condition->kind) {
    case RowCondition::Kind::above:
      return rows.number(place) > condition->limit;
    case RowCondition::Kind::below:
      return rows.number(place) < condition->limit;
    case RowCondition::Kind::has_bits:
      return has_bits(rows, place, condition->bits);
    default:
      return true;  // finite
  }
}

bool FilterReader::passes(const RowSource& rows) const {
  for (const Test& test : all_)
    if (!test.passes(rows)) return false;
  for (const Test& test : any_)
    if (test.passes(rows)) return true;
  return any_.empty();
}

void add_columns(const RowFilter& filter, std::vector<ColumnRef>& columns) {
  for (const auto* conditions : {&filter.all, &filter.any})
    for (const RowCondition& condition : *conditions) columns.push_back(condition.column);
}

}  // namespace herr
