// What a renderer holds in memory, by what it is for. Parts that a frame plan leaves out are there with 0
// bytes. Not counted: the scene as it was loaded, and pictures, which belong to the caller.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace herr {

struct MemoryEntry {
  std::string name;  // "probes", "second rays", ...
  std::int64_t bytes = 0;
};
using MemoryUse = std::vector<MemoryEntry>;

inline std::int64_t total_bytes(const MemoryUse& use) {
  std::int64_t sum = 0;
  for (const MemoryEntry& entry : use) sum += entry.bytes;
  return sum;
}

template <typename T, typename Allocator>
std::int64_t bytes_of(const std::vector<T, Allocator>& items) {
  return static_cast<std::int64_t>(items.capacity() * sizeof(T));
}

}  // namespace herr
