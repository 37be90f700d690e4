#include "renderer/viewports/density_overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <string>

#include "renderer/viewports/overlay_glyphs.h"
#include "sessions/camera/half_from_samples.h"

namespace herr {
namespace {

constexpr std::array kDegrees{1, 2, 5, 10, 15, 20, 30, 40, 50, 60, 70, 80, 90};
constexpr std::array kDensities{100, 50, 20, 10, 5, 2, 1};
constexpr int kBlock = 16;  // pixels a side, looked at together

using Colour = std::array<float, 3>;  // as shown, linear
constexpr Colour kBlue{0.05f, 0.45f, 1.0f}, kYellow{1.0f, 0.7f, 0.0f}, kBlack{0.0f, 0.0f, 0.0f};

const Colour& colour_of(OverlayLineKind kind) {
  return kind == OverlayLineKind::degrees ? kBlue : kYellow;
}

// A colour as texels of a picture that is shown with its exposure; opaque.
std::array<std::uint16_t, 4> texel_of(const Colour& colour, float exposure) {
  std::int64_t sanitised = 0;  // a finite colour is not
  std::array<std::uint16_t, 4> texel{};
  for (std::size_t c = 0; c < 3; ++c) texel[c] = half_from_linear(colour[c] / exposure, sanitised);
  texel[3] = 0x3c00;
  return texel;
}

double step_x(const Viewport& v) {
  return (v.tan_right - v.tan_left) / v.width_px;
}
double step_y(const Viewport& v) {
  return (v.tan_up - v.tan_down) / v.height_px;
}

// Of a line, and of the side of one dot of a number.
double line_px(const Viewport& v) {
  return std::max(1.5, v.width_px / 1200.0);
}
int dot_px(const Viewport& v) {
  return std::max(2, static_cast<int>(std::lround(v.width_px / 600.0)));
}

// A circle as the pixel loop asks for it: |cosine - cosine_of(theta)| <= sine * (half a line in radians).
struct Threshold {
  float cosine, sine;
};
using Thresholds = std::array<Threshold, OverlayCircles::kMost>;

// Half a line on the plane at distance 1: in radians in the middle, and no wider anywhere.
float half_line_of(const Viewport& v) {
  return static_cast<float>(0.5 * line_px(v) * step_x(v));
}

// "10°", "20/°".
std::string label_of(OverlayLineKind kind, int number) {
  return std::to_string(number) + (kind == OverlayLineKind::degrees ? "d" : "/d");
}

struct Box {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool meets(const Box& other) const {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
};

// The box of a label whose middle lies on the circle, phi counter-clockwise from `right`; none where that is
// not wholly inside the picture.
std::optional<Box> box_at(const Viewport& v, const OverlayCircles& circles, double theta_deg, double phi,
                          int width_px, int height_px) {
  const double theta = theta_deg / kDegreesPerRadian;
  const glm::dvec3 aside = circles.right * std::cos(phi) + circles.up * std::sin(phi);
  const glm::dvec3 d = circles.axis * std::cos(theta) + aside * std::sin(theta);
  if (!(d.z < -1e-3)) return std::nullopt;
  const double x = (d.x / -d.z - v.tan_left) / step_x(v), y = (v.tan_up - d.y / -d.z) / step_y(v);
  if (!(x > 0 && x < v.width_px && y > 0 && y < v.height_px)) return std::nullopt;
  Box box;
  box.x0 = static_cast<int>(x) - width_px / 2;
  box.y0 = static_cast<int>(y) - height_px / 2;
  box.x1 = box.x0 + width_px;
  box.y1 = box.y0 + height_px;
  if (box.x0 < 0 || box.y0 < 0 || box.x1 > v.width_px || box.y1 > v.height_px) return std::nullopt;
  return box;
}

void draw_label(const std::string& label, const Box& box, int dot, const Colour& colour,
                ViewportImage& image) {
  const auto front = texel_of(colour, image.exposure), back = texel_of(kBlack, image.exposure);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const int column = (x - box.x0) / dot - 1, row = (y - box.y0) / dot - 1;
      const auto& texel = is_glyph_dot(label, column, row) ? front : back;
      std::copy(texel.begin(), texel.end(), image.row(y) + 4 * x);
    }
  }
}

// Which lines may lie in a block: most blocks have none, and no pixel of theirs is looked at.
class BlockBounds {
 public:
  BlockBounds(const Viewport& v, const glm::dvec3& axis) : v_(v), axis_(axis), half_line_(half_line_of(v)) {
    const double radius = 0.5 * kBlock * std::hypot(step_x(v), step_y(v));
    cosine_ = std::cos(radius), sine_ = std::sin(radius);
  }

  // Of the first `count` lines those that may lie in the block that begins at (x, y); returns their number.
  // No pixel is farther from the middle of its block, seen from the eye, than on the plane at distance 1.
  int meeting(const Thresholds& lines, int count, int x, int y, Thresholds& met) const {
    const glm::dvec3 d(v_.tan_left + (x + 0.5 * kBlock) * step_x(v_),
                       v_.tan_up - (y + 0.5 * kBlock) * step_y(v_), -1.0);
    const double cosine = glm::dot(d, axis_) / glm::length(d);
    const double across = std::sqrt(std::max(0.0, 1 - cosine * cosine)) * sine_;
    const double nearest = cosine >= cosine_ ? 1 : cosine * cosine_ + across;
    const double farthest = cosine <= -cosine_ ? -1 : cosine * cosine_ - across;
    int found = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const double reach = static_cast<double>(lines[i].sine) * half_line_ + kRounding;
      if (lines[i].cosine + reach >= farthest && lines[i].cosine - reach <= nearest)
        met[static_cast<std::size_t>(found++)] = lines[i];
    }
    return found;
  }

