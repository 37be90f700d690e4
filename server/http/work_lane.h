// A thread with a bounded queue: answers that take long wait in a lane of their own and hold up no other.
// Before: http_server puts in a job for each whole request. After: the job hands its bytes back.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace herr {

// Thread-safe.
class WorkLane {
 public:
  using Job = std::function<void()>;
  // `niceness` of the lane's thread above that of the process: 0 ... 19.
  WorkLane(std::size_t most_waiting, int niceness);
  // Waits for the job that runs; those that wait are dropped.
  ~WorkLane();
  WorkLane(const WorkLane&) = delete;
  WorkLane& operator=(const WorkLane&) = delete;

  // False when the queue is full: the job was not taken. Jobs must not throw.
  bool try_put(Job job);

 private:
  void work(int niceness);

  const std::size_t most_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace herr
