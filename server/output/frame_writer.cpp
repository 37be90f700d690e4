#include "server/output/frame_writer.h"

#include <chrono>
#include <utility>

#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"

namespace herr {
namespace {

// Names become durable in batches: one sync of the folder costs as much as that of a file.
constexpr std::int64_t kFilesPerFolderSync = 64;

}  // namespace

FrameWriter::FrameWriter(std::size_t queue_limit, std::optional<AppendFile> index)
    : queue_limit_(queue_limit), index_(std::move(index)), thread_([this] { run(); }) {}

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
  return enqueue(Kind::picture, std::move(file), bytes);
}

void FrameWriter::add_row(std::string_view row) {
  std::vector<std::uint8_t> bytes(row.begin(), row.end());
  enqueue(Kind::row, {}, bytes);
}

void FrameWriter::checkpoint(std::filesystem::path file, std::string_view text) {
  std::vector<std::uint8_t> bytes(text.begin(), text.end());
  enqueue(Kind::checkpoint, std::move(file), bytes);
}

double FrameWriter::enqueue(Kind kind, std::filesystem::path file, std::vector<std::uint8_t>& bytes) {
  std::unique_lock lock(mutex_);
  rethrow_failure();
  double waited_ms = 0;
  if (queue_.size() >= queue_limit_) {
    const auto start = std::chrono::steady_clock::now();
    room_.wait(lock, [this] { return queue_.size() < queue_limit_ || failure_; });
    waited_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    rethrow_failure();
  }
  queue_.push_back({kind, std::move(file), std::move(bytes)});
  bytes.clear();
  if (kind == Kind::picture && !spare_.empty()) {
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
  lock.unlock();
  sync_all();
}

std::int64_t FrameWriter::files_written() const {
  const std::lock_guard lock(mutex_);
  return files_written_;
}

std::int64_t FrameWriter::bytes_written() const {
  const std::lock_guard lock(mutex_);
  return bytes_written_;
}

std::int64_t FrameWriter::bytes_held() const {
  const std::lock_guard lock(mutex_);
  std::size_t sum = 0;
  for (const Job& job : queue_) sum += job.bytes.capacity();
  for (const std::vector<std::uint8_t>& bytes : spare_) sum += bytes.capacity();
  return static_cast<std::int64_t>(sum);
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
    lock.unlock();
    room_.notify_all();

    std::exception_ptr failure;
    try {
      write(job);
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
    if (job.kind == Kind::picture) {
      ++files_written_;
      bytes_written_ += static_cast<std::int64_t>(job.bytes.size());
      if (spare_.size() < queue_limit_) spare_.push_back(std::move(job.bytes));
    }
    room_.notify_all();
  }
}

void FrameWriter::write(const Job& job) {
  switch (job.kind) {
    case Kind::picture:
      write_whole_file(job.file, job.bytes);
      unsynced_folders_.insert(job.file.parent_path());
      if (++unsynced_files_ == kFilesPerFolderSync) sync_folders();
      return;
    case Kind::row:
      index_->append({reinterpret_cast<const char*>(job.bytes.data()), job.bytes.size()});
      index_->flush();
      return;
    case Kind::checkpoint:
      sync_all();
      write_whole_file(job.file, job.bytes);
      sync_folder(job.file.parent_path());
      return;
  }
}

void FrameWriter::sync_folders() {
  unsynced_files_ = 0;
  for (const std::filesystem::path& folder : std::exchange(unsynced_folders_, {})) sync_folder(folder);
}

void FrameWriter::sync_all() {
  sync_folders();
  if (index_) index_->sync();
}

}  // namespace herr
