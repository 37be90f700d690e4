// Writes finished files in a thread of its own: a bounded queue, so that a slow disk slows the replay instead
// of filling memory. Before: encoders. After: files under their final names (AtomicFile), then the rows of
// the index that name them, then checkpoints that count on both.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>
#include <thread>
#include <vector>

#include "sessions/files/append_file.h"

namespace herr {

// One thread submits. What it submits is written in that order. After a failed write nothing more is written
// and every call throws that WriteError.
class FrameWriter {
 public:
  // `queue_limit`: files, rows and checkpoints waiting at most. `index`: where rows go.
  explicit FrameWriter(std::size_t queue_limit, std::optional<AppendFile> index = {});
  // Waits for the file being written and drops the queue: call finish() first in the ordinary course.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  // Takes the bytes; `bytes` comes back as an empty buffer that was used before. Returns the milliseconds
  // spent waiting for room in the queue, 0 when there was room.
  double submit(std::filesystem::path file, std::vector<std::uint8_t>& bytes);
  // A whole row of the index, which must exist: it is there exactly when the files submitted before it are.
  void add_row(std::string_view row);
  // Replaces `file` when everything submitted before is durable.
  void checkpoint(std::filesystem::path file, std::string_view text);
  // Waits until all is written and durable.
  void finish();

  // Of submit() alone.
  std::int64_t files_written() const;
  std::int64_t bytes_written() const;
  // Room of what waits in the queue, and of buffers that are used again.
  std::int64_t bytes_held() const;

 private:
  enum class Kind { picture, row, checkpoint };
  struct Job {
    Kind kind = Kind::picture;
    std::filesystem::path file;
    std::vector<std::uint8_t> bytes;
  };
  double enqueue(Kind kind, std::filesystem::path file, std::vector<std::uint8_t>& bytes);
  void run();
  void write(const Job& job);
  void sync_folders();
  void sync_all();
  void rethrow_failure();  // with mutex_ held

  const std::size_t queue_limit_;
  mutable std::mutex mutex_;
  std::condition_variable room_, work_;
  std::deque<Job> queue_;
  std::vector<std::vector<std::uint8_t>> spare_;
  std::exception_ptr failure_;
  bool busy_ = false, stop_ = false;
  std::int64_t files_written_ = 0, bytes_written_ = 0;
  // Of the thread while it is busy, else of whoever calls finish().
  std::optional<AppendFile> index_;
  std::set<std::filesystem::path> unsynced_folders_;  // of files written since the last sync
  int unsynced_files_ = 0;
  std::thread thread_;  // last: starts when all else is ready
};

}  // namespace herr
