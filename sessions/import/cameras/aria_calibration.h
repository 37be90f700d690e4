// Cameras of Project Aria glasses from the calibration that comes with a recording (calib.json of the device,
// or online_calibration.jsonl of the machine perception services, of which the first line is read: it drifts
// by less than a pixel). Before: a JSON file. After: session.json's intrinsics and head_from_camera.
#pragma once

#include <filesystem>
#include <string>

#include "sessions/camera/camera_image.h"
#include "sessions/format/session_header.h"
#include "sessions/import/map/column_map.h"

namespace herr {

// The camera called `label` ("camera-rgb"), for pictures of `size`, on a head that `head` describes: its
// body_from_head places it in the device. Throws InputError, also when the calibration is for another size
// (the colour camera's half-size pictures of 1408 pixels are known).
SessionHeader::Camera read_aria_camera(const std::filesystem::path& file, const std::string& label,
                                       const ImageSize& size, const HeadColumns& head);

}  // namespace herr
