#include "sessions/pictures/png_chunks.h"

#include <zlib.h>

#include <cstdint>
#include <limits>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kFrameBytes = 12;  // length, type and checksum around a chunk's data

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& problem) {
  throw InputError(file, 0, problem, "export the image again");
}

struct Chunk {
  std::string_view type;
  std::string_view whole;  // with length, type and checksum
};

// The chunk at `at`, its checksum verified (it covers type and data).
Chunk chunk_at(const std::filesystem::path& file, std::string_view bytes, std::size_t at) {
  const std::size_t left = bytes.size() - at;
  const std::uint64_t length = left >= kFrameBytes ? big_endian(bytes, at) : 0;
  if (left < kFrameBytes || length > left - kFrameBytes) fail(file, "is a PNG that was cut off");
  const std::string_view covered = bytes.substr(at + 4, static_cast<std::size_t>(length) + 4);
  static_assert(sizeof(uInt) == 4);  // a chunk's length has 32 bits, and so has zlib's
  const auto* data = reinterpret_cast<const Bytef*>(covered.data());
  const std::uint32_t stored = big_endian(bytes, at + 8 + static_cast<std::size_t>(length));
  if (covered.size() > std::numeric_limits<uInt>::max() ||
      ::crc32(0, data, static_cast<uInt>(covered.size())) != stored)
    fail(file, "is a damaged PNG: a checksum does not fit");
  return {covered.substr(0, 4), bytes.substr(at, static_cast<std::size_t>(length) + kFrameBytes)};
}

}  // namespace

ImageSize png_size(const std::filesystem::path& file, std::string_view first_bytes) {
  if (first_bytes.size() < kPngHeaderBytes) fail(file, "is a PNG that was cut off");
  const Chunk header = chunk_at(file, first_bytes.substr(0, kPngHeaderBytes), kSignatureBytes);
  if (header.type != "IHDR" || header.whole.size() != kPngHeaderBytes - kSignatureBytes)
    fail(file, "is a PNG without a header");
  constexpr std::uint32_t kLargest =
      std::numeric_limits<std::int32_t>::max();  // the specification's limit too
  const std::uint32_t width = big_endian(first_bytes, 16), height = big_endian(first_bytes, 20);
  if (width > kLargest || height > kLargest) fail(file, "is a PNG of impossible size");
  return {static_cast<int>(width), static_cast<int>(height)};
}

std::string essential_png(const std::filesystem::path& file, std::string_view bytes) {
  std::string essential(bytes.substr(0, kSignatureBytes));
  for (std::size_t at = kSignatureBytes;;) {
    const Chunk chunk = chunk_at(file, bytes, at);
    at += chunk.whole.size();
    if (chunk.type == "IHDR" || chunk.type == "PLTE" || chunk.type == "IDAT" || chunk.type == "IEND")
      essential += chunk.whole;
    if (chunk.type == "IEND") return essential;
  }
}

}  // namespace herr
