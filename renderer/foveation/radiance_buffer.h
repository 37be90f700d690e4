// What shading leaves behind: one texel per sample, four halfs {s.r, s.g, s.b, r} in linear light.
// A viewport pixel is feed * r + s (DESIGN of the composite: s = virtual light, r = how much of the feed is
// kept). Under coloured light r needs a plane of its own: {r.r, r.g, r.b, 0}. Used as polar
// buffer (with wrap padding) and, without foveation, as one texel per viewport pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace herr {

// Polar layout: column c + 1 holds radial sample c; column 0 holds the sample across the pole (phi +
// pi), column W + 1 repeats the last; row H repeats row 0. So every bilinear fetch reads (x, x+1) x
// (y, y+1) with no branch.
class RadianceBuffer {
 public:
  // `columns` and `rows` count the padding.
  void allocate(int columns, int rows, bool coloured_ratio);
  std::size_t row_stride() const { return row_stride_; }  // texels
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

// Where shading stores a sample. Polar: mirrors each texel into the padding that repeats it.
struct TexelSink {
  std::uint16_t* texels = nullptr;
  std::uint16_t* ratios = nullptr;  // null: r is in the texel
  std::size_t row_stride = 0;       // texels
  int width = 0, height = 0;        // samples, without padding
  bool polar = false;
};

}  // namespace herr
