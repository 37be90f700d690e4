#include "sessions/import/cameras/yaml_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>
#include <span>

#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"
#include "sessions/import/cameras/camera_on_head.h"

namespace herr {
namespace {

constexpr double kRigidTolerance = 1e-3;
constexpr double kFarthestCamera_m = 10;

// Names of the same things in the two formats.
struct YamlNames {
  const char* distortion;
  const char* rate;  // null: there is none
};

void parse_yaml_lens(const JsonObject& entry, const YamlNames& names, CameraModel& model) {
  const std::string camera = entry.text_or("camera_model", "pinhole");
  if (camera != "pinhole")
    entry.fail("camera_model", "is '" + printable(camera) + "'", "only pinhole is known");
  const std::string kind = entry.text("distortion_model");
  if (kind == "radial-tangential" || kind == "radtan" || kind == "plumb_bob")
    model.kind = CameraModelKind::pinhole;
  else if (kind == "equidistant")
    model.kind = CameraModelKind::kb4;
  else if (kind != "none")
    entry.fail("distortion_model", "is '" + printable(kind) + "'",
               "known: radial-tangential, radtan, equidistant, none");
  const std::vector<double> lens = entry.numbers("intrinsics", 4, -1e5, 1e5);
  model.fx = lens[0];
  model.fy = lens[1];
  model.cx = lens[2];
  model.cy = lens[3];
  if (!(model.fx >= 1 && model.fy >= 1))
    entry.fail("intrinsics", "have a focal length below a pixel", "write fx, fy, cx, cy in pixels");
  if (kind == "none") return;
  // k1 k2 p1 p2, with k3 where there are five.
  const nlohmann::json& list = entry.value(names.distortion);
  const bool five = model.kind == CameraModelKind::pinhole && list.is_array() && list.size() == 5;
  const std::vector<double> k = entry.numbers(names.distortion, five ? 5 : 4, -1000, 1000);
  std::copy(k.begin(), k.end(), model.distortion.begin());
}

void check_yaml_size(const JsonObject& entry, const ImageSize& size) {
  const std::vector<double> resolution = entry.numbers("resolution", 2, 1, 16384);
  if (resolution[0] == size.width_px && resolution[1] == size.height_px) return;
  const auto text = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  entry.fail("resolution",
             "is " + text(static_cast<int>(resolution[0]), static_cast<int>(resolution[1])) +
                 ", and the pictures are " + text(size.width_px, size.height_px),
             "use the pictures as they were recorded, or the calibration of this camera");
}

// 16 numbers, row by row.
Pose rigid_pose(const JsonObject& entry, const char* key, std::span<const double> m) {
  glm::dmat3 turn;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      turn[column][row] = m[static_cast<std::size_t>(4 * row + column)];
  const glm::dmat3 off = glm::transpose(turn) * turn - glm::dmat3(1.0);
  double worst = std::abs(glm::determinant(turn) - 1);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) worst = std::max(worst, std::abs(off[i][j]));
  const bool last_row = m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1;
  if (!(worst <= kRigidTolerance) || !last_row)
    entry.fail(key, "is no rotation and translation", "write 4 rows of 4 numbers, the last 0 0 0 1");
  const glm::dvec3 position(m[3], m[7], m[11]);
  if (!(glm::length(position) <= kFarthestCamera_m))
    entry.fail(key, "puts the camera more than 10 m from the body", "translations are in metres");
  return {position, glm::normalize(glm::quat_cast(turn))};
}

// A list of four lists, or of 16 numbers.
std::vector<double> matrix_numbers(const JsonObject& entry, const char* key) {
  const nlohmann::json& rows = entry.value(key);
  const bool flat = rows.is_array() && !rows.empty() && rows[0].is_number();
  if (flat) return entry.numbers(key, 16, -1e6, 1e6);
  std::vector<double> m;
  const bool four = rows.is_array() && rows.size() == 4;
  for (std::size_t row = 0; four && row < 4; ++row)
    for (const nlohmann::json& number : rows[row])
      if (number.is_number()) m.push_back(number.get<double>());
  if (m.size() != 16) entry.fail(key, "is no matrix of 4 rows of 4 numbers", "check the file");
  return m;
}

SessionHeader::Camera yaml_camera(const JsonObject& entry, const YamlNames& names, const ImageSize& size) {
  SessionHeader::Camera camera;
  check_yaml_size(entry, size);
  camera.model.width_px = size.width_px;
  camera.model.height_px = size.height_px;
  parse_yaml_lens(entry, names, camera.model);
  camera.model.prepare();
  if (names.rate != nullptr) camera.nominal_hz = entry.number_or(names.rate, 0.001, 10000, 0);
  return camera;
}

std::string names_of_cameras(const nlohmann::json& document) {
  std::string names;
  for (const auto& [key, value] : document.items())
    if (key.starts_with("cam")) names += (names.empty() ? "" : ", ") + printable(key);
  return names;
}

}  // namespace

bool is_euroc_sensor(const nlohmann::json& document) {
  return document.is_object() && document.contains("T_BS") && document.contains("intrinsics");
}

bool is_kalibr_chain(const nlohmann::json& document) {
  return document.is_object() && document.contains("cam0") && document["cam0"].is_object() &&
         document["cam0"].contains("intrinsics");
}

SessionHeader::Camera read_euroc_camera(const nlohmann::json& document, const std::filesystem::path& file,
                                        const ImageSize& size, const HeadColumns& head) {
  const JsonObject root(document, file, "");
  SessionHeader::Camera camera = yaml_camera(root, {"distortion_coefficients", "rate_hz"}, size);
  const Pose body_from_camera =
      root.value("T_BS").is_object()
          ? rigid_pose(root, "T_BS", root.object("T_BS").numbers("data", 16, -1e6, 1e6))
          : rigid_pose(root, "T_BS", matrix_numbers(root, "T_BS"));
  camera.head_from_camera = camera_on_head(body_from_camera, head);
  return camera;
}

SessionHeader::Camera read_kalibr_camera(const nlohmann::json& document, const std::filesystem::path& file,
                                         const std::string& label, const ImageSize& size,
                                         const HeadColumns& head) {
  const JsonObject root(document, file, "");
  if (!root.has(label.c_str()))
    throw InputError(file, 0, "has no camera '" + printable(label) + "'",
                     "give --camera-label with one of: " + names_of_cameras(document));
  const JsonObject entry = root.object(label.c_str());
  SessionHeader::Camera camera = yaml_camera(entry, {"distortion_coeffs", nullptr}, size);
  if (!entry.has("T_cam_imu"))
    entry.fail("T_cam_imu", "is missing: where the camera sits on the body is unknown",
               "give the file of Kalibr's calibration of cameras and IMU (camchain-imucam.yaml)");
  camera.head_from_camera =
      camera_on_head(inverse(rigid_pose(entry, "T_cam_imu", matrix_numbers(entry, "T_cam_imu"))), head);
  return camera;
}

}  // namespace herr
