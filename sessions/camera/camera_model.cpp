#include "sessions/camera/camera_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace herr {
namespace {

// Widest angles that the formulae bear: a pinhole's radius is a tangent; a fisheye is
// singular straight behind.
constexpr double kWidestPinholeRad = 1.5533430342749532;  // 89 degrees
constexpr double kWidestFisheyeRad = 3.1241393610698499;  // 179 degrees
constexpr int kMaxIterations = 60;
constexpr double kConvergedPx = 1e-9;

struct Mapped {
  glm::dvec2 value;
  glm::dmat2 jacobian;  // columns are derivatives by x and by y
};

int radial_terms(CameraModelKind kind) {
  return kind == CameraModelKind::pinhole ? 3 : kind == CameraModelKind::kb4 ? 4 : 6;
}

// k of the polynomial 1 + k0 s + k1 s^2 + ..., where s is the square of the radius or of the angle.
double radial_coefficient(const CameraModel& model, int i) {
  const bool pinhole = model.kind == CameraModelKind::pinhole;
  return model.distortion[static_cast<std::size_t>(pinhole && i == 2 ? 4 : i)];
}

// Radius on the image plane (before tangential terms) of an undistorted radius: tan of the angle for a
// pinhole, the angle itself for a fisheye. Odd polynomial r (1 + k0 r^2 + ...).
double radial(const CameraModel& model, double r) {
  const double s = r * r;
  double sum = 0;
  for (int i = radial_terms(model.kind) - 1; i >= 0; --i) sum = (sum + radial_coefficient(model, i)) * s;
  return r * (1 + sum);
}

double radial_slope(const CameraModel& model, double r) {
  const double s = r * r;
  double sum = 0;
  for (int i = radial_terms(model.kind) - 1; i >= 0; --i)
    sum = (sum + (2 * i + 3) * radial_coefficient(model, i)) * s;
  return 1 + sum;
}

double radius_of_angle(const CameraModel& model, double angle_rad) {
  return model.kind == CameraModelKind::pinhole ? std::tan(angle_rad) : angle_rad;
}

// Inverse of radial() on [0, highest], where it rises: Newton's steps, halving the
// bracket when a step leaves it.
double inverse_radial(const CameraModel& model, double wanted, double highest) {
  double low = 0, high = highest, r = std::min(wanted, highest);
  for (int i = 0; i < kMaxIterations; ++i) {
    const double error = radial(model, r) - wanted;
    (error > 0 ? high : low) = r;
    const double slope = radial_slope(model, r);
    double next = slope > 0 ? r - error / slope : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - r) <= 1e-16 * highest) return next;
    r = next;
  }
  return r;
}

// Brown-Conrady's whole distortion on the plane z = 1.
Mapped brown_conrady(const CameraModel& model, const glm::dvec2& p) {
  const double p1 = model.distortion[2], p2 = model.distortion[3];
  const double r = glm::length(p), factor = r > 0 ? radial(model, r) / r : 1.0;
  const double growth = r > 0 ? (radial_slope(model, r) - factor) / (r * r) : 0.0;  // d factor / d r, over r
  const double x = p.x, y = p.y, s = r * r;
  Mapped out;
  out.value = {x * factor + 2 * p1 * x * y + p2 * (s + 2 * x * x),
               y * factor + p1 * (s + 2 * y * y) + 2 * p2 * x * y};
  out.jacobian[0] = {factor + x * x * growth + 2 * p1 * y + 6 * p2 * x,
                     x * y * growth + 2 * p1 * x + 2 * p2 * y};
  out.jacobian[1] = {x * y * growth + 2 * p1 * x + 2 * p2 * y,
                     factor + y * y * growth + 6 * p1 * y + 2 * p2 * x};
  return out;
}

// Fisheye624's tangential and thin-prism terms, applied to the radially distorted point.
Mapped tangential_and_prism(const CameraModel& model, const glm::dvec2& q) {
  const auto& d = model.distortion;
  const glm::dvec2 t(d[6], d[7]);
  const double s = glm::dot(q, q), dot = 2 * glm::dot(t, q);
  Mapped out;
  out.value = q + dot * q + s * t + glm::dvec2(d[8] * s + d[9] * s * s, d[10] * s + d[11] * s * s);
  const glm::dvec2 by_s = t + glm::dvec2(d[8] + 2 * d[9] * s, d[10] + 2 * d[11] * s);
  for (int i = 0; i < 2; ++i) {
    glm::dvec2 unit(0);
    unit[i] = 1;
    out.jacobian[i] = (1 + dot) * unit + 2 * t[i] * q + 2 * q[i] * by_s;
  }
  return out;
}

