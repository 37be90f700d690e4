// The few signs of the numbers on overlay lines, as dots: five rows of three columns each, one column apart.
// Before: density_overlay. After: pixels.
#pragma once

#include <string>

namespace herr {

inline constexpr int kGlyphRows = 5, kGlyphColumns = 3;

// Columns of a text of digits, '/' and 'd', which is the sign of degrees.
int glyphs_wide(const std::string& text);
// Whether dot (column, row) of it is drawn; row 0 is the uppermost. False outside, and for other letters.
bool is_glyph_dot(const std::string& text, int column, int row);

}  // namespace herr
