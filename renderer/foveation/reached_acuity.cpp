#include "renderer/foveation/reached_acuity.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

constexpr double kRounding = 1e-9;  // of products that are whole numbers but for their last digits

// Where sin(x) / (theta + 1) is largest, x in radians: its derivative is 0 where tan(x) = x + 1 degree.
// Newton's steps from above, where tan(x) - x is convex.
double steepest_circle_deg() {
  const double one_degree = 1.0 / kDegreesPerRadian;
  double x = 0.5;
  for (int step = 0; step < 12; ++step) {
    const double tangent = std::tan(x);
    x -= (tangent - x - one_degree) / (tangent * tangent);
  }
  return x * kDegreesPerRadian;
}

// The circle up to theta_max that asks for the most rows: before 21.0 degrees farther ones always ask for
// more.
double worst_circle_deg(double theta_max_deg) {
  static const double steepest_deg = steepest_circle_deg();
  return std::min(theta_max_deg, steepest_deg);
}

}  // namespace

int acuity_width(double theta_max_deg) {
  const double columns = PolarMap::up_to(theta_max_deg).paper_width();
  return std::max(1, static_cast<int>(std::ceil(columns - kRounding)));
}

int acuity_height(double theta_max_deg) {
  const double theta_deg = worst_circle_deg(theta_max_deg);
  const double rows = acuity_per_degree(theta_deg) / PolarMap::angular_density(theta_deg, 1.0);
  return std::max(2, 2 * static_cast<int>(std::ceil(rows / 2 - kRounding)));
}

int polar_columns(const RenderSettings& settings, double theta_max_deg) {
  if (!settings.polar_acuity) return settings.polar_width;
  return theta_max_deg > 0 ? acuity_width(theta_max_deg) : 1;
}

double k_angular_at(double theta_deg, int height) {
  return PolarMap::angular_density(theta_deg, height) * (theta_deg + 1.0);
}

ReachedAcuity reached_acuity(double theta_max_deg, int width, int height) {
  const double worst_deg = worst_circle_deg(theta_max_deg);
  return {PolarMap::up_to(theta_max_deg).radial_density(0.0, width), k_angular_at(worst_deg, height),
          worst_deg};
}

}  // namespace herr
