#include "server/inspect/acuity/acuity_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "renderer/foveation/gaze_frame.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/recorded_gaze.h"

namespace herr {
namespace {

constexpr int kPoints = 69;      // of the curves, evenly along the polar radius
constexpr int kDirections = 64;  // around a circle, to find the finest viewport on it

bool has_viewport(const DisplayProfile& profile, Eye eye) {
  return std::any_of(profile.viewports.begin(), profile.viewports.end(),
                     [&](const Viewport& v) { return v.eye == eye; });
}

// The local density of a plane, along the way from its middle: that grows with 1 / cos^2.
double pixels_per_degree(const Viewport& v, double tan_x, double tan_y) {
  const double per_tan =
      std::max(v.width_px / (v.tan_right - v.tan_left), v.height_px / (v.tan_up - v.tan_down));
  return per_tan * (1.0 + tan_x * tan_x + tan_y * tan_y) / kDegreesPerRadian;
}

double display_density(const DisplayProfile& profile, Eye eye, const GazeFrame& gaze, double theta_deg) {
  double finest = 0;
  const double theta = theta_deg / kDegreesPerRadian;
  for (int i = 0; i < kDirections; ++i) {
    const double phi = phi_from_v(static_cast<double>(i) / kDirections);
    const glm::dvec3 direction = std::cos(theta) * gaze.gaze +
                                 std::sin(theta) * (std::cos(phi) * gaze.right + std::sin(phi) * gaze.up);
    if (!(direction.z < 0)) continue;
    const double x = direction.x / -direction.z, y = direction.y / -direction.z;
    for (const Viewport& v : profile.viewports) {
      const bool inside =
          v.eye == eye && x >= v.tan_left && x <= v.tan_right && y >= v.tan_down && y <= v.tan_up;
      if (inside) finest = std::max(finest, pixels_per_degree(v, x, y));
    }
  }
  return finest;
}

// The corner of the eye's viewports that is farthest from straight ahead.
glm::dvec3 farthest_corner(const DisplayProfile& profile, Eye eye) {
  glm::dvec3 farthest{0, 0, -1};
  for (const Viewport& v : profile.viewports) {
    if (v.eye != eye) continue;
    for (const double x : {v.tan_left, v.tan_right}) {
      for (const double y : {v.tan_down, v.tan_up}) {
        if (std::hypot(x, y) > std::hypot(farthest.x, farthest.y)) farthest = {x, y, -1};
      }
    }
  }
  return farthest;
}

AcuityOfGaze acuity_of(const RenderSettings& settings, const DisplayProfile& profile, Eye eye,
                       const glm::dvec3& gaze_in_eye) {
  AcuityOfGaze of;
  of.eye = eye;
  of.theta_max_deg = theta_max_deg(gaze_frame(gaze_in_eye), profile.viewports, eye);
  of.columns = polar_columns(settings, of.theta_max_deg);
  of.rows = settings.polar_height;
  of.reached = reached_acuity(of.theta_max_deg, of.columns, of.rows);
  return of;
}

std::vector<AcuityPoint> curve_of(const AcuityOfGaze& of, const DisplayProfile& profile) {
  const PolarMap map = PolarMap::up_to(of.theta_max_deg);
  std::vector<AcuityPoint> points;
  for (int i = 0; i <= kPoints; ++i) {
    AcuityPoint point;
    point.theta_deg = i == kPoints ? of.theta_max_deg : map.theta_from_u(static_cast<double>(i) / kPoints);
    point.asked = acuity_per_degree(point.theta_deg);
    point.radial = map.radial_density(point.theta_deg, of.columns);
    const bool is_circle = i > 0 && point.theta_deg < 180;
    if (is_circle) point.angular = PolarMap::angular_density(point.theta_deg, of.rows);
    // The border itself: a hair within, since rounding may put it outside.
    const double within = i == kPoints ? point.theta_deg * (1 - 1e-9) : point.theta_deg;
    point.display = display_density(profile, of.eye, GazeFrame{}, within);
    points.push_back(point);
  }
  return points;
}

}  // namespace

std::optional<AcuityFacts> acuity_facts(const RenderSettings& settings, const DisplayProfile& profile) {
  if (settings.foveation == Foveation::off) return std::nullopt;
  AcuityFacts facts;
  for (const bool corner : {false, true}) {
    for (const Eye eye : kEyes) {
      if (!has_viewport(profile, eye)) continue;
      const glm::dvec3 gaze = corner ? farthest_corner(profile, eye) : glm::dvec3{0, 0, -1};
      facts.gazes.push_back(acuity_of(settings, profile, eye, gaze));
      facts.gazes.back().gaze = corner ? "at the farthest corner" : "straight ahead";
    }
  }
  if (facts.gazes.empty()) return std::nullopt;
  facts.ahead = curve_of(facts.gazes.front(), profile);
  return facts;
}

void add_recorded_acuity(const RenderSettings& settings, const DisplayProfile& profile,
                         const SessionInspection& session, const FrameRange& frames, AcuityFacts& facts) {
  if (!session.header) return;
  AcuityOfFrames of;
  try {
    GazeSampler gaze = recorded_gaze(session.folder, *session.header, session.gaze.has_value());
    for (std::int64_t i = 0; i < frames.count; ++i) {
      const SampledGaze sampled = gaze.at(frames.time_ns(frames.first + i));
      double farthest = 0;
      std::optional<ReachedAcuity> least;
      for (const Eye eye : kEyes) {
        if (!has_viewport(profile, eye)) continue;
        const auto e = static_cast<std::size_t>(eye);
        const AcuityOfGaze seen = acuity_of(
            settings, profile, eye,
            glm::conjugate(session.header->head_from_eye[e].orientation) * sampled.head_direction[e]);
        farthest = std::max(farthest, seen.theta_max_deg);
        if (!least) least = seen.reached;
        least->k_radial = std::min(least->k_radial, seen.reached.k_radial);
        least->k_angular = std::min(least->k_angular, seen.reached.k_angular);
      }
      if (!least) return;
      of.theta_max.add_ms(farthest);
      of.k_radial.add_ms(least->k_radial);
      of.k_angular.add_ms(least->k_angular);
    }
  } catch (const InputError&) {
    return;  // what cannot be read is among the findings
  }
  if (of.k_radial.count() > 0) facts.frames = of;
}

}  // namespace herr
