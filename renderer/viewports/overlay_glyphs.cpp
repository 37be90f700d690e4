#include "renderer/viewports/overlay_glyphs.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace herr {
namespace {

struct Glyph {
  char letter;
  std::string_view dots;  // row by row
};
constexpr std::array<Glyph, 12> kGlyphs{{{'0', "####.##.##.####"},
                                         {'1', ".#.##..#..#.###"},
                                         {'2', "###..#####..###"},
                                         {'3', "###..####..####"},
                                         {'4', "#.##.####..#..#"},
                                         {'5', "####..###..####"},
                                         {'6', "####..####.####"},
                                         {'7', "###..#..#..#..#"},
                                         {'8', "####.#####.####"},
                                         {'9', "####.####..####"},
                                         {'/', "..#..#.#.#..#.."},
                                         {'d',
                                          "###"
                                          "#.#"
                                          "###"
                                          "..."
                                          "..."}}};

}  // namespace

int glyphs_wide(const std::string& text) {
  return text.empty() ? 0 : static_cast<int>(text.size()) * (kGlyphColumns + 1) - 1;
}

bool is_glyph_dot(const std::string& text, int column, int row) {
  if (column < 0 || row < 0 || row >= kGlyphRows || column >= glyphs_wide(text)) return false;
  const int within = column % (kGlyphColumns + 1);
  if (within == kGlyphColumns) return false;
  const char letter = text[static_cast<std::size_t>(column / (kGlyphColumns + 1))];
  for (const Glyph& glyph : kGlyphs)
    if (glyph.letter == letter)
      return glyph.dots[static_cast<std::size_t>(row * kGlyphColumns + within)] == '#';
  return false;
}

}  // namespace herr
