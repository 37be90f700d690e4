// Which acuity a polar buffer reaches, and which buffer reaches the acuity function f = 200 / (theta + 1).
// k at theta is (samples per degree at theta) * (theta + 1): f has 200 everywhere. Along the radius it is the
// same at every theta, since the map is logarithmic; around the circle it is least where circles are longest
// against theta + 1, at 21.0 degrees off the gaze, or at the border of a display that ends before. Before:
// theta_max of a frame and eye. After: set_up_rays; frames.csv, summary and `herr inspect`. Source: paper,
// equation 1 and section 3.2.
#pragma once

#include "renderer/foveation/polar_map.h"
#include "renderer/render_settings.h"

namespace herr {

// Samples per degree that the acuity function asks for.
inline double acuity_per_degree(double theta_deg) {
  return kAcuityPixelsPerDegree / (theta_deg + 1.0);
}

// Fewest columns that reach it along the radius up to theta_max, (0, 180] degrees: ceil(200 ln(theta_max +
// 1)).
int acuity_width(double theta_max_deg);
// Fewest rows, an even number, that reach it around every circle up to theta_max: of the largest 72000
// sin(theta) / (theta + 1). 1174 from 21.0 degrees on, 1138 still at 10: one number serves every display.
int acuity_height(double theta_max_deg);

// Columns of a buffer up to theta_max, [0, 180] degrees, when the frame has all that the settings ask for.
int polar_columns(const RenderSettings& settings, double theta_max_deg);

struct ReachedAcuity {
  double k_radial = 0;          // samples per degree at theta = 0; theta + 1 times less at theta
  double k_angular = 0;         // the least of all circles up to theta_max
  double k_angular_at_deg = 0;  // its eccentricity
};

// Of a buffer of `width` x `height` samples up to theta_max, (0, 180] degrees.
ReachedAcuity reached_acuity(double theta_max_deg, int width, int height);
// Around the circle of eccentricity theta, (0, 180) degrees.
double k_angular_at(double theta_deg, int height);

}  // namespace herr
