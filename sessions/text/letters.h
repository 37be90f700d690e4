// Letters and digits of plain text, whatever the locale. Before: nothing. After: readers of numbers, words,
// dates and names.
#pragma once

namespace herr {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

constexpr bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

constexpr char lower_case(char c) {
  return is_capital(c) ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace herr
