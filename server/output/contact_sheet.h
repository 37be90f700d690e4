// All pictures of a frame in one (paper, Figure 6): context viewports above, focus viewports below, further
// views below them, left eye on the left. Each is reduced by an exact box filter in linear light, over a dark
// background.
#pragma once

#include "renderer/further_view.h"
#include "renderer/viewport_image.h"
#include "server/output/exr_encoder.h"
#include "server/output/srgb_table.h"

namespace herr {

inline constexpr int kContactSheetWidthPx = 1600;
inline constexpr int kContactSheetGapPx = 16;

// Where a picture stands on the sheet.
struct SheetCell {
  std::size_t picture = 0;  // number in the list
  int x_px = 0, y_px = 0, width_px = 0, height_px = 0;
};
struct SheetLayout {
  int width_px = 0, height_px = 0;
  std::vector<SheetCell> cells;
};

// Of pictures_of_frame(). None is enlarged; the sheet is at most kContactSheetWidthPx wide.
SheetLayout contact_sheet_layout(const std::vector<PictureOutline>& outlines);

// `pictures` as the outlines list them. `out` is RGB. Cells are drawn through `parallel_for`.
void draw_contact_sheet(const std::vector<const ViewportImage*>& pictures,
                        const std::vector<PictureOutline>& outlines, const ParallelFor& parallel_for,
                        Srgb8Image& out);

// One picture as RGB, reduced so that its longer side is at most `longest_px`; never enlarged.
void draw_reduced_picture(const ViewportImage& viewport, int longest_px, Srgb8Image& out);

}  // namespace herr