// Newton's iteration on map(point) = wanted; steps are halved while they do not help.
template <typename Map>
std::optional<glm::dvec2> solve(const Map& map, const glm::dvec2& wanted, glm::dvec2 point,
                                double tolerance) {
  Mapped at = map(point);
  for (int i = 0; i < kMaxIterations; ++i) {
    const double error = glm::length(at.value - wanted);
    if (error <= tolerance) return point;
    const double determinant = glm::determinant(at.jacobian);
    if (!(std::abs(determinant) > 1e-12)) return std::nullopt;
    const glm::dvec2 step = glm::inverse(at.jacobian) * (at.value - wanted);
    double share = 1;
    for (; share > 1e-3; share *= 0.5) {
      const Mapped next = map(point - share * step);
      if (glm::length(next.value - wanted) < error) {
        point -= share * step;
        at = next;
        break;
      }
    }
    if (share <= 1e-3) return std::nullopt;
  }
  return std::nullopt;
}

// Unit direction (-Z forward, +Y up) at an angle from the axis, towards `side` of the image (y down).
glm::dvec3 direction_at(double angle_rad, const glm::dvec2& side) {
  const double length = glm::length(side);
  if (!(length > 0)) return {0, 0, -1};
  const glm::dvec2 unit = side / length;
  return {unit.x * std::sin(angle_rad), -unit.y * std::sin(angle_rad), -std::cos(angle_rad)};
}

}  // namespace

void CameraModel::prepare() {
  constexpr int kSteps = 3200;  // under 0.06 degrees each: no lens turns twice within one
  const double widest = kind == CameraModelKind::pinhole ? kWidestPinholeRad : kWidestFisheyeRad;
  const auto rises = [&](double angle) { return radial_slope(*this, radius_of_angle(*this, angle)) > 0; };
  double good = 0;
  for (int i = 1; i <= kSteps; ++i) {
    double bad = widest * i / kSteps;
    if (rises(bad)) {
      good = bad;
      continue;
    }
    for (int j = 0; j < 50; ++j) {
      const double middle = 0.5 * (good + bad);
      (rises(middle) ? good : bad) = middle;
    }
    break;
  }
  max_angle_rad = good;
}

std::optional<glm::dvec2> CameraModel::project(const glm::dvec3& direction) const {
  const glm::dvec3 d(direction.x, -direction.y, -direction.z);  // to +Z forward, y down
  const double side = std::hypot(d.x, d.y);
  const double angle = std::atan2(side, d.z);
  // A zero or broken direction has no pixel; written so that NaN fails.
  if (!(angle <= max_angle_rad) || !(side > 0 || d.z > 0)) return std::nullopt;
  glm::dvec2 point(0);
  if (kind == CameraModelKind::pinhole) {
    point = brown_conrady(*this, {d.x / d.z, d.y / d.z}).value;
  } else {
    if (side > 0) point = glm::dvec2(d.x, d.y) * (radial(*this, angle) / side);
    if (kind == CameraModelKind::fisheye624) point = tangential_and_prism(*this, point).value;
  }
  return glm::dvec2(fx * point.x + cx, fy * point.y + cy);
}

std::optional<glm::dvec3> CameraModel::unproject(const glm::dvec2& pixel) const {
  const glm::dvec2 wanted((pixel.x - cx) / fx, (pixel.y - cy) / fy);
  const double tolerance = kConvergedPx / std::max(fx, fy);
  const double widest = radius_of_angle(*this, max_angle_rad);
  if (kind != CameraModelKind::pinhole) {
    // Radial part and the rest come one after the other: undo the rest, then the radius alone.
    std::optional<glm::dvec2> point = wanted;
    if (kind == CameraModelKind::fisheye624)
      point = solve([&](const glm::dvec2& q) { return tangential_and_prism(*this, q); }, wanted, wanted,
                    tolerance);
    if (!point || !(glm::length(*point) <= radial(*this, widest))) return std::nullopt;
    return direction_at(inverse_radial(*this, glm::length(*point), widest), *point);
  }
  // Start where the lens would see it without tangential terms: near enough for Newton's
  // iteration on any real lens.
  const double reach = glm::length(wanted), start = inverse_radial(*this, reach, widest);
  const auto point = solve([&](const glm::dvec2& p) { return brown_conrady(*this, p); }, wanted,
                           reach > 0 ? wanted * (start / reach) : wanted, tolerance);
  if (!point || !(glm::length(*point) <= widest)) return std::nullopt;
  return direction_at(std::atan(glm::length(*point)), *point);
}

CameraModel pinhole_camera(int width_px, int height_px, double hfov_deg) {
  CameraModel camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx = camera.fy = width_px / (2.0 * std::tan(glm::radians(hfov_deg) / 2.0));
  camera.cx = (width_px - 1) / 2.0;
  camera.cy = (height_px - 1) / 2.0;
  camera.prepare();
  return camera;
}

}  // namespace herr
