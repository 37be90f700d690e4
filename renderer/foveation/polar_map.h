// The log-polar map: eccentricity theta and angle phi of a direction <-> (u, v) in the polar buffer.
// Acuity f(theta) = k / (theta + 1) pixels per degree (paper equation 1), so u is the normalised integral of
// f: u(theta) = log1p(theta) / log1p(theta_max), theta(u) = expm1(u * log1p(theta_max)); theta in degrees. v
// = phi / 2 pi, counter-clockwise from the right vector. Every function is pure.
#pragma once

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace herr {

inline constexpr double kAcuityPixelsPerDegree =
    200.0;  // k of the paper, at theta = 0 with the paper's width
inline constexpr double kDegreesPerRadian = 180.0 / glm::pi<double>();

struct PolarMap {
  double theta_max_deg = 45.0;          // (0, 180]
  double log_range = std::log1p(45.0);  // log1p(theta_max_deg)

  static PolarMap up_to(double theta_max_deg) { return {theta_max_deg, std::log1p(theta_max_deg)}; }

  double u_from_theta(double theta_deg) const { return std::log1p(theta_deg) / log_range; }
  double theta_from_u(double u) const { return std::expm1(u * log_range); }
  // Radial samples per degree at theta when the buffer is `width` samples wide: d(width * u) / d theta.
  double radial_density(double theta_deg, double width) const {
    return width / (log_range * (1.0 + theta_deg));
  }
  // Angular samples per degree along the circle of eccentricity theta when it has `height` samples.
  static double angular_density(double theta_deg, double height) {
    return height / (360.0 * std::sin(theta_deg / kDegreesPerRadian));
  }
  // Width at which the radial density is the paper's acuity, 200 / (theta + 1): 766
  // (rounded up) at 45 degrees.
  double paper_width() const { return kAcuityPixelsPerDegree * log_range; }
};

// v in [0, 1) from an angle in radians of any finite value, and back to [0, 2 pi).
inline double v_from_phi(double phi) {
  const double turns = phi / glm::two_pi<double>();
  const double v = turns - std::floor(turns);
  return v < 1.0 ? v : 0.0;
}
inline double phi_from_v(double v) {
  return v * glm::two_pi<double>();
}

}  // namespace herr