 private:
  static constexpr double kRounding = 2e-6;  // 16 steps of a float of the pixel loop at 1

  const Viewport& v_;
  glm::dvec3 axis_;
  double half_line_, cosine_ = 1, sine_ = 0;
};

// A pixel d off the middle of the plane is smaller by 1 / |d|^2 along the radius, by 1 / |d| around it: a
// line is drawn between the two.
void draw_lines_in(const Viewport& v, const glm::vec3& axis, std::span<const Threshold> lines,
                   const Box& block, const std::array<std::uint16_t, 4>& texel, ViewportImage& image) {
  const float half_line = half_line_of(v);
  std::array<float, kBlock> cosine{}, half{};
  std::array<bool, kBlock> on{};
  for (int y = block.y0; y < block.y1; ++y) {
    const auto dy = static_cast<float>(v.tan_up - (y + 0.5) * step_y(v));
    for (std::size_t i = 0; i < kBlock; ++i) {
      const auto dx = static_cast<float>(v.tan_left + (block.x0 + static_cast<int>(i) + 0.5) * step_x(v));
      const float nearness = 1.0f / std::sqrt(dx * dx + dy * dy + 1.0f);
      cosine[i] = (dx * axis.x + dy * axis.y - axis.z) * nearness;
      half[i] = half_line * nearness * std::sqrt(nearness);
      on[i] = false;
    }
    for (const Threshold& line : lines) {
      for (std::size_t i = 0; i < kBlock; ++i)
        on[i] = on[i] || std::abs(cosine[i] - line.cosine) <= line.sine * half[i];
    }
    for (int x = block.x0; x < block.x1; ++x) {
      if (on[static_cast<std::size_t>(x - block.x0)])
        std::copy(texel.begin(), texel.end(), image.row(y) + 4 * x);
    }
  }
}

}  // namespace

OverlayCircles degree_circles(const GazeFrame& gaze) {
  OverlayCircles circles{OverlayLineKind::degrees, gaze.right, gaze.up, gaze.gaze, 0, {}};
  for (const int degrees : kDegrees) circles.add(degrees, degrees);
  return circles;
}

OverlayCircles density_circles(const GazeFrame& gaze, const PolarMap& map, int width, int height) {
  OverlayCircles circles{OverlayLineKind::density, gaze.right, gaze.up, gaze.gaze, 0, {}};
  for (const int density : kDensities) {
    // Where the radius has no fewer, and where the circle has no fewer.
    const double along_deg = map.radial_density(0, width) / density - 1;
    const double sine = height / (360.0 * density);
    const double around_deg = sine < 1 ? std::asin(sine) * kDegreesPerRadian : 180;
    const double theta_deg = std::min(along_deg, around_deg);
    if (theta_deg > 0 && theta_deg < map.theta_max_deg) circles.add(theta_deg, density);
  }
  return circles;
}

OverlayCircles density_circles(const Viewport& viewport, int columns, int rows) {
  OverlayCircles circles;
  circles.kind = OverlayLineKind::density;
  const double step_rad = std::max((viewport.tan_right - viewport.tan_left) / columns,
                                   (viewport.tan_up - viewport.tan_down) / rows);
  const double middle = 1 / (step_rad * kDegreesPerRadian);
  for (auto density = kDensities.rbegin(); density != kDensities.rend(); ++density) {
    if (*density > middle) circles.add(std::acos(middle / *density) * kDegreesPerRadian, *density);
  }
  return circles;
}

void draw_overlay_lines(const Viewport& v, const OverlayCircles& circles, int y0, int y1,
                        ViewportImage& image) {
  Thresholds lines{};
  for (int i = 0; i < circles.count; ++i) {
    const double theta = circles.circles[static_cast<std::size_t>(i)].theta_deg / kDegreesPerRadian;
    lines[static_cast<std::size_t>(i)] = {static_cast<float>(std::cos(theta)),
                                          static_cast<float>(std::sin(theta))};
  }
  const auto texel = texel_of(colour_of(circles.kind), image.exposure);
  const BlockBounds bounds(v, circles.axis);
  for (int y = y0; y < y1; y += kBlock) {
    for (int x = 0; x < v.width_px; x += kBlock) {
      Thresholds met{};
      const int count = bounds.meeting(lines, circles.count, x, y, met);
      if (count == 0) continue;
      const Box block{x, y, std::min(x + kBlock, v.width_px), std::min(y + kBlock, y1)};
      draw_lines_in(v, glm::vec3(circles.axis), {met.data(), static_cast<std::size_t>(count)}, block, texel,
                    image);
    }
  }
}

void draw_overlay_numbers(const Viewport& v, const OverlayCircles& circles, ViewportImage& image) {
  constexpr int kPlaces = 16;  // around a circle
  const double first = circles.kind == OverlayLineKind::degrees ? 0 : glm::pi<double>();
  const int dot = dot_px(v);
  std::optional<Box> outer;  // of the label outside this one
  for (int i = circles.count - 1; i >= 0; --i) {
    const auto& circle = circles.circles[static_cast<std::size_t>(i)];
    const std::string label = label_of(circles.kind, circle.number);
    const int width_px = dot * (glyphs_wide(label) + 2), height_px = dot * (kGlyphRows + 2);
    for (int k = 0; k < kPlaces; ++k) {
      const double phi = first + glm::two_pi<double>() * k / kPlaces;
      const std::optional<Box> box = box_at(v, circles, circle.theta_deg, phi, width_px, height_px);
      if (!box || (outer && box->meets(*outer))) continue;
      draw_label(label, *box, dot, colour_of(circles.kind), image);
      outer = box;
      break;
    }
  }
}

}  // namespace herr
