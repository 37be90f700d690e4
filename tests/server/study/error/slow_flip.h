// LDR-FLIP to the letter of its paper, slow and in double: what the product's flip_map is held against.
// Shares nothing with it. Numbers in brackets are sections of the paper. Source: Andersson, Nilsson,
// Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc.
// ACM Comput. Graph. Interact. Tech. 3(2), HPG 2020.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

namespace herr::slow_flip {

struct Picture {
  int width = 0, height = 0;
  std::vector<glm::dvec3> pixels;  // rows from the top

  Picture(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  // Beyond a border its outermost pixels repeat, as in the authors' program.
  const glm::dvec3& at(int x, int y) const {
    return pixels[index(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1))];
  }
};

// Weights of a square of 2 * radius + 1 pixels, over the middle.
struct Kernel {
  int radius;
  std::vector<double> weights;

  explicit Kernel(int r) : radius(r), weights(static_cast<std::size_t>((2 * r + 1) * (2 * r + 1))) {}
  double& at(int dx, int dy) {
    return weights[static_cast<std::size_t>((dy + radius) * (2 * radius + 1) + dx + radius)];
  }
};

// Every kernel is even or odd in each direction, so turning it round, as a convolution does, changes at most
// the sign of a response, of which only the size counts. `transposed`: the derivative along y.
inline double response(const Picture& picture, int channel, Kernel& kernel, int x, int y,
                       bool transposed = false) {
  double sum = 0;
  for (int dy = -kernel.radius; dy <= kernel.radius; ++dy) {
    for (int dx = -kernel.radius; dx <= kernel.radius; ++dx) {
      sum += (transposed ? kernel.at(dy, dx) : kernel.at(dx, dy)) * picture.at(x + dx, y + dy)[channel];
    }
  }
  return sum;
}

// The matrix of the primaries and the white of sRGB (IEC 61966-2-1) from their chromaticities, not the four
// rounded digits of the standard: the white of RGB (1, 1, 1) is then exactly (0.3127, 0.3290).
// The authors' program has other last digits, which moves a pixel by less than 1e-4.
inline glm::dmat3 xyz_from_rgb() {
  const auto xyz = [](double x, double y) { return glm::dvec3{x / y, 1, (1 - x - y) / y}; };
  const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
  const glm::dvec3 scale = glm::inverse(primaries) * xyz(0.3127, 0.3290);
  return {primaries[0] * scale[0], primaries[1] * scale[1], primaries[2] * scale[2]};
}

// XYZ over that of white.
inline glm::dvec3 relative_from_rgb(const glm::dvec3& rgb) {
  static const glm::dmat3 matrix = xyz_from_rgb();
  return matrix * rgb / (matrix * glm::dvec3{1.0});
}

inline glm::dvec3 rgb_from_relative(const glm::dvec3& relative) {
  static const glm::dmat3 matrix = xyz_from_rgb(), back = glm::inverse(matrix);
  return back * (relative * (matrix * glm::dvec3{1.0}));
}

// YCxCz. The paper begins at sRGB; the input here is linear already.
inline glm::dvec3 opponent_from_rgb(const glm::dvec3& rgb) {
  const glm::dvec3 r = relative_from_rgb(rgb);
  return {116 * r.y - 16, 500 * (r.x - r.y), 200 * (r.y - r.z)};
}

inline glm::dvec3 rgb_from_opponent(const glm::dvec3& opponent) {
  const double y = (opponent[0] + 16) / 116;
  return rgb_from_relative({y + opponent[1] / 500, y, y - opponent[2] / 200});
}

// Contrast sensitivity of one channel as a filter over degrees. The factor sqrt(pi / b) is that of
// one dimension, as printed, in a kernel of two: it sets how the two Gaussians of blue-yellow share.
struct Sensitivity {
  double a1, b1, a2, b2;
};
inline constexpr std::array<Sensitivity, 3> kSensitivities{{{1, 0.0047, 0, 1e-5},         // achromatic
                                                            {1, 0.0053, 0, 1e-5},         // red-green
                                                            {34.1, 0.04, 13.5, 0.025}}};  // blue-yellow

inline Kernel sensitivity_kernel(const Sensitivity& s, double pixels_per_degree) {
  constexpr double kPi = std::numbers::pi, kLargestB = 0.04;
  // One radius for all channels: three standard deviations of the widest Gaussian, exp(-pi^2 x^2 / b).
  const double widest = std::sqrt(kLargestB / (2 * kPi * kPi));
  Kernel kernel(static_cast<int>(std::ceil(3 * widest * pixels_per_degree)));
  double sum = 0;
  for (int dy = -kernel.radius; dy <= kernel.radius; ++dy) {
    for (int dx = -kernel.radius; dx <= kernel.radius; ++dx) {
      const double d2 = (dx * dx + dy * dy) / (pixels_per_degree * pixels_per_degree);
      kernel.at(dx, dy) = s.a1 * std::sqrt(kPi / s.b1) * std::exp(-kPi * kPi * d2 / s.b1) +
                          s.a2 * std::sqrt(kPi / s.b2) * std::exp(-kPi * kPi * d2 / s.b2);
      sum += kernel.at(dx, dy);
    }
  }
  for (double& weight : kernel.weights) weight /= sum;
  return kernel;
}

// CIELAB relative to the same white, colours less vivid where it is dark (Hunt).
inline glm::dvec3 hunt_lab_from_rgb(const glm::dvec3& rgb) {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const glm::dvec3 r = relative_from_rgb(rgb);
  const double lightness = 116 * f(r.y) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(r.x) - f(r.y)), 0.01 * lightness * 200 * (f(r.y) - f(r.z))};
}

