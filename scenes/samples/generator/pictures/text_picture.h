// Pictures of text, in DejaVu Sans through OpenImageIO's text rendering (FreeType). Before: pictures of the
// quality sample ask for lines. After: picture encodes.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "scenes/samples/generator/pictures/picture.h"

namespace herr::samples {

// A white page of `side_px` pixels, 1 channel of 8-bit grey for each of r, g, b.
Picture blank_page(int side_px);

// Writes one line in black; its base line starts at (x_px, y_px). `size_px`: the font's em. Throws
// std::runtime_error where the font is not installed.
void write_line(Picture& page, const std::string& text, int x_px, int y_px, int size_px);

// Pixels that the line would take from its start, of the same font.
int line_width_px(const std::string& text, int size_px);

}  // namespace herr::samples
