// The lens of a camera and its place on the head from a calibration file, whichever of the known kinds it is.
// Before: a file, `herr convert --camera-calibration`. After: session.json's cameras.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "sessions/camera/camera_image.h"
#include "sessions/format/session_header.h"
#include "sessions/import/map/column_map.h"

namespace herr {

// Which camera of a file: by its label, or where that is empty by its place among the feeds (0, 1). An EuRoC
// file has one; Kalibr's are cam0 and cam1; Aria's first is camera-rgb.
struct CalibratedCamera {
  std::string label;
  std::size_t index = 0;
};

// Kinds: Project Aria's JSON, EuRoC's sensor.yaml, Kalibr's camchain.yaml, told apart by what they hold. For
// pictures of `size`, on a head that `head` describes. Throws InputError, also when the calibration is for
// another size.
SessionHeader::Camera read_camera_calibration(const std::filesystem::path& file,
                                              const CalibratedCamera& which, const ImageSize& size,
                                              const HeadColumns& head);

}  // namespace herr
