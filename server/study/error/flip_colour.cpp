#include "server/study/error/flip_colour.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace herr {
namespace {

constexpr double kPower = 0.7, kKnee = 0.4, kKneeValue = 0.95;

// Rows of a 3 x 3 matrix as floats.
struct FlipMatrix {
  std::array<std::array<float, 3>, 3> row;
  explicit FlipMatrix(const glm::dmat3& m) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c)
        row[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = static_cast<float>(m[c][r]);
    }
  }
};

// To X, Y and Z as shares of white's, and back.
struct FlipMatrices {
  FlipMatrix to_shares, from_shares;
  static FlipMatrices make() {
    // CIE XYZ of the primaries of sRGB and its white D65 (0.3127, 0.3290).
    const glm::dmat3 xyz =
        glm::transpose(glm::dmat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,    // X
                                  2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,      // Y
                                  1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));  // Z
    const glm::dvec3 white = xyz * glm::dvec3(1);
    glm::dmat3 shares = xyz;
    for (int c = 0; c < 3; ++c) shares[c] /= white;
    return {FlipMatrix(shares), FlipMatrix(glm::inverse(shares))};
  }
};

const FlipMatrices& flip_matrices() {
  static const FlipMatrices matrices = FlipMatrices::make();
  return matrices;
}

void multiply(const FlipMatrix& m, FlipBlock& block) {
  for (std::size_t i = 0; i < kFlipBlock; ++i) {
    const float x = block[0][i], y = block[1][i], z = block[2][i];
    for (std::size_t r = 0; r < 3; ++r) block[r][i] = m.row[r][0] * x + m.row[r][1] * y + m.row[r][2] * z;
  }
}

// Of values in [0.008, 1.1]: a third of the float's bits, which stand for the logarithm, then Halley's method
// twice: the guess is right to 6 %, each step cubes that.
float cube_root(float value) {
  const auto bits = static_cast<float>(std::bit_cast<std::int32_t>(value));
  float root = std::bit_cast<float>(static_cast<std::int32_t>(bits * (1.0f / 3)) + 0x2A508000);
  for (int step = 0; step < 2; ++step) {
    const float cube = root * root * root;
    root *= (cube + 2 * value) / (2 * cube + value);
  }
  return root;
}

// CIELAB's curve.
float lab_curve(float share) {
  constexpr float kLinearBelow = 216.0f / 24389;  // (6 / 29)^3
  const float linear = share * (841.0f / 108) + 4.0f / 29;
  const float root = cube_root(share > kLinearBelow ? share : kLinearBelow);
  return share > kLinearBelow ? root : linear;
}

float hyab(float lightness, float a, float b) {
  return std::abs(lightness) + std::sqrt(a * a + b * b);
}

// HyAB to the power 0.7 of green against blue, the two colours of sRGB that lie farthest apart.
float largest_difference() {
  FlipBlock block{};
  block[1][0] = 1;
  block[2][1] = 1;
  ycxcz_from_linear(block);
  hunt_lab_from_ycxcz(block);
  return std::pow(hyab(block[0][0] - block[0][1], block[1][0] - block[1][1], block[2][0] - block[2][1]),
                  static_cast<float>(kPower));
}

}  // namespace

void ycxcz_from_linear(FlipBlock& block) {
  multiply(flip_matrices().to_shares, block);
  for (std::size_t i = 0; i < kFlipBlock; ++i) {
    const float x = block[0][i], y = block[1][i], z = block[2][i];
    block[0][i] = 116 * y - 16;
    block[1][i] = 500 * (x - y);
    block[2][i] = 200 * (y - z);
  }
}

void hunt_lab_from_ycxcz(FlipBlock& block) {
  for (std::size_t i = 0; i < kFlipBlock; ++i) {
    const float y = (block[0][i] + 16) * (1.0f / 116);
    block[0][i] = y + block[1][i] * (1.0f / 500);
    block[2][i] = y - block[2][i] * (1.0f / 200);
    block[1][i] = y;
  }
  multiply(flip_matrices().from_shares, block);
  for (auto& channel : block) {
    for (float& value : channel) value = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
  }
  multiply(flip_matrices().to_shares, block);
  for (auto& channel : block) {
    for (float& value : channel) value = lab_curve(value);
  }
  for (std::size_t i = 0; i < kFlipBlock; ++i) {
    const float x = block[0][i], y = block[1][i], z = block[2][i];
    const float lightness = 116 * y - 16;
    block[0][i] = lightness;
    block[1][i] = 5 * (x - y) * lightness;  // 500 * 0.01
    block[2][i] = 2 * (y - z) * lightness;
  }
}

float flip_colour_difference(float lightness, float a, float b) {
  static const float kLargest = largest_difference();
  constexpr auto kKneeAt = static_cast<float>(kKnee), kAtKnee = static_cast<float>(kKneeValue);
  const float share = std::pow(hyab(lightness, a, b), static_cast<float>(kPower)) / kLargest;
  if (share < kKneeAt) return share * (kAtKnee / kKneeAt);
  return kAtKnee + (share - kKneeAt) * ((1 - kAtKnee) / (1 - kKneeAt));
}

}  // namespace herr
