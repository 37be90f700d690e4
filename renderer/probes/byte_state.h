// Appends and takes plain values and arrays of them, in one order for both directions: how the state of
// probes becomes bytes and comes back. Before: probe_volume and probe_motion. After: a checkpoint keeps the
// bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace herr {

class ByteSink {
 public:
  explicit ByteSink(std::vector<std::byte>& bytes) : bytes_(bytes) {}
  template <typename T>
  void value(const T& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* from = reinterpret_cast<const std::byte*>(&x);
    bytes_.insert(bytes_.end(), from, from + sizeof(T));
  }
  template <typename T>
  void items(std::span<const T> x) {
    const auto* from = reinterpret_cast<const std::byte*>(x.data());
    bytes_.insert(bytes_.end(), from, from + x.size_bytes());
  }
  template <typename T>
  void array(const std::vector<T>& x) {
    items(std::span<const T>(x));
  }

 private:
  std::vector<std::byte>& bytes_;
};

class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <typename T>
  void value(T& x) {
    take(&x, sizeof(T));
  }
  template <typename T>
  void items(std::span<T> x) {
    take(x.data(), x.size_bytes());
  }
  template <typename T>
  void array(std::vector<T>& x) {
    items(std::span<T>(x));
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  void take(void* to, std::size_t size) {
    if (size > bytes_.size()) throw std::invalid_argument("probe state is cut off");
    std::copy_n(bytes_.data(), size, static_cast<std::byte*>(to));
    bytes_ = bytes_.subspan(size);
  }
  std::span<const std::byte> bytes_;
};

}  // namespace herr
