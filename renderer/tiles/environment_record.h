// An equirectangular picture of the light that comes from outside the scene, as the kernels read it.
// Before: scenes/ decodes the file. After: lighting/environment-inl.h looks directions up.
#pragma once

namespace herr {

// Row 0 lies at the zenith. Column 0 begins at the azimuth `turn` (in turns) and columns run clockwise as
// seen from above, so that -Z of the world is the middle of an unturned picture.
struct EnvironmentRecord {
  const float* texels = nullptr;  // four floats each: R, G, B, unused; null: there is no picture
  int width = 0, height = 0;
  float turn = 0;  // [0, 1)
};

}  // namespace herr
