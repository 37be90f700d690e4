// The pictures of the `quality` sample (paper, section 3.4): what shows whether text and thin lines stay
// legible at the gaze and calm around it. Before: text_picture. After: objects/quality_boards hangs them up.
#pragma once

#include "scenes/samples/generator/pictures/picture.h"

namespace herr::samples {

inline constexpr int kChartSide_px = 2048;

Picture reading_page();      // paragraphs in ems of 72 ... 18 pixels
Picture letter_chart();      // rows of Sloan's ten letters, each row smaller by 10^0.1 (LogMAR)
Picture line_chart();        // three curves over a grid of hairlines, with labels
Picture resolution_chart();  // a star of 72 sectors, a zone plate, gratings of 2 ... 32 pixels a period

}  // namespace herr::samples
