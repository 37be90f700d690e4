// How well camera feed and virtual objects agree in one frame. Both are drawn from the head's pose as used;
// the feed is re-projected from the pose of its exposure as if it lay on a sphere about the eye. That undoes
// every turn of the head since then exactly; what remains is parallax, since eye and camera stood at
// different places. Before: FrameSample. After: FrameRecord, frames.csv, /v1/latency.
#pragma once

#include <optional>
#include <span>

#include "sessions/session.h"

namespace herr {

// Arc minutes, of the eye where each is larger.
struct FeedRegistration {
  double turn_arcmin = 0;   // of the camera between exposure and the pose used: undone by re-projection
  double shift_arcmin = 0;  // asin(m / D): m metres that the camera has moved since exposure
  // Angle between where a feed pixel is shown and where its surface truly is, both seen from the eye, for a
  // far surface: asin(b / D) at most, b metres from the eye to the camera at exposure. (The ray through the
  // pixel passes the eye at a distance h <= b. Its point at distance d lies asin(h / d) off the ray's own
  // direction, so a surface at d is shown |asin(h / D) - asin(h / d)| beside its place.)
  double misregistration_arcmin = 0;
};

// D: distance that the feed is taken to have, metres. None without a camera image.
std::optional<FeedRegistration> feed_registration(const FrameSample& sample,
                                                  std::span<const SessionHeader::Camera> cameras,
                                                  double feed_distance_m);

}  // namespace herr
