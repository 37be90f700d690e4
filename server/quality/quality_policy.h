// How the quality of each frame is chosen, and what was decided for one: the words of this folder.
// Before: the command line names a policy. After: QualityController decides, FrameRecord keeps each decision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "renderer/renderer.h"

namespace herr {

// Neither: every frame has the quality that the settings ask for (`fixed`).
struct QualityPolicy {
  bool motion = false;    // narrow and hard while the head moves fast: reproducible
  bool deadline = false;  // whatever holds a frame time: depends on the machine

  bool operator==(const QualityPolicy&) const = default;
};
const char* name_of(QualityPolicy policy);

// What a policy may choose from. A frame has at least one light sample.
struct QualityLimits {
  FrameQuality full;      // as the settings ask for
  int narrowest = 1;      // polar width per eye
  int lowest = 0;         // polar height, even; that of `full`: it never changes
  int fewest_probes = 0;  // updated in a frame; 0 without probes
};

// The width that policies do not go below when nobody says another: an eighth.
int default_narrowest(int full_width);
// The height that they do not go below: a quarter, even. Samples of an eighth of the columns and a quarter of
// the rows are about as far from each other along the radius as around the circle.
int default_lowest(int full_height);
// A sixteenth of the probes may wait in turn: what they know is then up to 16 frames old.
QualityLimits quality_limits(const FrameQuality& full, int narrowest, int lowest);
// With a height that never changes.
QualityLimits quality_limits(const FrameQuality& full, int narrowest);

// Why a frame has the quality that it has.
enum class QualityReason : std::uint8_t {
  fixed,           // policy fixed
  head_still,      // motion: all of it
  head_moving,     // motion: less, by how fast the head moves
  start,           // deadline: no frame has told yet what it costs; as little as possible
  full,            // deadline: all that may be had fits
  steady,          // as the frame before: what would fit is within the dead band
  grow,            // more fits
  grow_limited,    // more than twice the size fits; it grows to twice
  hold,            // more would fit, but a frame was missed just before
  shrink,          // less fits
  overload,        // frames were missed in a row: less than the cost model says
  less_light,      // fewer light samples or probes, or the size would fall below half
  more_light,      // more light samples or probes: they have fitted for a while
  floor,           // as little as allowed, and that should fit
  floor_too_slow,  // as little as allowed, and even that is foretold to exceed the target
};
inline constexpr std::size_t kQualityReasons = 15;
const char* name_of(QualityReason reason);
// As little as allowed, whatever is foretold of it; not the start, of which nothing is known.
inline bool is_floor(QualityReason reason) {
  return reason == QualityReason::floor || reason == QualityReason::floor_too_slow;
}

struct QualityDecision {
  FrameQuality quality;
  QualityReason reason = QualityReason::fixed;
  std::optional<double> predicted_ms;  // deadline: what the frame should take
  std::optional<double> aim_ms;        // deadline: the target less head-room
};

}  // namespace herr
