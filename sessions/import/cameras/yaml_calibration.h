// Cameras of the calibrations that EuRoC (ASL) and Kalibr write in YAML.
// Before: yaml_document. After: camera_calibration.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sessions/camera/camera_image.h"
#include "sessions/format/session_header.h"
#include "sessions/import/map/column_map.h"

namespace herr {

bool is_euroc_sensor(const nlohmann::json& document);  // sensor.yaml: T_BS, intrinsics
bool is_kalibr_chain(const nlohmann::json& document);  // camchain.yaml: cam0, cam1 ...

// For pictures of `size`, on a head that `head` describes. T_BS is body_from_camera, T_cam_imu
// camera_from_body. Throw InputError that names the field.
SessionHeader::Camera read_euroc_camera(const nlohmann::json& document, const std::filesystem::path& file,
                                        const ImageSize& size, const HeadColumns& head);
SessionHeader::Camera read_kalibr_camera(const nlohmann::json& document, const std::filesystem::path& file,
                                         const std::string& label, const ImageSize& size,
                                         const HeadColumns& head);

}  // namespace herr
