#include "server/output/frame_writer.h"

#include <chrono>
#include <utility>

#include "server/output/atomic_file.h"

namespace herr {
namespace {

// Names become durable in batches: one sync of the folder costs as much as that of a file.
constexpr std::int64_t kFilesPerFolderSync = 64;

void sync_folders(const std::set<std::filesystem::path>& folders) {
  for (const std::filesystem::path& folder : folders) sync_folder(folder);
}

}  // namespace

FrameWriter::FrameWriter(std::size_t queue_limit) : queue_limit_(queue_limit), thread_([this] { run(); }) {}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    queue_.clear();
  }
  work_.notify_all();
  thread_.join();
}

double FrameWriter::submit(std::filesystem::path file, std::vector<std::uint8_t>& bytes) {
  std::unique_lock lock(mutex_);
  rethrow_failure();
  double waited_ms = 0;
  if (queue_.size() >= queue_limit_) {
    ++waits_;
    const auto start = std::chrono::steady_clock::now();
    room_.wait(lock, [this] { return queue_.size() < queue_limit_ || failure_; });
    waited_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    rethrow_failure();
  }
  queue_.push_back({std::move(file), std::move(bytes)});
  bytes.clear();
  if (!spare_.empty()) {
    bytes = std::move(spare_.back());
    spare_.pop_back();
    bytes.clear();
  }
  work_.notify_all();
  return waited_ms;
}

void FrameWriter::finish() {
  std::unique_lock lock(mutex_);
  room_.wait(lock, [this] { return (queue_.empty() && !busy_) || failure_; });
  rethrow_failure();
  const std::set<std::filesystem::path> folders = std::exchange(unsynced_folders_, {});
  lock.unlock();
  sync_folders(folders);
}

std::int64_t FrameWriter::files_written() const {
  const std::lock_guard lock(mutex_);
  return files_written_;
}

std::int64_t FrameWriter::bytes_written() const {
  const std::lock_guard lock(mutex_);
  return bytes_written_;
}

std::int64_t FrameWriter::waits() const {
  const std::lock_guard lock(mutex_);
  return waits_;
}

void FrameWriter::rethrow_failure() {
  if (failure_) std::rethrow_exception(failure_);
}

void FrameWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    work_.wait(lock, [this] { return stop_ || !queue_.empty(); });
    if (stop_) return;
    Job job = std::move(queue_.front());
    queue_.pop_front();
    busy_ = true;
    unsynced_folders_.insert(job.file.parent_path());
    std::set<std::filesystem::path> folders_to_sync;
    if ((files_written_ + 1) % kFilesPerFolderSync == 0) folders_to_sync.swap(unsynced_folders_);
    lock.unlock();
    room_.notify_all();

    std::exception_ptr failure;
    try {
      write_whole_file(job.file, job.bytes);
      sync_folders(folders_to_sync);
    } catch (...) {
      failure = std::current_exception();
    }

    lock.lock();
    busy_ = false;
    if (failure) {
      failure_ = failure;
      queue_.clear();
      room_.notify_all();
      return;
    }
    ++files_written_;
    bytes_written_ += static_cast<std::int64_t>(job.bytes.size());
    if (spare_.size() < queue_limit_) spare_.push_back(std::move(job.bytes));
    room_.notify_all();
  }
}

}  // namespace herr