inline double hyab(const glm::dvec3& a, const glm::dvec3& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// From a distance of two colours to [0, 1]: the larger 60 % of the range share the last 5 %.
inline double colour_difference(const glm::dvec3& rgb_a, const glm::dvec3& rgb_b) {
  constexpr double kQc = 0.7, kPc = 0.4, kPt = 0.95;
  const double largest = std::pow(hyab(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1})), kQc);
  const double distance = std::pow(hyab(hunt_lab_from_rgb(rgb_a), hunt_lab_from_rgb(rgb_b)), kQc);
  const double knee = kPc * largest;
  if (distance < knee) return kPt * distance / knee;
  return kPt + (1 - kPt) * (distance - knee) / (largest - knee);
}

// First (edges) or second (points) derivative along x of a Gaussian, whose peak and trough lie 0.082
// degrees apart. Positive and negative weights are each brought to a sum of 1: the response is at most 1.
inline Kernel feature_kernel(int derivative, double pixels_per_degree) {
  const double sigma = 0.5 * 0.082 * pixels_per_degree;
  Kernel kernel(static_cast<int>(std::ceil(3 * sigma)));
  double positive = 0, negative = 0;
  for (int dy = -kernel.radius; dy <= kernel.radius; ++dy) {
    for (int dx = -kernel.radius; dx <= kernel.radius; ++dx) {
      const double gaussian = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
      const double weight = derivative == 1 ? -dx * gaussian : (dx * dx / (sigma * sigma) - 1) * gaussian;
      kernel.at(dx, dy) = weight;
      (weight > 0 ? positive : negative) += std::abs(weight);
    }
  }
  for (double& weight : kernel.weights) weight /= weight > 0 ? positive : negative;
  return kernel;
}

// What the eye sees of an opponent picture at a pixel, as linear RGB that a display can show.
inline glm::dvec3 seen(const Picture& opponent, std::array<Kernel, 3>& filters, int x, int y) {
  glm::dvec3 filtered;
  for (int c = 0; c < 3; ++c) {
    filtered[c] = response(opponent, c, filters[static_cast<std::size_t>(c)], x, y);
  }
  return glm::clamp(rgb_from_opponent(filtered), 0.0, 1.0);
}

// How much of an edge, or a point, there is at a pixel. Lengths, so that directions do not count.
inline double feature(const Picture& achromatic, Kernel& kernel, int x, int y) {
  return std::hypot(response(achromatic, 0, kernel, x, y), response(achromatic, 0, kernel, x, y, true));
}

inline Picture each(Picture picture, glm::dvec3 (*change)(const glm::dvec3&)) {
  for (glm::dvec3& pixel : picture.pixels) pixel = change(pixel);
  return picture;
}

// Light and dark alone, black 0 and white 1: features are looked for in it before any filter.
inline glm::dvec3 achromatic_from_rgb(const glm::dvec3& rgb) {
  return glm::dvec3{(opponent_from_rgb(rgb)[0] + 16) / 116};
}

// Both pictures of one size, linear light in [0, 1]. Rows from the top.
inline std::vector<double> flip(const Picture& a, const Picture& b, double pixels_per_degree) {
  const Picture opponent_a = each(a, opponent_from_rgb), opponent_b = each(b, opponent_from_rgb);
  const Picture light_a = each(a, achromatic_from_rgb), light_b = each(b, achromatic_from_rgb);
  std::array<Kernel, 3> filters{sensitivity_kernel(kSensitivities[0], pixels_per_degree),
                                sensitivity_kernel(kSensitivities[1], pixels_per_degree),
                                sensitivity_kernel(kSensitivities[2], pixels_per_degree)};
  Kernel edge = feature_kernel(1, pixels_per_degree), point = feature_kernel(2, pixels_per_degree);
  std::vector<double> out;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double colours =
          colour_difference(seen(opponent_a, filters, x, y), seen(opponent_b, filters, x, y));
      const double edges = std::abs(feature(light_a, edge, x, y) - feature(light_b, edge, x, y));
      const double points = std::abs(feature(light_a, point, x, y) - feature(light_b, point, x, y));
      // The power is q_f = 0.5; the length of two responses of at most 1 is at most sqrt(2).
      const double features = std::sqrt(std::max(edges, points) / std::numbers::sqrt2);
      out.push_back(std::pow(colours, 1 - features));
    }
  }
  return out;
}

}  // namespace herr::slow_flip
