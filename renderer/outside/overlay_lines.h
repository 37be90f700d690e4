// What the picture of an outside camera shows of the headset, as lines in space: the head, where each eye
// looks, and the frusta of the viewports. Before: the eyes of this frame, and how far their gaze reaches.
// After: line_drawing draws them.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "renderer/foveation/ray_grids.h"
#include "renderer/outside_view.h"
#include "sessions/format/display_profile.h"

namespace herr {

// Metres from the anchor; a dot where both ends are one.
struct OverlayLine {
  glm::dvec3 from, to;
  ShownColour colour;
  double width = 1;  // against that of thin lines
};

// The length of a gaze that meets nothing.
inline constexpr double kEndlessGaze_m = 5;

inline constexpr ShownColour kHeadColour{0xff, 0xff, 0xff}, kGazeColour{0xff, 0x28, 0x28},
    kContextColour{0x38, 0xb6, 0xff}, kFocusColour{0xff, 0xd0, 0x20};
inline constexpr double kThinLine = 1, kGazeLine = 1.5, kDot = 4;

struct OverlaySubject {
  Pose anchored_from_head;
  std::array<EyeView, 2> eyes;
  std::array<double, 2> gaze_m{kEndlessGaze_m, kEndlessGaze_m};  // from each eye to where it looks
  std::span<const Viewport> viewports;
  double frusta_m = 1;  // to the far rectangles, along the axis of each eye
};

// At most so many for this many viewports.
std::size_t most_overlay_lines(std::size_t viewports);

// Fills `lines`: the head as a box that the eyes look out of, a dot for each eye that has a viewport, its
// gaze with a dot at the end, then four edges and the far rectangle of each viewport, context before focus.
void overlay_lines(const OverlaySubject& subject, std::vector<OverlayLine>& lines);

}  // namespace herr
