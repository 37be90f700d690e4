// The polar map and back, in units in the last place; rays at spheres and boxes against double precision.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "renderer/foveation/polar_map.h"
#include "tests/numerics/exact_answer.h"
#include "tests/renderer/geometry/shape_rays.h"

namespace herr::test {
namespace {

constexpr double kFloatRounding = 0x1p-24;  // of a float
constexpr int kRays = 200'000;

double ulp_of(double x) {
  return std::nextafter(x, std::numeric_limits<double>::infinity()) - x;
}

// Calls visit(x) for x in [0, highest]: evenly, and by exponents down to e^-40.
template <typename Visit>
void sweep(double highest, const Visit& visit) {
  constexpr int kSteps = 20'000;
  for (int i = 0; i <= kSteps; ++i) {
    visit(highest * i / kSteps);
    visit(highest * std::exp(-40.0 * i / kSteps));
  }
}

double column_and_back() {
  double worst = 0;
  for (const double range_deg : {1e-3, 1.0, 45.0, 90.0, 134.5, 180.0}) {
    const PolarMap map = PolarMap::up_to(range_deg);
    sweep(1.0, [&](double u) {
      worst = std::max(worst, std::abs(map.u_from_theta(map.theta_from_u(u)) - u) / ulp_of(u));
    });
  }
  return worst;
}

// The distance between an angle and its return, seen in columns.
double angle_and_back() {
  double worst = 0;
  for (const double range_deg : {45.0, 90.0, 179.0, 180.0}) {
    const PolarMap map = PolarMap::up_to(range_deg);
    sweep(std::min(range_deg, 179.0), [&](double theta) {
      const double u = map.u_from_theta(theta);
      const double moved = std::abs(map.theta_from_u(u) - theta) * map.radial_density(theta, 1.0);
      worst = std::max(worst, moved / ulp_of(u));
    });
  }
  return worst;
}

double turn_and_back() {
  double worst = 0;
  sweep(1.0 - 1e-12,
        [&](double v) { worst = std::max(worst, std::abs(v_from_phi(phi_from_v(v)) - v) / ulp_of(v)); });
  return worst;
}

// Error of the nearest crossing ahead, in roundings of what it is made of: t itself and, at the sphere, what
// is known of the start, magnified by the slope at which the ray meets the surface. Rays within rounding of
// touching have no right answer and are left out.
double crossing_error(ShapeKind kind) {
  ShapeRayMaker maker(20241);
  std::vector<ShapeRay> rays;
  for (int i = 0; i < kRays; ++i) {
    rays.push_back(i % 2 == 0 ? maker.random_ray(1000) : maker.grazing_ray(kind, 1000));
  }
  const TracedShapes traced = trace_shape(resolve_isa(Isa::best), kind, rays);
  double worst = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool ball = kind == ShapeKind::sphere;
    const ExactCrossing exact = ball ? cross_sphere(rays[i]) : cross_box(rays[i]);
    const double far = std::max(1.0, glm::length(glm::dvec3(rays[i].origin)));
    const double touching = ball ? (8 + 4 * far) * kFloatRounding : 4.01 * kFloatRounding;
    const double t = exact.enter > 0 ? exact.enter : exact.leave;
    if (exact.margin < touching || !(t > 0) || !traced.hits[i].hit) continue;
    const double slope = std::sqrt(exact.margin), length = glm::length(glm::dvec3(rays[i].direction));
    const double made_of = ball ? t + far / (length * slope) : t;
    worst = std::max(worst, std::abs(double{traced.hits[i].t} - t) / (kFloatRounding * made_of));
  }
  return worst;
}

double sphere_crossing() {
  return crossing_error(ShapeKind::sphere);
}
double box_crossing() {
  return crossing_error(ShapeKind::box);
}

constexpr ExactAnswer kGeometryAnswers[] = {
    {"PolarColumnAndBack", "u -> theta -> u of the polar map, up to 0.001 ... 180 degrees", column_and_back,
     4, "ulp of u", "four roundings stand between u and its return: product, expm1, log1p, quotient"},
    {"PolarAngleAndBack", "theta -> u -> theta, up to 45 ... 180 degrees, seen in columns", angle_and_back, 4,
     "ulp of u", "the same four roundings the other way round"},
    {"PolarTurnAndBack", "v -> phi -> v", turn_and_back, 1.5, "ulp of v",
     "a product and a quotient with one constant; the first rounding counts double above a power of two"},
    {"RaysAtASphere",
     "nearest crossing of 200,000 rays with a sphere, from up to 1,000 radii away, half of them grazing",
     sphere_crossing, 8, "roundings to float of t and of start / slope",
     "four units in the last place of the distance and of what is known of the start, over the square root "
     "of "
     "the discriminant"},
    {"RaysAtABox", "nearest crossing of 200,000 rays with a box, half of them grazing an edge", box_crossing,
     2.01, "roundings to float of t", "each plane costs one rounded subtraction and one rounded division"},
};

}  // namespace

std::span<const ExactAnswer> geometry_answers() {
  return kGeometryAnswers;
}

}  // namespace herr::test
