// Numbers as foreign files write them. Before: fields of row_source. After: rows/, and table_layout, which
// tries what a file may mean. Independent of locale.
#pragma once

#include <optional>
#include <string_view>

namespace herr {

// Digits with optional sign, `decimal` sign and exponent, correctly rounded; none for anything else, also for
// what is not finite.
std::optional<double> parse_number(std::string_view text, char decimal);

// Empty, or a word that programs write for no number: nan, -nan(ind), 1.#QNAN, NULL, None, N/A ...; of
// several numbers in one field: any of them.
bool stands_for_no_number(std::string_view text);

// Cuts the next number off the text of several, "1.0, 2.0, 3.0", without brackets; empty at the end. Commas,
// semicolons and blanks part them; with a decimal comma, a comma does so only before a blank.
std::string_view take_number(std::string_view& rest, char decimal);
std::string_view without_brackets(std::string_view text);

// How well the text fits numbers with this decimal sign: 2 a number, several in brackets or a word for none;
// 1 several without brackets; 0 anything else, also what fits the other sign better.
int number_evidence(std::string_view text, char decimal);
inline bool reads_as_number(std::string_view text, char decimal) {
  return number_evidence(text, decimal) > 0;
}

}  // namespace herr
