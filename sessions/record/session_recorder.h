// Writes a session folder in format version 1 while it happens: the header first, then rows as they come.
// Before: a device, an importer or a synthesiser. After: Session::open, at any moment: a recorder that dies
// leaves a session up to its last flush, and the reader drops the line that was cut off.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sessions/files/append_file.h"
#include "sessions/format/session_header.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

// What is not on its way to the disk yet is at most this much of the session, or this many bytes a stream.
inline constexpr TimeNs kRecordFlushNs = 1'000'000'000;
inline constexpr std::size_t kRecordFlushBytes = 64 << 10;

// Not thread-safe. Every function throws WriteError. Stamps must grow within a stream, as the readers
// demand; std::logic_error otherwise.
class SessionRecorder {
 public:
  // Makes the folder where it is missing; its files must not exist yet.
  explicit SessionRecorder(std::filesystem::path folder);

  // session.json, replaced as a whole: written first, and again where the end knows more (measured rates).
  void write_header(const SessionHeader& header);
  void add_pose(const PoseRow& row);
  // An eye that is not valid is written as 0,0,0. `openness` of the lids, 0 ... 1: a further column; either
  // every row has it or none (std::logic_error).
  void add_gaze(const GazeRow& row, std::optional<double> openness = {});
  // `filename` was added before with add_image, or is in cam<i>/data already; rows may share one.
  void add_camera_frame(std::size_t camera, const CameraRow& row);
  // A whole image file under cam<i>/data.
  void add_image(std::size_t camera, const std::string& filename, std::span<const std::uint8_t> bytes);
  void add_event(TimeNs stamp_ns, const std::string& json_line);  // stamps may repeat

  void flush();
  // Flushes and waits for the disk. No rows after that.
  void finish();

 private:
  struct Stream {
    AppendFile file;
    TimeNs last_ns = -1, flushed_ns = -1;
  };
  Stream& stream(const std::string& name, const std::string& first_line);
  void add(Stream& stream, TimeNs stamp_ns, std::string_view row, bool may_repeat = false);

  std::filesystem::path folder_;
  std::optional<bool> gaze_has_openness_;  // known from the first row
  std::map<std::string, Stream>
      streams_;                    // by file name relative to the folder; its elements stay where they are
  Stream* pose_stream_ = nullptr;  // of streams_, found once
  Stream* gaze_stream_ = nullptr;
};

}  // namespace herr
