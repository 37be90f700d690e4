// An equirectangular picture of the light that comes from outside the scene, as the kernels read it.
// Before: scenes/ decodes the file. After: lighting/environment-inl.h looks directions up.
#pragma once

namespace herr {

// Row 0 lies at the zenith. Columns run clockwise as seen from above; the middle of the picture lies `turn`
// turns counter-clockwise of -Z of the world.
struct EnvironmentRecord {
  const float* texels = nullptr;  // four floats each: R, G, B, unused; null: there is no picture
  int width = 0, height = 0;
  float turn = 0;  // [0, 1)
};

}  // namespace herr
