#include "sessions/record/session_recorder.h"

#include <charconv>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/format/header_text.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

// A row in the making, on the stack: a stamp, at most seven numbers of a pose, nine values of a gaze.
class RowText {
 public:
  explicit RowText(TimeNs stamp_ns) { end_ = std::to_chars(text_, text_ + sizeof text_, stamp_ns).ptr; }

  // The shortest text that reads back as the same number: recording and replaying lose no bit.
  RowText& number(double value) {
    *end_++ = ',';
    // + 0.0 turns -0 into 0.
    end_ = std::to_chars(end_, text_ + sizeof text_, value + 0.0).ptr;
    return *this;
  }
  RowText& vector(const glm::dvec3& v) { return number(v.x).number(v.y).number(v.z); }
  RowText& flag(bool value) {
    *end_++ = ',';
    *end_++ = value ? '1' : '0';
    return *this;
  }
  std::string_view line() {
    *end_ = '\n';
    return {text_, static_cast<std::size_t>(end_ + 1 - text_)};
  }

 private:
  char text_[512];  // no number has more than 25 characters
  char* end_ = text_;
};

void ensure_folder(const fs::path& folder) {
  if (const std::error_code error = make_folders(folder))
    throw WriteError(folder, "make the folder", error.value());
}

std::string camera_name(std::size_t camera) {
  return "cam" + std::to_string(camera);
}

}  // namespace

SessionRecorder::SessionRecorder(fs::path folder) : folder_(std::move(folder)) {
  ensure_folder(folder_);
}

void SessionRecorder::write_header(const SessionHeader& header) {
  // A reader finds the old header or the new one, never half of one.
  write_whole_file(folder_ / "session.json", header_text(header));
}

SessionRecorder::Stream& SessionRecorder::stream(const std::string& name, const std::string& first_line) {
  const auto found = streams_.find(name);
  if (found != streams_.end()) return found->second;
  ensure_folder((folder_ / name).parent_path());
  Stream made{AppendFile(folder_ / name)};
  made.file.append(first_line);
  return streams_.emplace(name, std::move(made)).first->second;
}

void SessionRecorder::add(Stream& stream, TimeNs stamp_ns, std::string_view row, bool may_repeat) {
  if (stamp_ns < stream.last_ns || (stamp_ns == stream.last_ns && !may_repeat))
    throw std::logic_error("a recorded stamp does not grow");
  stream.last_ns = stamp_ns;
  stream.file.append(row);
  if (stream.flushed_ns < 0) stream.flushed_ns = stamp_ns;
  if (stream.file.unflushed_bytes() < kRecordFlushBytes && stamp_ns - stream.flushed_ns < kRecordFlushNs)
    return;
  stream.file.flush();
  stream.flushed_ns = stamp_ns;
}

void SessionRecorder::add_pose(const PoseRow& row) {
  const glm::dquat& q = row.world_from_head.orientation;
  RowText text(row.stamp_ns);
  text.vector(row.world_from_head.position).number(q.x).number(q.y).number(q.z).number(q.w);
  if (pose_stream_ == nullptr) pose_stream_ = &stream("pose/data.csv", "timestamp_ns,px,py,pz,qx,qy,qz,qw\n");
  add(*pose_stream_, row.stamp_ns, text.line());
}

void SessionRecorder::add_gaze(const GazeRow& row, std::optional<double> openness) {
  if (gaze_has_openness_.value_or(openness.has_value()) != openness.has_value())
    throw std::logic_error("some gaze rows have an openness and some have not");
  gaze_has_openness_ = openness.has_value();
  RowText text(row.stamp_ns);
  for (std::size_t eye = 0; eye < 2; ++eye)
    text.vector(row.valid[eye] ? row.head_direction[eye] : glm::dvec3(0)).flag(row.valid[eye]);
  if (openness) text.number(*openness);
  if (gaze_stream_ == nullptr)
    gaze_stream_ = &stream("gaze/data.csv", std::string("timestamp_ns,lx,ly,lz,l_valid,rx,ry,rz,r_valid") +
                                                (openness ? ",openness\n" : "\n"));
  add(*gaze_stream_, row.stamp_ns, text.line());
}

void SessionRecorder::add_camera_frame(std::size_t camera, const CameraRow& row) {
  // A name with one of these would be read back as something else.
  if (row.filename.empty() || row.filename.find_first_of(",\r\n") != std::string::npos)
    throw std::logic_error("a camera frame's file name cannot be written into a row");
  add(stream(camera_name(camera) + "/data.csv", "timestamp_ns,filename\n"), row.stamp_ns,
      std::to_string(row.stamp_ns) + "," + row.filename + "\n");
}

void SessionRecorder::add_image(std::size_t camera, const std::string& filename,
                                std::span<const std::uint8_t> bytes) {
  const fs::path data = folder_ / camera_name(camera) / "data";
  ensure_folder(data);
  AppendFile file(data / filename);
  file.append({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  file.finish();
}

void SessionRecorder::add_event(TimeNs stamp_ns, const std::string& json_line) {
  add(stream("events.jsonl", ""), stamp_ns, json_line + "\n", true);
}

void SessionRecorder::flush() {
  for (auto& [name, stream] : streams_) stream.file.flush();
}

void SessionRecorder::finish() {
  std::set<fs::path> folders{folder_};
  for (auto& [name, stream] : streams_) {
    stream.file.finish();
    const fs::path folder = stream.file.path().parent_path();
    folders.insert(folder);
    if (path_exists(folder / "data")) folders.insert(folder / "data");
  }
  for (const fs::path& folder : folders) sync_folder(folder);
}

}  // namespace herr
