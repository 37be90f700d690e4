// How bright pictures are shown: a value times 2^ev, as stops of a camera; 1 is then white. Pictures that
// keep scene values (EXR) are not multiplied, they name it. Before: a scene document or a setting. After: the
// renderer, which shows the camera feed with its white at 2^-ev, and whatever turns radiance into 8 bits.
#pragma once

#include <cmath>

namespace herr {

inline constexpr double kMostExposure_ev = 15;  // and -15 at least: half floats end at 2^16

struct Exposure {
  bool automatic = false;  // whoever renders chooses `ev` by the first frame of a session
  double ev = 0;           // -kMostExposure_ev ... kMostExposure_ev

  float scale() const { return static_cast<float>(std::exp2(ev)); }
  bool operator==(const Exposure&) const = default;
};

}  // namespace herr
