#include "sessions/format/session_header.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr double kDefaultHalfIpdM = 0.0315;
constexpr double kFarthestEye_m = 1e9;  // a session may be scaled with its scene
// Adults' pupils are 50 to 78 mm apart; children's from 40 mm.
constexpr double kNarrowestIpdM = 0.040, kWidestIpdM = 0.085;
// 2 degrees: a lens model that turns back there is a typo.
constexpr double kNarrowestLensRad = 0.0349065850398866;

CameraModelKind parse_kind(const JsonObject& entry) {
  const std::string word = entry.text("model");
  if (word == "pinhole") return CameraModelKind::pinhole;
  if (word == "kb4") return CameraModelKind::kb4;
  if (word == "fisheye624") return CameraModelKind::fisheye624;
  const std::string nearest = nearest_name(word, {"pinhole", "kb4", "fisheye624"});
  entry.fail("model", "is '" + printable(word) + "'",
             (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                 std::string("Known: pinhole, kb4, fisheye624"));
}

void parse_distortion(const JsonObject& entry, CameraModel& model) {
  const bool pinhole = model.kind == CameraModelKind::pinhole;
  if (pinhole && !entry.has("distortion")) return;
  const nlohmann::json& list = entry.value("distortion");
  std::size_t count = pinhole ? 5 : model.kind == CameraModelKind::kb4 ? 4 : 12;
  // OpenCV writes four numbers (k1 k2 p1 p2) when k3 is 0, and none for an ideal pinhole.
  if (pinhole && list.is_array() && (list.empty() || list.size() == 4)) count = list.size();
  const std::vector<double> values = entry.numbers("distortion", count, -1000, 1000);
  std::copy(values.begin(), values.end(), model.distortion.begin());
}

CameraModel parse_model(const JsonObject& entry) {
  CameraModel model;
  model.kind = parse_kind(entry);
  model.width_px = static_cast<int>(entry.integer("width_px", 1, 16384));
  model.height_px = static_cast<int>(entry.integer("height_px", 1, 16384));
  model.fx = entry.number("fx", 1, 1e6);
  model.fy = entry.number("fy", 1, 1e6);
  model.cx = entry.number("cx", -model.width_px, 2.0 * model.width_px);
  model.cy = entry.number("cy", -model.height_px, 2.0 * model.height_px);
  parse_distortion(entry, model);
  model.prepare();
  if (model.max_angle_rad < kNarrowestLensRad)
    entry.fail("distortion", "turns the image back within 2 degrees of the axis",
               "check the order and the signs");
  return model;
}

Pose parse_pose(const JsonObject& entry) {
  entry.allow_only({"position", "orientation_xyzw"});
  Pose pose;
  pose.position = entry.vec3("position", -10, 10);
  const std::array<double, 4> q = entry.unit_quaternion("orientation_xyzw");
  const glm::dquat orientation(q[3], q[0], q[1], q[2]);
  pose.orientation = orientation / glm::length(orientation);
  return pose;
}

SessionHeader::Camera parse_camera(const JsonObject& entry) {
  entry.allow_only({"model", "width_px", "height_px", "fx", "fy", "cx", "cy", "distortion", "nominal_hz",
                    "head_from_camera"});
  SessionHeader::Camera camera;
  camera.model = parse_model(entry);
  camera.nominal_hz = entry.number_or("nominal_hz", 0.001, 10000, 0);
  camera.head_from_camera = parse_pose(entry.object("head_from_camera"));
  return camera;
}

void parse_eyes(const JsonObject& root, ParsedSessionHeader& parsed) {
  auto& eyes = parsed.header.head_from_eye;
  eyes[0].position = {-kDefaultHalfIpdM, 0, 0};
  eyes[1].position = {kDefaultHalfIpdM, 0, 0};
  if (!root.has("eye_offsets")) return;
  const JsonObject offsets = root.object("eye_offsets");
  offsets.allow_only({"left", "right"});
  eyes[0].position = offsets.vec3("left", -kFarthestEye_m, kFarthestEye_m);
  eyes[1].position = offsets.vec3("right", -kFarthestEye_m, kFarthestEye_m);
  const double ipd_m = glm::distance(eyes[0].position, eyes[1].position);
  if (eyes[0].position.x > eyes[1].position.x)
    parsed.warnings.emplace_back(root.file(), 0, "eye_offsets.left lies right of eye_offsets.right",
                                 "are the eyes swapped?");
  if (ipd_m < kNarrowestIpdM || ipd_m > kWidestIpdM)
    parsed.warnings.emplace_back(
        root.file(), 0, "eye_offsets are " + shown_number(std::round(ipd_m * 1e9) / 1e6) + " mm apart",
        "eyes are 40 to 85 mm apart, offsets are in metres");
}

void parse_gaze(const JsonObject& root, SessionHeader& header) {
  const std::string kind = root.text("gaze_kind");
  if (kind != "per_eye" && kind != "combined")
    root.fail("gaze_kind", "is '" + printable(kind) + "'", "write per_eye or combined");
  header.gaze_combined = kind == "combined";
  if (!root.has("vergence_m")) return;
  if (!header.gaze_combined)
    root.fail("vergence_m", "is given for per_eye gaze", "remove it: each eye has its own direction already");
  header.vergence_m = root.number("vergence_m", 1e-6, 1e9);
}

DisplayProfile parse_profile(const JsonObject& root) {
  const nlohmann::json& value = root.value("display_profile");
  if (!value.is_string()) return parse_display_profile(value, root.file(), "display_profile");
  const std::string name = root.text("display_profile");
  if (auto profile = builtin_display_profile(name)) return *profile;
  root.fail("display_profile", "is '" + printable(name) + "'",
            "write " + builtin_display_profile_names() + " or an inline profile {...}");
}

void parse_span(const JsonObject& root, ParsedSessionHeader& parsed) {
  if (root.has("start_ns")) parsed.start_ns = root.integer("start_ns", 0, kLastStampNs);
  if (root.has("end_ns")) parsed.end_ns = root.integer("end_ns", 0, kLastStampNs);
  if (parsed.start_ns && parsed.end_ns && *parsed.start_ns > *parsed.end_ns)
    root.fail("end_ns", "lies before start_ns", "exchange the two");
}

constexpr std::int64_t kMostConversionRows = 1'000'000'000'000;

const std::string& checked_sentence(const JsonObject& where, const char* key, const std::string& text) {
  if (text.size() > SessionConversion::kMostBytes)
    where.fail(key, "has " + std::to_string(text.size()) + " bytes", "write a sentence of at most 1000");
  return text;
}

void check_entry_count(const JsonObject& where, const char* key, std::size_t count) {
  if (count > SessionConversion::kMostEntries)
    where.fail(key, "has " + std::to_string(count) + " elements", "list at most 64");
}

SessionConversion::LeftOut parse_left_out(const JsonObject& entry) {
  entry.allow_only({"stream", "rows", "of", "reason"});
  SessionConversion::LeftOut left_out;
  left_out.stream = entry.text("stream");
  if (left_out.stream != "pose" && left_out.stream != "gaze" && left_out.stream != "cam0" &&
      left_out.stream != "cam1")
    entry.fail("stream", "is '" + printable(left_out.stream) + "'", "write pose, gaze, cam0 or cam1");
  left_out.of = entry.integer("of", 1, kMostConversionRows);
  left_out.rows = entry.integer("rows", 0, left_out.of);
  left_out.reason = checked_sentence(entry, "reason", entry.text("reason"));
  return left_out;
}

std::vector<std::string> parse_sentences(const JsonObject& entry, const char* key) {
  std::vector<std::string> sentences;
  if (!entry.has(key)) return sentences;
  const nlohmann::json& list = entry.value(key);
  if (!list.is_array()) entry.fail(key, "is no list", "write a list of sentences");
  check_entry_count(entry, key, list.size());
  for (const nlohmann::json& sentence : list) {
    if (!sentence.is_string()) entry.fail(key, "holds what is no text", "write a list of sentences");
    sentences.push_back(checked_sentence(entry, key, sentence.get<std::string>()));
  }
  return sentences;
}

SessionConversion parse_conversion(const JsonObject& entry) {
  entry.allow_only({"left_out", "assumed", "remarks", "still"});
  SessionConversion conversion;
  const std::vector<JsonObject> left_out = entry.objects("left_out");
  check_entry_count(entry, "left_out", left_out.size());
  for (const JsonObject& each : left_out) conversion.left_out.push_back(parse_left_out(each));
  conversion.assumed = parse_sentences(entry, "assumed");
  conversion.remarks = parse_sentences(entry, "remarks");
  for (const std::string& part : parse_sentences(entry, "still")) {
    if (part != "head" && part != "gaze")
      entry.fail("still", "holds '" + printable(part) + "'", "list head or gaze");
    (part == "head" ? conversion.still_head : conversion.still_gaze) = true;
  }
  return conversion;
}

// First of all: in a newer version any other field may have a new meaning.
void check_version(const JsonObject& root) {
  const std::int64_t version = root.integer("format_version", 0, 1'000'000);
  if (version != kSessionFormatVersion)
    root.fail("format_version",
              "is " + std::to_string(version) + ", and this program reads version " +
                  std::to_string(kSessionFormatVersion),
              version > kSessionFormatVersion ? "use a newer herr" : "convert the session again");
}

}  // namespace

