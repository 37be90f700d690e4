// Memory of texels: not filled when it is made, and in huge pages where the system gives them, for it is
// large and read all over: a 4096-texel square takes 32 of these in place of 16384 small ones.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace herr {

template <typename T>
struct TexelAllocator {
  using value_type = T;
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;

  TexelAllocator() = default;
  template <typename U>
  TexelAllocator(const TexelAllocator<U>&) {}

  static std::size_t alignment_of(std::size_t bytes) {
    return bytes >= kHugePage ? kHugePage : alignof(std::max_align_t);
  }
  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* const memory = ::operator new (bytes, std::align_val_t{alignment_of(bytes)});
    if (bytes >= kHugePage) ::madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: whatever comes of it
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    ::operator delete (memory, std::align_val_t{alignment_of(count * sizeof(T))});
  }
  // Grown without a value, an element holds anything until it is written.
  template <typename U>
  void construct(U* element) {
    ::new (static_cast<void*>(element)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* element, Arguments&&... arguments) {
    ::new (static_cast<void*>(element)) U(std::forward<Arguments>(arguments)...);
  }
  bool operator==(const TexelAllocator&) const { return true; }
};

using TexelVector = std::vector<std::uint32_t, TexelAllocator<std::uint32_t>>;

}  // namespace herr
