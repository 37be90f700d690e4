// What shading leaves behind: one texel per sample, four halfs {s.r, s.g, s.b, r} in linear light.
// A viewport pixel is feed * r + s (DESIGN of the composite: s = virtual light, r = how much of the feed is
// kept). Under coloured light r needs a plane of its own: {r.r, r.g, r.b, 0}. Used as polar
// buffer and, without foveation, as the planar buffer of a viewport.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace herr {

// Layout: W x H samples with a border of texels that repeat some of them, so that a fetch of 2 x 2 or 4 x 4
// texels needs no branch. A bicubic fetch in cell (c, r) reads columns c - 1 ... c + 2 and rows r - 1 ... r +
// 2; cells have c in [-1, W - 1] and r in [0, H - 1].
//   polar:  columns -1, -2 hold samples 0, 1 across the pole (row r + H / 2); columns W, W + 1 repeat W - 1;
//           row -1 repeats row H - 1, rows H, H + 1 repeat rows 0, 1.
//   planar: every border texel repeats the nearest sample.
inline constexpr int kBorderLeft = 2, kBorderRight = 2, kBorderAbove = 1, kBorderBelow = 2;

// Columns and rows of a buffer of so many samples with its border.
inline int padded_columns(int width) {
  return width + kBorderLeft + kBorderRight;
}
inline int padded_rows(int height) {
  return height + kBorderAbove + kBorderBelow;
}

// Where the texel of a sample or of the border lies, in texels.
inline std::size_t texel_index(std::size_t row_stride, int column, int row) {
  return static_cast<std::size_t>(row + kBorderAbove) * row_stride +
         static_cast<std::size_t>(column + kBorderLeft);
}

// The feed is brightened by this at most.
inline constexpr float kLargestRatio = 4.0f;

class RadianceBuffer {
 public:
  // `columns` and `rows` count the border.
  void allocate(int columns, int rows, bool coloured_ratio);
  std::size_t row_stride() const { return row_stride_; }          // texels
  std::size_t texel_count() const { return texels_.size() / 4; }  // border and tail included
  std::int64_t bytes() const {
    return static_cast<std::int64_t>((texels_.capacity() + ratios_.capacity()) * sizeof(std::uint16_t));
  }
  std::uint16_t* texels() { return texels_.data(); }
  const std::uint16_t* texels() const { return texels_.data(); }
  std::uint16_t* ratios() { return ratios_.data(); }  // null when the ratio is one number
  const std::uint16_t* ratios() const { return ratios_.empty() ? nullptr : ratios_.data(); }

 private:
  std::size_t row_stride_ = 0;
  std::vector<std::uint16_t> texels_, ratios_;
};

// Where shading stores a sample, and each copy of it that the border holds.
struct TexelSink {
  std::uint16_t* texels = nullptr;
  std::uint16_t* ratios = nullptr;  // null: r is in the texel
  std::size_t row_stride = 0;       // texels
  int width = 0, height = 0;        // samples, without border
  bool polar = false;
};

}  // namespace herr
