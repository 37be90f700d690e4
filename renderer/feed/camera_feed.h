// A camera image in the form that the composite fetches from.
#pragma once

#include "sessions/camera/camera_image.h"

namespace herr {

// The image itself, or - when a side has a single pixel - a copy in `storage` with that pixel repeated, so
// that a bilinear fetch always has a right and a lower neighbour.
const CameraImage* at_least_2x2(const CameraImage& image, CameraImage& storage);

}  // namespace herr
