#include "server/output/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace herr {
namespace {

constexpr float kBackgroundLinear = 0.02f;  // 8-bit sRGB 39: dark enough to show black pictures' borders

using Texel = std::array<float, 4>;

// Those of no eye last.
std::vector<std::size_t> pictures_of_kind(const std::vector<PictureOutline>& outlines, PictureKind kind) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (outlines[i].kind == kind) found.push_back(i);
  }
  std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
    return outlines[a].eye && (!outlines[b].eye || *outlines[a].eye < *outlines[b].eye);
  });
  return found;
}

// Places one row of pictures below what is there.
void add_row(const std::vector<PictureOutline>& outlines, const std::vector<std::size_t>& row,
             SheetLayout& layout) {
  if (row.empty()) return;
  const int count = static_cast<int>(row.size());
  const int width = std::max(1, (kContactSheetWidthPx - (count + 1) * kContactSheetGapPx) / count);
  int x = kContactSheetGapPx, tallest = 0;
  for (const std::size_t index : row) {
    const PictureOutline& picture = outlines[index];
    const int cell_width = std::min(width, picture.width_px);
    const double height = static_cast<double>(picture.height_px) * cell_width / picture.width_px;
    const int cell_height = std::max(1, static_cast<int>(std::lround(height)));
    layout.cells.push_back({index, x, layout.height_px, cell_width, cell_height});
    x += cell_width + kContactSheetGapPx;
    tallest = std::max(tallest, cell_height);
  }
  layout.width_px = std::max(layout.width_px, x);
  layout.height_px += tallest + kContactSheetGapPx;
}

// The share of a source row or column that a cell's pixel covers: [begin, end) in source pixels, fractional.
struct Span {
  double begin, end;
  int first() const { return static_cast<int>(begin); }
  int last(int size) const { return std::min(size - 1, static_cast<int>(std::ceil(end)) - 1); }
  float weight(int i) const {
    return static_cast<float>(std::min(end, i + 1.0) - std::max(begin, double(i)));
  }
};

Span span_of(int pixel, int cell_size, int source_size) {
  const double scale = static_cast<double>(source_size) / cell_size;
  return {pixel * scale, std::min((pixel + 1) * scale, static_cast<double>(source_size))};
}

// Sums one source row into the cell's row, weighted.
void add_source_row(const std::uint16_t* source, int source_width, float row_weight,
                    std::vector<Texel>& sums) {
  const int cell_width = static_cast<int>(sums.size());
  for (int x = 0; x < cell_width; ++x) {
    const Span span = span_of(x, cell_width, source_width);
    Texel& sum = sums[static_cast<std::size_t>(x)];
    for (int i = span.first(); i <= span.last(source_width); ++i) {
      const float weight = row_weight * span.weight(i);
      const std::uint16_t* texel = source + 4 * static_cast<std::size_t>(i);
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * float_from_half(texel[c]);
    }
  }
}

void draw_cell_row(const ViewportImage& image, const SheetCell& cell, int y, Srgb8Image& out) {
  std::vector<Texel> sums(static_cast<std::size_t>(cell.width_px), Texel{});
  const Span rows = span_of(y, cell.height_px, image.height_px);
  for (int i = rows.first(); i <= rows.last(image.height_px); ++i) {
    add_source_row(image.row(i), image.width_px, rows.weight(i), sums);
  }
  const double columns = static_cast<double>(image.width_px) / cell.width_px;
  const auto norm = static_cast<float>(1.0 / (columns * (rows.end - rows.begin)));
  const Srgb8Table& table = srgb8_of_half(image.exposure);
  const float background = kBackgroundLinear / image.exposure;
  std::uint8_t* pixel = out.values.data() + 3 * (static_cast<std::size_t>(cell.y_px + y) *
                                                     static_cast<std::size_t>(out.width_px) +
                                                 static_cast<std::size_t>(cell.x_px));
  for (const Texel& sum : sums) {
    const float uncovered = std::max(0.0f, 1.0f - sum[3] * norm);
    for (std::size_t c = 0; c < 3; ++c) {
      *pixel++ = table[half_from_float(sum[c] * norm + uncovered * background)];
    }
  }
}

}  // namespace

SheetLayout contact_sheet_layout(const std::vector<PictureOutline>& outlines) {
  SheetLayout layout;
  layout.height_px = kContactSheetGapPx;
  for (const PictureKind kind : kPictureKinds) add_row(outlines, pictures_of_kind(outlines, kind), layout);
  return layout;
}

void draw_contact_sheet(const std::vector<const ViewportImage*>& pictures,
                        const std::vector<PictureOutline>& outlines, const ParallelFor& parallel_for,
                        Srgb8Image& out) {
  const SheetLayout layout = contact_sheet_layout(outlines);
  out.width_px = layout.width_px;
  out.height_px = layout.height_px;
  out.channels = 3;
  out.nonfinite_values = out.clipped_pixels = 0;
  const std::uint8_t background = srgb8_of_half()[half_from_float(kBackgroundLinear)];
  out.values.assign(3 * static_cast<std::size_t>(out.width_px) * static_cast<std::size_t>(out.height_px),
                    background);
  for (const SheetCell& cell : layout.cells) {
    parallel_for(cell.height_px, [&](int y) { draw_cell_row(*pictures[cell.picture], cell, y, out); });
  }
}

void draw_reduced_picture(const ViewportImage& viewport, int longest_px, Srgb8Image& out) {
  const int longest = std::max(viewport.width_px, viewport.height_px);
  const double scale = std::min(1.0, static_cast<double>(longest_px) / longest);
  const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(px * scale))); };
  const SheetCell cell{0, 0, 0, side(viewport.width_px), side(viewport.height_px)};
  out.width_px = cell.width_px;
  out.height_px = cell.height_px;
  out.channels = 3;
  out.nonfinite_values = out.clipped_pixels = 0;
  out.values.resize(3 * static_cast<std::size_t>(cell.width_px) * static_cast<std::size_t>(cell.height_px));
  for (int y = 0; y < cell.height_px; ++y) draw_cell_row(viewport, cell, y, out);
}

}  // namespace herr
