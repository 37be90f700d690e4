// What tests ask of whole frames: the same bits, no NaN, stage times that add up.
// Before: test_scenes.h renders. After: nothing.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/renderer.h"
#include "tests/renderer/half_pixels.h"

namespace herr::test {

// Visible pixels only: the padding at the end of rows is nobody's.
inline bool same_bits(const ViewportImage& a, const ViewportImage& b) {
  if (a.width_px != b.width_px || a.height_px != b.height_px) return false;
  for (int y = 0; y < a.height_px; ++y) {
    if (!std::equal(a.row(y), a.row(y) + 4 * a.width_px, b.row(y))) return false;
  }
  return true;
}

inline void expect_same_bits(const RenderedFrame& a, const RenderedFrame& b) {
  ASSERT_EQ(a.viewports.size(), b.viewports.size());
  for (std::size_t i = 0; i < a.viewports.size(); ++i) {
    EXPECT_TRUE(same_bits(a.viewports[i], b.viewports[i])) << "viewport " << i;
  }
}

// Mean absolute difference of the colours of all visible pixels.
inline double mean_difference(const RenderedFrame& a, const RenderedFrame& b) {
  double sum = 0;
  std::int64_t values = 0;
  for (std::size_t i = 0; i < a.viewports.size(); ++i) {
    for_each_pixel(a.viewports[i], [&](int x, int y, const Pixel& pixel) {
      const Pixel other = pixel_at(b.viewports[i], x, y);
      for (std::size_t channel = 0; channel < 3; ++channel) sum += std::abs(pixel[channel] - other[channel]);
      values += 3;
    });
  }
  return sum / static_cast<double>(values);
}

// Half-float values that are neither NaN nor infinite, and nothing that had to be replaced on the way.
inline void expect_finite(const RenderedFrame& frame) {
  for (std::size_t i = 0; i < frame.viewports.size(); ++i) {
    int bad = 0;
    for_each_pixel(frame.viewports[i], [&](int x, int y, const Pixel& pixel) {
      for (const double channel : pixel) {
        if (!std::isfinite(channel) && ++bad == 1)
          ADD_FAILURE() << "viewport " << i << " at " << x << ", " << y;
      }
    });
    EXPECT_EQ(bad, 0) << "values of viewport " << i;
  }
  EXPECT_EQ(frame.counters.nonfinite_values, 0);
}

inline void expect_times_add_up(const RenderedFrame& frame) {
  double sum = 0;
  for (const double ms : frame.times.ms) {
    EXPECT_GE(ms, 0.0);
    sum += ms;
  }
  EXPECT_NEAR(sum, frame.times.frame_ms, 1e-6);
}

}  // namespace herr::test
