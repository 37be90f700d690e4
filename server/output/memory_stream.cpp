#include "server/output/memory_stream.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <stdexcept>

namespace herr {

void MemoryOutput::write(const char* data, int count) {
  const auto size = static_cast<std::size_t>(count);
  const auto position = static_cast<std::size_t>(position_);
  const std::size_t end = position + size;
  // Appending is the usual case: insert grows geometrically and does not clear what is written next.
  const std::size_t overlap = position < bytes_.size() ? std::min(size, bytes_.size() - position) : 0;
  if (position > bytes_.size()) bytes_.resize(position);
  std::memcpy(bytes_.data() + position, data, overlap);
  bytes_.insert(bytes_.end(), data + overlap, data + size);
  position_ = end;
}

bool MemoryInput::read(char* data, int count) {
  const auto size = static_cast<std::uint64_t>(count);
  if (position_ + size > bytes_.size()) throw std::runtime_error("OpenEXR read past the end of memory");
  std::memcpy(data, bytes_.data() + position_, static_cast<std::size_t>(size));
  position_ += size;
  return position_ < bytes_.size();
}

}  // namespace herr
