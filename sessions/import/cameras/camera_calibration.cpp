#include "sessions/import/cameras/camera_calibration.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/import/cameras/aria_calibration.h"
#include "sessions/import/cameras/yaml_calibration.h"
#include "sessions/import/cameras/yaml_document.h"

namespace herr {
namespace {

// JSON begins with a brace, and none of the YAML files does.
bool is_json(const std::filesystem::path& file) {
  std::array<char, 256> bytes{};
  InputFile opened(file);
  std::string_view start(bytes.data(), opened.read(bytes.data(), bytes.size()));
  if (start.starts_with("\xef\xbb\xbf")) start.remove_prefix(3);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && start[first] == '{';
}

std::string aria_label(const std::filesystem::path& file, const CalibratedCamera& which) {
  if (!which.label.empty()) return which.label;
  if (which.index > 0)
    throw InputError(file, 0, "does not say which of its cameras the second feed is",
                     "give --camera-label, once for each --camera");
  return "camera-rgb";
}

}  // namespace

SessionHeader::Camera read_camera_calibration(const std::filesystem::path& file,
                                              const CalibratedCamera& which, const ImageSize& size,
                                              const HeadColumns& head) {
  if (is_json(file)) return read_aria_camera(file, aria_label(file, which), size, head);
  const nlohmann::json document = read_yaml_file(file);
  if (is_euroc_sensor(document)) {
    if (!which.label.empty())
      throw InputError(file, 0, "is an EuRoC sensor.yaml, which describes one camera",
                       "leave --camera-label out");
    return read_euroc_camera(document, file, size, head);
  }
  if (is_kalibr_chain(document)) {
    const std::string label = which.label.empty() ? "cam" + std::to_string(which.index) : which.label;
    return read_kalibr_camera(document, file, label, size, head);
  }
  throw InputError(
      file, 0, "is no calibration of a known kind",
      "known are Project Aria's JSON (CameraCalibrations), EuRoC's sensor.yaml (T_BS, intrinsics) and "
      "Kalibr's camchain.yaml (cam0: intrinsics, T_cam_imu)");
}

}  // namespace herr
