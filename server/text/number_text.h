// Numbers as text, the same in every locale.
#pragma once

#include <string>

#include "sessions/text/fixed_text.h"  // fixed_text()

namespace herr {

// The shortest text that reads back as the same double.
std::string shortest_text(double value);
// "1:02": minutes and seconds, rounded up to a whole second. `seconds` is not negative.
std::string minutes_text(double seconds);
// Padded with spaces on the left (or right) to `width` characters.
std::string right_aligned(const std::string& text, int width);
std::string left_aligned(const std::string& text, int width);

}  // namespace herr
