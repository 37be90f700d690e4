#include "renderer/threads/render_threads.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>

namespace herr {
namespace {

constexpr unsigned kFlushDenormals =
    0x8040;  // FTZ and DAZ: Embree's documentation asks for both while tracing

}  // namespace

struct RenderThreads::Arena {
  // Sets FTZ/DAZ on every thread that works in the arena, and puts the caller's mode back when it leaves.
  class DenormalObserver final : public tbb::task_scheduler_observer {
   public:
    explicit DenormalObserver(tbb::task_arena& arena) : task_scheduler_observer(arena) { observe(true); }
    ~DenormalObserver() override { observe(false); }
    void on_scheduler_entry(bool) override {
      saved() = _mm_getcsr();
      _mm_setcsr(saved() | kFlushDenormals);
    }
    void on_scheduler_exit(bool) override { _mm_setcsr(saved()); }

   private:
    static unsigned& saved() {
      thread_local unsigned mode = _mm_getcsr();
      return mode;
    }
  };

  explicit Arena(int threads)
      : limit(tbb::global_control::max_allowed_parallelism,
              static_cast<std::size_t>(std::max(threads, tbb::info::default_concurrency()))),
        arena(threads, 1),
        observer(arena) {
    arena.initialize();
  }
  tbb::global_control limit;
  tbb::task_arena arena;
  DenormalObserver observer;
};

RenderThreads::RenderThreads(int threads) : arena_(std::make_unique<Arena>(threads)) {}
RenderThreads::~RenderThreads() = default;

int RenderThreads::count() const {
  return arena_->arena.max_concurrency();
}

bool RenderThreads::run(int jobs, const std::function<void(int, int)>& job,
                        const std::atomic<bool>* abandon) {
  const int workers = count();
  std::atomic<int> next{0};
  const auto go_on = [abandon] { return abandon == nullptr || !abandon->load(std::memory_order_relaxed); };
  std::atomic<bool> all{true};
  arena_->arena.execute([&] {
    tbb::parallel_for(
        0, workers, 1,
        [&](int worker) {
          for (int i = next.fetch_add(1, std::memory_order_relaxed); i < jobs;
               i = next.fetch_add(1, std::memory_order_relaxed)) {
            if (!go_on()) {
              all.store(false, std::memory_order_relaxed);
              return;
            }
            job(i, worker);
          }
        },
        tbb::simple_partitioner{});
  });
  return all;
}

void RenderThreads::inside(const std::function<void()>& work) {
  arena_->arena.execute(work);
}

}  // namespace herr
