// Counts allocations of C++ (operator new) in the whole process, so that a frame loop that begins to allocate
// shows. A program that calls this has its operator new replaced by a counting one; sanitizers keep their
// own. Before: measure_run switches it on. After: allocations per frame.
#pragma once

#include <cstdint>
#include <optional>

namespace herr {

// Allocations since the process started, while counting was on. None where a sanitizer owns
// the allocator. Any thread.
std::optional<std::int64_t> allocations_counted();
void count_allocations(bool on);

}  // namespace herr
