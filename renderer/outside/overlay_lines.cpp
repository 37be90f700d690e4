#include "renderer/outside/overlay_lines.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

// A head of ordinary size about the middle between its eyes, metres: +X right, +Y up, +Z to the back.
constexpr glm::dvec3 kHeadLower{-0.075, -0.13, -0.01}, kHeadUpper{0.075, 0.11, 0.18};
constexpr std::size_t kBoxEdges = 12, kLinesOfEye = 3, kLinesOfFrustum = 8;

void add_head(const Pose& anchored_from_head, std::vector<OverlayLine>& lines) {
  const auto corner = [&](unsigned bits) {
    const glm::dvec3 at{bits & 1u ? kHeadUpper.x : kHeadLower.x, bits & 2u ? kHeadUpper.y : kHeadLower.y,
                        bits & 4u ? kHeadUpper.z : kHeadLower.z};
    return anchored_from_head(at);
  };
  for (unsigned bits = 0; bits < 8; ++bits) {
    for (const unsigned axis : {1u, 2u, 4u}) {
      if (bits & axis) continue;
      lines.push_back({corner(bits), corner(bits | axis), kHeadColour, kThinLine});
    }
  }
}

void add_eye(const EyeView& eye, double gaze_m, std::vector<OverlayLine>& lines) {
  const glm::dvec3 at = eye.anchored_from_eye.position;
  const glm::dvec3 end = eye.anchored_from_eye(gaze_m * eye.gaze.gaze);
  lines.push_back({at, end, kGazeColour, kGazeLine});
  lines.push_back({end, end, kGazeColour, kDot});
  lines.push_back({at, at, kHeadColour, kDot});
}

void add_frustum(const Viewport& v, const Pose& anchored_from_eye, double far_m,
                 std::vector<OverlayLine>& lines) {
  const ShownColour colour = v.focus ? kFocusColour : kContextColour;
  const std::array<glm::dvec3, 4> corners{anchored_from_eye(far_m * glm::dvec3{v.tan_left, v.tan_down, -1}),
                                          anchored_from_eye(far_m * glm::dvec3{v.tan_right, v.tan_down, -1}),
                                          anchored_from_eye(far_m * glm::dvec3{v.tan_right, v.tan_up, -1}),
                                          anchored_from_eye(far_m * glm::dvec3{v.tan_left, v.tan_up, -1})};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    lines.push_back({anchored_from_eye.position, corners[i], colour, kThinLine});
    lines.push_back({corners[i], corners[(i + 1) % corners.size()], colour, kThinLine});
  }
}

}  // namespace

std::size_t most_overlay_lines(std::size_t viewports) {
  return kBoxEdges + kEyes.size() * kLinesOfEye + viewports * kLinesOfFrustum;
}

void overlay_lines(const OverlaySubject& subject, std::vector<OverlayLine>& lines) {
  lines.clear();
  add_head(subject.anchored_from_head, lines);
  for (const bool focus : {false, true}) {
    for (const Viewport& viewport : subject.viewports) {
      if (viewport.focus != focus) continue;
      const EyeView& eye = subject.eyes[static_cast<std::size_t>(viewport.eye)];
      add_frustum(viewport, eye.anchored_from_eye, subject.frusta_m, lines);
    }
  }
  for (const Eye eye : kEyes) {
    const bool shown = std::any_of(subject.viewports.begin(), subject.viewports.end(),
                                   [eye](const Viewport& viewport) { return viewport.eye == eye; });
    const auto e = static_cast<std::size_t>(eye);
    if (shown) add_eye(subject.eyes[e], subject.gaze_m[e], lines);
  }
}

}  // namespace herr
