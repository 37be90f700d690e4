#include "sessions/import/cameras/aria_calibration.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "sessions/files/input_error.h"
#include "sessions/files/line_reader.h"
#include "sessions/files/strict_json.h"
#include "sessions/import/cameras/camera_on_head.h"

namespace herr {
namespace {

constexpr std::size_t kMaxCalibrationBytes = 1 << 20;
// Sizes that the calibrations of Gen 1 are for: the colour camera's, and that of all others.
constexpr int kColourPx = 2880, kGreyWidthPx = 640, kGreyHeightPx = 480;
// The colour sensor has 2880 x 2880 pixels; smaller pictures are its middle 2816, two by two pixels added.
constexpr int kHalfSizePx = 1408;
constexpr double kHalfSizeMarginPx = 32;

nlohmann::json read_calibration(const std::filesystem::path& file) {
  if (file.extension() != ".jsonl") return parse_json_file(file, {kMaxCalibrationBytes, 32, 100000});
  LineReader reader(file, kMaxCalibrationBytes);
  TextLine line;
  if (!reader.next(line) || line.too_long)
    throw InputError(file, 1, "holds no calibration", "check the file");
  return parse_json_text(line.text, file, 1, {kMaxCalibrationBytes, 32, 100000});
}

// {"Translation": [x, y, z], "UnitQuaternion": [w, [x, y, z]]}
Pose parse_transform(const JsonObject& entry) {
  const nlohmann::json& q = entry.value("UnitQuaternion");
  const bool shaped = q.is_array() && q.size() == 2 && q[0].is_number() && q[1].is_array() &&
                      q[1].size() == 3 && q[1][0].is_number() && q[1][1].is_number() && q[1][2].is_number();
  if (!shaped) entry.fail("UnitQuaternion", "is not [w, [x, y, z]]", "check the file");
  const glm::dquat rotation(q[0].get<double>(), q[1][0].get<double>(), q[1][1].get<double>(),
                            q[1][2].get<double>());
  if (!(std::abs(glm::length(rotation) - 1) <= 1e-3))
    entry.fail("UnitQuaternion", "is not a unit quaternion", "check the file");
  return {entry.vec3("Translation", -1, 1), glm::normalize(rotation)};
}

CameraModel parse_model(const JsonObject& projection, const ImageSize& size) {
  CameraModel model;
  model.width_px = size.width_px;
  model.height_px = size.height_px;
  const std::string kind = projection.text("Name");
  std::size_t first = 3;
  if (kind == "FisheyeRadTanThinPrism") {
    model.kind = CameraModelKind::fisheye624;
    const auto values = projection.numbers("Params", 15, -1e5, 1e5);
    model.fx = model.fy = values[0];
    model.cx = values[1];
    model.cy = values[2];
    std::copy(values.begin() + static_cast<std::ptrdiff_t>(first), values.end(), model.distortion.begin());
  } else if (kind == "KannalaBrandtK3") {
    model.kind = CameraModelKind::kb4;
    const auto values = projection.numbers("Params", 8, -1e5, 1e5);
    model.fx = values[0];
    model.fy = values[1];
    model.cx = values[2];
    model.cy = values[3];
    std::copy(values.begin() + 4, values.end(), model.distortion.begin());
  } else {
    projection.fail("Name", "is '" + printable(kind) + "'",
                    "only FisheyeRadTanThinPrism and KannalaBrandtK3 are known");
  }
  return model;
}

void scale_to_half_size(CameraModel& model) {
  model.fx /= 2;
  model.fy /= 2;
  // A pixel's centre is a whole number, its border half a pixel away.
  model.cx = (model.cx - kHalfSizeMarginPx + 0.5) / 2 - 0.5;
  model.cy = (model.cy - kHalfSizeMarginPx + 0.5) / 2 - 0.5;
}

// Brings the model to pictures of its size; false when it was not made for them.
bool fit_to_pictures(CameraModel& model, const std::string& label) {
  if (label != "camera-rgb") return model.width_px == kGreyWidthPx && model.height_px == kGreyHeightPx;
  if (model.width_px != model.height_px) return false;
  if (model.width_px == kHalfSizePx) scale_to_half_size(model);
  return model.width_px == kHalfSizePx || model.width_px == kColourPx;
}

// The grey cameras of Gen 2 are called slam-front-left ...; those of Gen 1 camera-slam-left and
// camera-slam-right. The glasses' frame and the sizes of their pictures differ too.
void refuse_gen2(const JsonObject& root, const std::filesystem::path& file) {
  for (const JsonObject& entry : root.objects("CameraCalibrations")) {
    const std::string label = entry.text("Label");
    if (label.starts_with("slam-"))
      throw InputError(file, 0, "is a calibration of Aria Gen 2 glasses (camera '" + printable(label) + "')",
                       "only Gen 1 is known; leave --camera-calibration out and give --camera-hfov");
  }
}

}  // namespace

SessionHeader::Camera read_aria_camera(const std::filesystem::path& file, const std::string& label,
                                       const ImageSize& size, const HeadColumns& head) {
  const nlohmann::json document = read_calibration(file);
  const JsonObject root(document, file, "");
  refuse_gen2(root, file);
  std::string known;
  for (const JsonObject& entry : root.objects("CameraCalibrations")) {
    known += (known.empty() ? "" : ", ") + printable(entry.text("Label"));
    if (entry.text("Label") != label) continue;
    SessionHeader::Camera camera;
    camera.model = parse_model(entry.object("Projection"), size);
    if (!fit_to_pictures(camera.model, label))
      throw InputError(file, 0,
                       "calibrates " + label + " for pictures of another size than " +
                           std::to_string(size.width_px) + "x" + std::to_string(size.height_px),
                       "use the pictures as they were recorded");
    camera.model.prepare();
    camera.head_from_camera = camera_on_head(parse_transform(entry.object("T_Device_Camera")), head);
    return camera;
  }
  throw InputError(
      file, 0,
      known.empty() ? "lists no cameras (CameraCalibrations)" : "has no camera '" + printable(label) + "'",
      known.empty() ? "give the calibration of Project Aria glasses"
                    : "give --camera-label with one of: " + known);
}

}  // namespace herr
