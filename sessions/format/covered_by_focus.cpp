#include "sessions/format/covered_by_focus.h"

#include <cmath>
#include <glm/trigonometric.hpp>

namespace herr {
namespace {

// Whether the angle between two borders is `blend` or more, tan(blend) <= 1. Angles are those along the axis:
// a border is a straight line in the picture, and so is the inner end of its blend.
bool apart(double tan_low, double tan_high, double tan_blend) {
  const double forward = 1 + tan_low * tan_high;  // cosine of that angle, times a positive number
  return forward <= 0 || tan_high - tan_low >= tan_blend * forward;
}

bool within_blend(const Viewport& v, double tan_x, double tan_y) {
  if (tan_x < v.tan_left || tan_x > v.tan_right || tan_y < v.tan_down || tan_y > v.tan_up) return false;
  const double tan_blend = std::tan(glm::radians(v.edge_blend_deg));
  return apart(v.tan_left, tan_x, tan_blend) && apart(tan_x, v.tan_right, tan_blend) &&
         apart(v.tan_down, tan_y, tan_blend) && apart(tan_y, v.tan_up, tan_blend);
}

}  // namespace

bool covered_by_focus(const DisplayProfile& profile, std::size_t viewport, double tan_x, double tan_y) {
  const Viewport& own = profile.viewports.at(viewport);
  if (own.focus) return false;
  for (const Viewport& v : profile.viewports) {
    if (v.focus && v.eye == own.eye && within_blend(v, tan_x, tan_y)) return true;
  }
  return false;
}

}  // namespace herr
