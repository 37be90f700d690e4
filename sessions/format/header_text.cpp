#include "sessions/format/header_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "sessions/format/session_header.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

double degrees_of_tangent(double tangent) {
  return glm::degrees(std::atan(tangent));
}

Json profile_json(const DisplayProfile& profile) {
  if (builtin_display_profile(profile.name)) return profile.name;
  Json viewports = Json::array();
  for (const Viewport& viewport : profile.viewports)
    viewports.push_back({{"name", viewport.name},
                         {"eye", viewport.eye == Eye::left ? "left" : "right"},
                         {"kind", viewport.focus ? "focus" : "context"},
                         {"width_px", viewport.width_px},
                         {"height_px", viewport.height_px},
                         {"left_deg", degrees_of_tangent(viewport.tan_left)},
                         {"right_deg", degrees_of_tangent(viewport.tan_right)},
                         {"down_deg", degrees_of_tangent(viewport.tan_down)},
                         {"up_deg", degrees_of_tangent(viewport.tan_up)},
                         {"edge_blend_deg", viewport.edge_blend_deg}});
  return {{"name", profile.name}, {"display_hz", profile.display_hz}, {"viewports", viewports}};
}

const char* name_of(CameraModelKind kind) {
  switch (kind) {
    case CameraModelKind::pinhole:
      return "pinhole";
    case CameraModelKind::kb4:
      return "kb4";
    case CameraModelKind::fisheye624:
      return "fisheye624";
  }
  return "pinhole";
}

Json camera_json(const SessionHeader::Camera& camera) {
  const CameraModel& model = camera.model;
  Json json{{"model", name_of(model.kind)},
            {"width_px", model.width_px},
            {"height_px", model.height_px},
            {"fx", model.fx},
            {"fy", model.fy},
            {"cx", model.cx},
            {"cy", model.cy}};
  const std::size_t count = model.kind == CameraModelKind::pinhole ? 5
                            : model.kind == CameraModelKind::kb4   ? 4
                                                                   : 12;
  const auto end = model.distortion.begin() + static_cast<std::ptrdiff_t>(count);
  const bool ideal = std::all_of(model.distortion.begin(), end, [](double k) { return k == 0; });
  if (model.kind != CameraModelKind::pinhole || !ideal)
    json["distortion"] = std::vector<double>(model.distortion.begin(), end);
  if (camera.nominal_hz > 0) json["nominal_hz"] = camera.nominal_hz;
  const glm::dquat& q = camera.head_from_camera.orientation;
  json["head_from_camera"] = {{"position", vector_json(camera.head_from_camera.position)},
                              {"orientation_xyzw", {q.x, q.y, q.z, q.w}}};
  return json;
}

Json conversion_json(const SessionConversion& conversion) {
  Json json = Json::object();
  for (const SessionConversion::LeftOut& entry : conversion.left_out)
    json["left_out"].push_back(
        {{"stream", entry.stream}, {"rows", entry.rows}, {"of", entry.of}, {"reason", entry.reason}});
  if (!conversion.assumed.empty()) json["assumed"] = conversion.assumed;
  if (!conversion.remarks.empty()) json["remarks"] = conversion.remarks;
  if (conversion.still_head) json["still"].push_back("head");
  if (conversion.still_gaze) json["still"].push_back("gaze");
  return json;
}

}  // namespace

std::string header_text(const SessionHeader& header) {
  Json json{{"format_version", kSessionFormatVersion}, {"name", header.name}};
  if (!header.provenance.empty()) json["provenance"] = header.provenance;
  if (!header.licence.empty()) json["licence"] = header.licence;
  json["display_profile"] = profile_json(header.profile);
  json["eye_offsets"] = {{"left", vector_json(header.head_from_eye[0].position)},
                         {"right", vector_json(header.head_from_eye[1].position)}};
  json["gaze_kind"] = header.gaze_combined ? "combined" : "per_eye";
  if (header.vergence_m) json["vergence_m"] = *header.vergence_m;
  Json rates = Json::object();
  if (header.pose_hz > 0) rates["pose"] = header.pose_hz;
  if (header.gaze_hz > 0) rates["gaze"] = header.gaze_hz;
  if (!rates.empty()) json["rates_hz"] = rates;
  if (!header.scene.empty()) json["scene"] = header.scene;
  if (header.feed_distance_m) json["feed_distance_m"] = *header.feed_distance_m;
  if (!header.conversion.empty()) json["conversion"] = conversion_json(header.conversion);
  Json cameras = Json::array();
  for (const SessionHeader::Camera& camera : header.cameras) cameras.push_back(camera_json(camera));
  if (!cameras.empty()) json["cameras"] = cameras;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace herr
