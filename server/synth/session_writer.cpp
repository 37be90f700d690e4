#include "server/synth/session_writer.h"

#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "server/cli/exit_code.h"
#include "server/output/atomic_file.h"
#include "server/statistics/number_text.h"
#include "sessions/input_error.h"

namespace herr {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kPositionDecimals = 6;   // a micrometre
constexpr int kDirectionDecimals = 7;  // a fiftieth of an arc second

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw UsageError("OUT: cannot make " + printable(folder.string()) + ": " + error.message() +
                     "; choose another folder");
  }
}

void append(std::string& row, const glm::dvec3& v, int decimals) {
  for (const double value : {v.x, v.y, v.z}) row += "," + fixed_text(value, decimals);
}

Json vec_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Json camera_json(const SessionWriter::Header& header) {
  const CameraModel& model = header.camera;
  const glm::dquat& q = header.head_from_camera.orientation;
  return {{"model", "pinhole"},
          {"width_px", model.width_px},
          {"height_px", model.height_px},
          {"fx", model.fx},
          {"fy", model.fy},
          {"cx", model.cx},
          {"cy", model.cy},
          {"nominal_hz", header.camera_hz},
          {"head_from_camera",
           {{"position", vec_json(header.head_from_camera.position)},
            {"orientation_xyzw", {q.x, q.y, q.z, q.w}}}}};
}

}  // namespace

SessionWriter::SessionWriter(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_empty(folder_, error)) {
    throw UsageError("OUT: " + printable(folder_.string()) + " is not empty; choose a new folder");
  }
  for (const char* name : {"pose", "gaze", "cam0/data"}) make_folder(folder_ / name);
  poses_ = "timestamp_ns,px,py,pz,qx,qy,qz,qw\n";
  gazes_ = "timestamp_ns,lx,ly,lz,l_valid,rx,ry,rz,r_valid\n";
  frames_ = "timestamp_ns,filename\n";
}

void SessionWriter::add_pose(TimeNs stamp_ns, const Pose& pose) {
  std::string row = std::to_string(stamp_ns);
  append(row, pose.position, kPositionDecimals);
  const glm::dquat& q = pose.orientation;
  for (const double value : {q.x, q.y, q.z, q.w}) row += "," + fixed_text(value, kDirectionDecimals);
  poses_ += row + "\n";
}

void SessionWriter::add_gaze(TimeNs stamp_ns, const GazeMotion::Sample& gaze) {
  std::string row = std::to_string(stamp_ns);
  for (const glm::dvec3& direction : gaze.head_direction) {
    append(row, direction, kDirectionDecimals);
    row += gaze.valid ? ",1" : ",0";
  }
  gazes_ += row + "\n";
}

void SessionWriter::add_camera_frame(TimeNs stamp_ns, const std::vector<std::uint8_t>& png) {
  const std::string number = std::to_string(frame_count_++);
  const std::string name = std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number + ".png";
  write_whole_file(folder_ / "cam0" / "data" / name, png);
  frames_ += std::to_string(stamp_ns) + "," + name + "\n";
}

void SessionWriter::finish(const Header& header) {
  write_whole_file(folder_ / "pose" / "data.csv", poses_);
  write_whole_file(folder_ / "gaze" / "data.csv", gazes_);
  write_whole_file(folder_ / "cam0" / "data.csv", frames_);
  Json json{{"format_version", 1},
            {"name", header.name},
            {"provenance", header.provenance},
            {"licence", header.licence},
            {"display_profile", header.profile},
            {"eye_offsets",
             {{"left", vec_json(header.head_from_eye[0].position)},
              {"right", vec_json(header.head_from_eye[1].position)}}},
            {"gaze_kind", "per_eye"},
            {"rates_hz", {{"pose", header.pose_hz}, {"gaze", header.gaze_hz}}}};
  if (!header.scene.empty()) json["scene"] = header.scene;
  json["cameras"] = Json::array({camera_json(header)});
  write_whole_file(folder_ / "session.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  for (const char* name : {"pose", "gaze", "cam0/data", "cam0", ""}) sync_folder(folder_ / name);
}

}  // namespace herr
