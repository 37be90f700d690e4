// The render pool: a TBB arena of a fixed number of threads that take numbered jobs from one counter.
// Jobs are keyed by their number, never by thread, so results do not depend on how many threads there are.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

namespace herr {

class RenderThreads {
 public:
  // 1 ... 512 threads, the caller of run() being one of them.
  explicit RenderThreads(int threads);
  ~RenderThreads();
  RenderThreads(const RenderThreads&) = delete;
  RenderThreads& operator=(const RenderThreads&) = delete;

  int count() const;
  // Calls job(i, worker) once for each i in [0, jobs); worker is in [0, count()) and never used by two
  // threads at a time. Returns when all are done. An exception of a job is rethrown here.
  // `abandon` (may be null) is asked before each job: once it is set no further job begins,
  // and the answer is false.
  bool run(int jobs, const std::function<void(int job, int worker)>& job,
           const std::atomic<bool>* abandon = nullptr);
  // Calls `work` inside the arena: TBB (and Embree builds) within it use these threads.
  void inside(const std::function<void()>& work);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace herr
