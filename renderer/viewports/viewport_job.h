// What the viewport stage needs to turn one eye's radiance buffer into one viewport, strip by strip.
// Polar coordinates are interpolated within 8x8 pixel cells where their curvature provably moves
// them by less than 1/16 of a sample; cells near the pole, the antipode and the seam's wrap are
// computed exactly, per pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/feed/feed_view.h"
#include "renderer/foveation/gaze_frame.h"
#include "renderer/foveation/polar_map.h"
#include "renderer/foveation/radiance_buffer.h"
#include "renderer/render_settings.h"
#include "renderer/viewport_image.h"
#include "sessions/format/display_profile.h"

namespace herr {

inline constexpr int kCellSide = 8;       // pixels: polar coordinates are exact at cell corners
inline constexpr int kStripRows = 16;     // rows of a job; one row of camera cells, two of polar cells
inline constexpr int kBlockColumns = 16;  // pixels that are composited together

// A direction of pixel (x, y) in the gaze frame is base + x * per_x + y * per_y, not normalised.
struct PixelToGaze {
  float base[3], per_x[3], per_y[3];  // components along right, up, gaze
};
PixelToGaze pixel_to_gaze(const Viewport& viewport, const GazeFrame& frame);

struct ViewportJob {
  const Viewport* viewport = nullptr;
  ViewportImage* out = nullptr;
  const RadianceBuffer* radiance = nullptr;
  bool polar = true;
  ResampleFilter filter = ResampleFilter::bilinear;  // of the radiance buffer; the feed is always bilinear
  int planar_width = 0, planar_height = 0;           // rays of the viewport, without foveation
  int polar_width = 0, polar_height = 0;
  float theta_to_column = 0;  // columns per unit of log1p(theta in degrees)
  PixelToGaze to_gaze{};
  float exact_below_deg = 0;  // cells with a point nearer to pole or antipode than this are exact
  FeedView feed;
  bool opaque = false;  // no feed, but the background is already in s: alpha is 1

  bool one_texel_per_pixel() const {
    return !polar && planar_width == viewport->width_px && planar_height == viewport->height_px;
  }
};

// Smallest eccentricity at which bilinear interpolation in a cell is off by less than 1/16 sample in both
// axes. Bound: a cell of side h has error <= h^2/8 (|f_xx| + |f_yy|); on the sphere the second derivatives of
// the map are at most W / (log1p(theta_max) theta (1 + theta)) and H / (2 pi theta^2) per square degree
// (theta to the nearer pole), and the planar projection adds its own curvature, at most 0.65 s^2 radians per
// pixel^2 at s radians per pixel.
float exact_below_deg(const Viewport& viewport, const PolarMap& map, int width, int height);

// Exact camera pixel of viewport pixel (x, y), or none when the model does not see that direction.
std::optional<glm::dvec2> camera_pixel(const Viewport& viewport, const FeedView& feed, double x, double y);

// One worker's memory for a strip of the widest viewport.
struct StripScratch {
  explicit StripScratch(int widest_px);
  std::int64_t bytes() const;
  std::vector<float> u, v, theta;         // 3 rows of polar cell corners
  std::vector<float> camera_x, camera_y;  // 3 rows of camera cell corners
  std::vector<std::uint8_t> camera_valid;
  std::size_t corner_stride, camera_stride;
};

// Composites rows [kStripRows * strip, ...) of a viewport.
using CompositeStrip = void (*)(const ViewportJob&, int strip, StripScratch&);
CompositeStrip composite_strip_for(Isa isa);

}  // namespace herr
