// Writes finished files in a thread of its own: a bounded queue, so that a slow disk slows the replay instead
// of filling memory. Before: encoders. After: files under their final names (AtomicFile).
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace herr {

// One thread submits. After a failed write nothing more is written and every call throws that WriteError.
class FrameWriter {
 public:
  // `queue_limit`: files waiting at most.
  explicit FrameWriter(std::size_t queue_limit);
  // Waits for the file being written and drops the queue: call finish() first in the ordinary course.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  // Takes the bytes; `bytes` comes back as an empty buffer that was used before. Returns the milliseconds
  // spent waiting for room in the queue, 0 when there was room.
  double submit(std::filesystem::path file, std::vector<std::uint8_t>& bytes);
  // Waits until all is written and the names are durable.
  void finish();

  std::int64_t files_written() const;
  std::int64_t bytes_written() const;
  std::int64_t waits() const;  // submissions that found the queue full

 private:
  struct Job {
    std::filesystem::path file;
    std::vector<std::uint8_t> bytes;
  };
  void run();
  void rethrow_failure();  // with mutex_ held

  const std::size_t queue_limit_;
  mutable std::mutex mutex_;
  std::condition_variable room_, work_;
  std::deque<Job> queue_;
  std::vector<std::vector<std::uint8_t>> spare_;
  std::exception_ptr failure_;
  bool busy_ = false, stop_ = false;
  std::int64_t files_written_ = 0, bytes_written_ = 0, waits_ = 0;
  std::set<std::filesystem::path> unsynced_folders_;  // of files written since the last sync
  std::thread thread_;                                // last: starts when all else is ready
};

}  // namespace herr
