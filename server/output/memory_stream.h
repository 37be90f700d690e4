// OpenEXR streams over memory, so that only AtomicFile ever writes files.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <cstdint>
#include <vector>

namespace herr {

// Appends to a vector; seeking back (offset tables) overwrites.
class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(std::vector<std::uint8_t>& bytes) : OStream("memory"), bytes_(bytes) {
    bytes_.clear();
  }
  void write(const char* data, int count) override;
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

 private:
  std::vector<std::uint8_t>& bytes_;
  std::uint64_t position_ = 0;
};

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(const std::vector<std::uint8_t>& bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char* data, int count) override;
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::uint64_t position_ = 0;
};

}  // namespace herr