ParsedSessionHeader read_session_header(const std::filesystem::path& session_json) {
  JsonLimits limits;
  limits.max_bytes = 1 << 20;  // a header of 64 viewports has 16 kB
  const nlohmann::json document = parse_json_file(session_json, limits);
  const JsonObject root(document, session_json, "");
  check_version(root);
  root.allow_only({"format_version", "name", "provenance", "licence", "display_profile", "eye_offsets",
                   "gaze_kind", "vergence_m", "rates_hz", "start_ns", "end_ns", "scene", "cameras",
                   "feed_distance_m", "conversion"});
  ParsedSessionHeader parsed;
  SessionHeader& header = parsed.header;
  header.name = root.text("name");
  header.provenance = root.text_or("provenance", "");
  header.licence = root.text_or("licence", "");
  header.profile = parse_profile(root);
  parse_eyes(root, parsed);
  parse_gaze(root, header);
  if (root.has("rates_hz")) {
    const JsonObject rates = root.object("rates_hz");
    rates.allow_only({"pose", "gaze"});
    header.pose_hz = rates.number_or("pose", 0.1, 10000, 0);
    header.gaze_hz = rates.number_or("gaze", 0.1, 10000, 0);
  }
  parse_span(root, parsed);
  header.scene = root.text_or("scene", "");
  if (!header.scene.empty() && header.scene.front() == '/')
    root.fail("scene", "is an absolute path", "write it relative to the session's folder");
  if (root.has("feed_distance_m")) header.feed_distance_m = root.number("feed_distance_m", 1e-6, 1e9);
  if (root.has("conversion")) header.conversion = parse_conversion(root.object("conversion"));
  const std::vector<JsonObject> cameras = root.objects("cameras");
  if (cameras.size() > 2)
    root.fail("cameras", "has " + std::to_string(cameras.size()) + " elements",
              "list none, one, or left and right");
  for (const JsonObject& camera : cameras) header.cameras.push_back(parse_camera(camera));
  return parsed;
}

}  // namespace herr
