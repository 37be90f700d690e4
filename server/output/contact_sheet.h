// All viewports of a frame in one picture (paper, Figure 6): context viewports above, focus viewports below,
// left eye on the left. Each is reduced by an exact box filter in linear light, over a dark background.
#pragma once

#include "renderer/viewport_image.h"
#include "server/output/exr_encoder.h"
#include "server/output/srgb_table.h"
#include "sessions/format/display_profile.h"

namespace herr {

inline constexpr int kContactSheetWidthPx = 1600;
inline constexpr int kContactSheetGapPx = 16;

// Where a viewport stands on the sheet.
struct SheetCell {
  std::size_t viewport = 0;
  int x_px = 0, y_px = 0, width_px = 0, height_px = 0;
};
struct SheetLayout {
  int width_px = 0, height_px = 0;
  std::vector<SheetCell> cells;
};

// Viewports are never enlarged; the sheet is at most kContactSheetWidthPx wide.
SheetLayout contact_sheet_layout(const DisplayProfile& profile);

// `out` is RGB. Cells are drawn through `parallel_for`.
void draw_contact_sheet(const std::vector<ViewportImage>& viewports, const DisplayProfile& profile,
                        const ParallelFor& parallel_for, Srgb8Image& out);

// One viewport as RGB, reduced so that its longer side is at most `longest_px`; never enlarged.
void draw_reduced_picture(const ViewportImage& viewport, int longest_px, Srgb8Image& out);

}  // namespace herr
