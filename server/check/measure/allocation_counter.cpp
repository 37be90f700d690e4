#include "server/check/measure/allocation_counter.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HERR_COUNTS_ALLOCATIONS 0
#else
#define HERR_COUNTS_ALLOCATIONS 1
#endif

namespace herr {
namespace {

std::atomic<bool> counting{false};
std::atomic<std::int64_t> counted{0};

}  // namespace

std::optional<std::int64_t> allocations_counted() {
  if (HERR_COUNTS_ALLOCATIONS == 0) return std::nullopt;
  return counted.load();
}

void count_allocations(bool on) {
  counting.store(on);
}

namespace {

#if HERR_COUNTS_ALLOCATIONS
void* counted_memory(std::size_t bytes, std::size_t alignment) {
  if (counting.load(std::memory_order_relaxed)) counted.fetch_add(1, std::memory_order_relaxed);
  bytes = std::max<std::size_t>(bytes, 1);
  for (;;) {
    // aligned_alloc wants a size that is a multiple of the alignment.
    void* memory = alignment == 0 ? std::malloc(bytes)
                                  : std::aligned_alloc(alignment, (bytes + alignment - 1) & ~(alignment - 1));
    if (memory != nullptr) return memory;
    const std::new_handler make_room = std::get_new_handler();
    if (make_room == nullptr) throw std::bad_alloc();
    make_room();
  }
}
#endif

}  // namespace
}  // namespace herr

#if HERR_COUNTS_ALLOCATIONS
// All other forms of new and delete call these.
void* operator new(std::size_t bytes) {
  return herr::counted_memory(bytes, 0);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return herr::counted_memory(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
#endif
